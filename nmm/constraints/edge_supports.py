"""How an edge that no mesh follows is held: by springs, Nitsche's method or multipliers."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from covers.approximation.ghost import ghost, neighbours
from integration.arrays import Bools, Floats, Ints
from nmm.assembly.model import Model
from nmm.assembly.places import Place
from nmm.constraints.linear_matter import check_linear
from nmm.constraints.multiplier_space import multipliers, pieces_of, traction_degree
from nmm.constraints.nitsche_penalty import least_penalty
from nmm.constraints.support_methods import (
    Multipliers,
    Nitsche,
    Springs,
    Support,
    Tractions,
    traction_rows,
)
from nmm.constraints.volume_lift import lift
from nmm.effects.base import Instant
from nmm.errors import FormulationError

if TYPE_CHECKING:
    from collections.abc import Callable

    from nmm.formulation import SupportMethod

# Spring along edges of a mesh, in Young's moduli over the size of a cell, for an edge of one cell,
# and the stiffest one: beyond it rounding of the stiffness exceeds the error of the spring.
EDGE_STIFFNESS, STIFFEST = 100.0, 1e6
# Nitsche's penalty in (lambda + 2 mu) / h by degree of the local functions, and the ghost term in
# (lambda + 2 mu) / h^2: measured to keep the matrix positive down to cuts of 1e-6 of a cell.
GAMMA = {0: 20.0, 1: 20.0, 2: 60.0, 3: 120.0}
GHOST = 0.5
# The ghost term takes lambda + 2 mu up to this many mu: a Poisson ratio of 1/3 in plane strain.
# Above it the tie would lock what it ties; `least_penalty` makes up for a softer one.
SOFTEST = 4.0


@dataclass(frozen=True)
class Method:
    """How edges are held.

    Attributes
    ----------
    kind
        "penalty", "nitsche" or "lagrange".
    size
        Size of the mesh's cells (m); None for blocks.
    degree
        Degree of the local functions.
    stiffness
        Spring in Young's moduli over the size of a cell; None is the default.
    gamma, ghost
        Nitsche's penalty and ghost term; None is the default of the degree, or more where an
        estimate of the largest traction over energy asks for it.
    """

    kind: str
    size: float | None
    degree: int
    stiffness: float | None = None
    gamma: float | None = None
    ghost: float = GHOST

    def order(self, model: Model) -> int:
        """Degree of polynomials to integrate along edges."""
        return max(2 * (self.degree + 2), 2 * model.manifold.degree)

    def hold(
        self,
        model: Model,
        place: Place,
        displacement: "Callable[[Instant], Floats]",
        held: tuple[bool, bool] = (True, True),
        name: str = "edge",
    ) -> Support:
        """Hold Gauss points of an edge; ``displacement`` may differ from point to point."""
        assert self.size is not None
        axes: Bools = np.array(held)
        weight = place.weight * model.thickness
        if self.kind == "penalty":
            spring = self._factor(place) * model.modulus[place.elements] / self.size * weight
            return Springs(name, place, axes, displacement, spring)
        if self.kind == "lagrange":
            pieces = pieces_of(model, place, self.size)
            basis = multipliers(pieces, self.size, traction_degree(model), axes)
            shared = Tractions(int(basis.shape[1]))
            return Multipliers(name, place, axes, displacement, weight, basis, shared)
        check_linear(model, "[supports] method", 'method = "penalty"')
        hard = model.drained[:, :2, :2].max(axis=(1, 2))
        soft = np.minimum(hard, SOFTEST * model.elasticity[:, 2, 2])
        gamma = GAMMA[min(self.degree, 3)] if self.gamma is None else self.gamma
        tie = ghost(
            model.manifold,
            self._cut(model, place),
            self.ghost * model.thickness * soft / self.size**2,
            model.manifold.degree,
        )
        traction = traction_rows(model, place)
        penalty = gamma * hard[place.elements] / self.size
        if self.gamma is None:
            penalty = np.maximum(penalty, least_penalty(model, place, traction, tie))
        held_up = lift(model, place.elements, place.position, place.weight)
        return Nitsche(name, place, axes, displacement, weight, penalty, traction, tie, held_up)

    def _factor(self, place: Place) -> float:
        """Spring in E / h: it must grow as the error of the approximation falls."""
        assert self.size is not None
        if self.stiffness is not None:
            return self.stiffness
        cells = max(float(np.hypot(*np.ptp(place.position, axis=0))) / self.size, 1.0)
        return float(min(EDGE_STIFFNESS * cells ** (self.degree + 1), STIFFEST))

    def _cut(self, model: Model, place: Place) -> Ints:
        """Elements on the edge that a cut has left, and those of their neighbours."""
        elements = np.unique(place.elements)
        if model.cut is None:
            return elements
        part = ~model.cut.element_whole
        first, second = neighbours(model.manifold, elements[part[elements]])
        near = np.unique(np.concatenate([elements, first, second]))
        return np.asarray(near[part[near]])


def method_of(part: "SupportMethod", size: float | None, degree: int, mesh: bool) -> Method:
    """Return the method that a formulation names; "auto" is springs for blocks, else Nitsche's."""
    kind = part.method
    if kind == "auto":
        kind = "nitsche" if mesh else "penalty"
    if kind != "penalty" and not mesh:
        raise FormulationError(
            f'[supports] method: "{kind}": for covers of meshes: expected "penalty" with type = '
            '"block": change the method or the cover'
        )
    return Method(kind, size, degree, part.stiffness, part.gamma, part.ghost)
