"""Springs at points: Shi's fixed points (1988), stiff edges, joint elements (Goodman 1968)."""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import ClassVar, Self

import numpy as np

from integration.arrays import Floats
from integration.contraction import contract, summed
from integration.plane_vectors import clockwise
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.constraints.imposition import Imposition, Method
from nmm.constraints.interface import Interface, Triplets, product

# Spring of a support in Young's moduli times thickness: Shi's 10 to 1000, at the stiff end.
POINT_STIFFNESS = 1000.0
# Spring along edges of a mesh, in Young's moduli over the size of a cell, for an edge of one cell,
# and the stiffest one: beyond it rounding of the stiffness exceeds the error of the spring.
EDGE_STIFFNESS, STIFFEST = 100.0, 1e6
# Springs of glue in E / length of the longest edge that elements share: it opens by 1e-4 of that
# length under a strain of one. At 1e6 the traction along a cut interface oscillates by 10 %, at
# 1e4 by 1 %.
GLUE = 1e4


@dataclass(frozen=True)
class Springs(Imposition):
    """Springs at the points.

    Attributes
    ----------
    stiffness
        (m,) N/m, or tensors (m, 2, 2) that turn by the mean of both sides.
    stretch
        (m, 2) by how far they are stretched as they are laid, which turns like them (m).
    """

    stiffness: Floats
    stretch: Floats | float = 0.0

    words: ClassVar[str] = "springs"
    reads: ClassVar[frozenset[str] | None] = frozenset({"stiffness"})

    @classmethod
    def of(cls, model: Model, interface: Interface, method: Method) -> Self:
        if interface.second is not None:
            glue = glue_stiffness(model, interface, method.stiffness)
            return cls(interface, glue * interface.area)
        modulus = model.modulus[interface.first.elements]
        if method.size is not None and interface.first.normal is not None:
            spring = _factor(interface, method) * modulus / method.size
            return cls(interface, spring * interface.area)
        weight = interface.first.weight
        each = 1 if interface.first.normal is None else len(interface)
        stiffness = POINT_STIFFNESS * modulus * model.thickness * each * weight / weight.sum()
        return cls(interface, stiffness)

    def matrix(self, state: State) -> Triplets:
        unknowns, rows = self.interface.rows(state)
        return product((unknowns, rows), (unknowns, self._pulled(state, rows)))

    def force(self, state: State, jump: Floats) -> Floats:
        return self.interface.spread(state, self.point_forces(state, jump))

    def point_forces(self, state: State, jump: Floats) -> Floats:
        found = self._against(state, jump)
        return found + self._laid(state) if self._stretched else found

    def energy(self, state: State, jump: Floats) -> float:
        return -0.5 * float(summed(jump * self._against(state, jump), axis=None))

    def laid_energy(self, state: State, jump: Floats) -> float:
        return -float((jump * self._laid(state)).sum()) if self._stretched else 0.0

    @property
    def springs(self) -> Floats:
        return self.stiffness

    def laid(self, stretch: Floats) -> Self:
        return replace(self, stretch=stretch)

    @cached_property
    def _stretched(self) -> bool:
        """Whether springs are laid with a stretch; asked for in each step."""
        return bool(np.any(self.stretch))

    def _laid(self, state: State) -> Floats:
        """Forces (m, 2) in N with which springs are laid, as these have turned since."""
        stretch = np.asarray(self.stretch)
        if self.interface.second is not None:
            stretch = contract("mij,mj->mi", self.interface.turned(state), stretch)
        return self._against(state, -stretch)

    def _against(self, state: State, way: Floats) -> Floats:
        """Forces (m, 2) in N against ways (m, 2) of the first side."""
        if self.stiffness.ndim == 1:
            return -(self.stiffness[:, None] * way)
        return -self._pulled(state, way[:, :, None])[:, :, 0]

    @property
    def turns(self) -> bool:
        """See `Imposition.turns`: not between the ground and springs alike in x and y."""
        alike = self.stiffness.ndim == 1 and bool(self.interface.held.all())
        return self.interface.second is not None or not alike

    @property
    def oriented(self) -> bool:
        """See `Imposition.oriented`: springs that are unlike along the interface and across."""
        return self.interface.second is not None and self.stiffness.ndim > 1

    def _pulled(self, state: State, ways: Floats) -> Floats:
        """Forces (m, 2, k) in N of ways (m, 2, k) in global axes."""
        if self.stiffness.ndim == 1:
            return np.asarray(self.stiffness[:, None, None] * ways)
        if self.interface.second is None:
            return np.asarray(self.stiffness @ ways)
        turn = self.interface.turned(state)
        return np.asarray(turn @ (self.stiffness @ (np.swapaxes(turn, 1, 2) @ ways)))


def joint_springs(interface: Interface, stiffness: Floats) -> Springs:
    """Springs of ``stiffness`` (m, 2), normal and shear, in Pa/m between two bodies."""
    assert interface.first.normal is not None
    normal = interface.first.normal
    axes = np.stack([normal, clockwise(normal)], axis=1)
    stiff = interface.area[:, None] * stiffness
    return Springs(interface, np.einsum("mka,mk,mkb->mab", axes, stiff, axes))


def glue_stiffness(model: Model, interface: Interface, factor: float | None) -> Floats:
    """Springs (m,) of glue in Pa/m; ``factor`` as the formulation gives it."""
    moduli = np.stack([model.modulus[side.elements] for side in interface.sides])
    longest = interface.first.piece_lengths.max(initial=0.0)
    return np.asarray((GLUE if factor is None else factor) * moduli.min(axis=0) / longest)


def _factor(interface: Interface, method: Method) -> float:
    """Return the spring in E / h, which must grow as the error of the approximation falls.

    Cells are counted between the outermost quadrature points, short of the ends of the edge by up
    to 0.4 cells in all: springs are softer by ``(1 - 0.4 / cells)^(degree + 1)`` than by all cells,
    a fifth with four cells of degree 1, well within what the factor leaves open.
    """
    if method.stiffness is not None:
        return method.stiffness
    assert method.size is not None
    reach = np.hypot(*np.ptp(interface.first.position, axis=0))
    cells = max(float(reach) / method.size, 1.0)
    return float(min(EDGE_STIFFNESS * cells ** (method.degree + 1), STIFFEST))
