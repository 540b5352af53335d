"""A manifold with materials: the matrices and loads of the solid, in body frames."""

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, cast

import numpy as np

from integration.arrays import Bools, Floats, Ints
from integration.sparse import csc_array
from nmm.assembly.elastic_solid import ElasticSolid
from nmm.assembly.elements import element_matrices
from nmm.assembly.kept import kept_of_object
from nmm.assembly.matter import Matter
from nmm.errors import FormulationError
from nmm.materials.base import History, Law
from nmm.solvers.unchecked import product

if TYPE_CHECKING:
    from covers.cutting.cut import Cutting
    from nmm.assembly.finite_strain.finite_matter import FiniteMatter
    from nmm.assembly.state import State


# Stiffness over inertia, as a share of the body's largest, that is rounding: its square of 1e-16.
RIGID = 1e-25
# Of a square of unit modulus, thickness and area that is strained: stiffness over inertia.
SQUARE = 12.0


@dataclass(frozen=True)
class Model(ElasticSolid):
    """What is approximated and of what it is made.

    Attributes
    ----------
    laws, law, plane
        Laws, the law (E,) of each element and "stress" or "strain", for laws that are not linear;
        without them all elements are linear.
    finite
        Whether strain is finite: all elements then have material points.
    bonded
        Numbers of the cracks whose faces begin bonded.
    cutting
        What the next cut of the same blocks may go on from; None where there is nothing of the
        kind.
    cell_size
        (E,) of the cells that elements are cut from, or of the blocks that they are (m); None where
        no law asks for it.
    """

    laws: tuple[Law, ...] = ()
    law: Ints | None = None
    plane: str = "strain"
    finite: bool = False
    bonded: tuple[int, ...] = ()
    cutting: "Cutting | None" = None
    cell_size: Floats | None = None

    @cached_property
    def of_blocks(self) -> bool:
        """Whether every body is one element, whose points' rows hold all its unknowns."""
        manifold = self.manifold
        return len(manifold.elements) == manifold.n_bodies == manifold.n_covers

    @cached_property
    def matter(self) -> "Matter | FiniteMatter | None":
        """Material points of the elements whose laws are not linear; None without any.

        Under finite strain those of all elements.

        Raises
        ------
        FormulationError
            Projected volumes: pressures on patches are linear in the strain.
        """
        if self.law is None:
            return None
        straight = np.array([law.linear for law in self.laws])[self.law]
        if straight.all() and not self.finite:
            return None
        if self.projected and self.pressures is not None:
            raise FormulationError(
                f'[cover] volumetric: "projected": with {self.bent}: expected '
                '"full", which resists volume at every material point: use it with degree 1 or 2'
            )
        if self.finite:
            from nmm.assembly.finite_strain.finite_matter import FiniteMatter

            given = self.manifold, self.laws, self.law, self.plane, self.thickness
            return FiniteMatter.of(*given)
        elastic = self.thickness * self.elasticity * straight[:, None, None]
        rest = self._matrix(element_matrices.stiffness, elastic)
        points = self.manifold, self.laws, self.law, self.plane, self.thickness
        return Matter.of(*points, rest, self.cell_size)

    @property
    def finite_matter(self) -> "FiniteMatter":
        """Matter of bodies that bend by any angle: where strain is finite."""
        assert self.finite
        return cast("FiniteMatter", self.matter)

    @property
    def may_bend(self) -> bool:
        """Whether the material response is nonlinear, in this stage or in another one."""
        return self.finite or any(not law.linear for law in self.laws or ())

    @property
    def bent(self) -> str:
        """What makes the material response nonlinear, in words."""
        if self.finite:
            return 'finite strain ([rotation] update: "finite")'
        return "a material that is not linear"

    @property
    def elastic_stiffness(self) -> csc_array:
        """Elastic stiffness (n_unknowns, n_unknowns)."""
        return self.stiffness if self.matter is None else self.matter.elastic_stiffness

    @cached_property
    def force_scale(self) -> Floats:
        """(n_unknowns,) factors by which forces on unknowns of all kinds compare.

        One over the root of each unknown's stiffness ``K``. What moves a body without strain has
        none: it counts as if it swung as fast as the body's other unknowns do, by the mean of their
        ``log (K / M)``, with ``M`` of a density of one. A rigid body counts as if it swung as fast
        as a square of its area that can be strained.
        """
        manifold = self.manifold
        stiffness, inertia = self.elastic_stiffness.diagonal(), self.measure.diagonal()
        body = manifold.unknown_body
        square = np.divide(stiffness, inertia, out=np.zeros_like(inertia), where=inertia > 0)
        largest = np.zeros(manifold.n_bodies)
        np.maximum.at(largest, body, square)
        strains = square > RIGID * largest[body]
        number = np.bincount(body[strains], minlength=manifold.n_bodies)
        logs = np.bincount(body[strains], np.log(square[strains]), manifold.n_bodies)
        modulus = np.zeros(manifold.n_bodies)
        np.maximum.at(modulus, manifold.element_body, self.modulus)
        rigid = SQUARE * self.thickness * modulus / manifold.body_area
        mean = np.where(number > 0, np.exp(logs / np.maximum(number, 1)), rigid)
        felt = np.where(strains, stiffness, mean[body] * inertia)
        return np.asarray(1 / np.sqrt(np.where(felt > 0, felt, np.inf)))

    def history(self) -> History:
        """Return the initial internal variables, (Q, h) by name."""
        return {} if self.matter is None else self.matter.start()

    def tangent(self, state: "State") -> csc_array:
        """Stiffness (n_unknowns, n_unknowns) against sudden small motions from a state."""
        if self.matter is None:
            return self.stiffness
        answer = self.matter.update(state.deformation, state.history, 0.0)
        return self.matter.stiffness(answer.tangent)

    def stress(self, state: "State", pressure: Floats | None = None) -> Floats:
        """Mean stress (E, 3) of the elements in body axes, beyond the initial stress.

        ``pressure`` (k,) is that of the patches where it is known better, see `pressure`.
        """
        found = self.mean_stress(state.deformation, pressure)
        if self.matter is not None:
            elements, means = self.matter.mean_stress(state.deformation, state.history)
            found[elements] = means
        return found

    @cached_property
    def across_share(self) -> Floats:
        """Elastic stress across the plane (E, 3) of unit stresses in it."""
        if not self.laws or self.law is None:
            raise FormulationError(
                "stress across the plane: a model without laws: expected laws that tell it: give "
                "Model(laws=..., law=...)"
            )
        each = np.array([law.across_share(self.plane) for law in self.laws])
        return np.asarray(each[self.law])

    def stress_across(self, state: "State", stress: Floats) -> Floats:
        """Mean stress across the plane (E,) of the elements, at their own ``stress`` (E, 3) (Pa).

        Of laws that are not linear it is all that they know of, their initial stress with it.
        """
        share = self.across_share
        found: Floats = share[:, 0] * stress[:, 0] + share[:, 1] * stress[:, 1]
        found += share[:, 2] * stress[:, 2]
        if self.matter is not None:
            elements, means = self.matter.mean_across(state.deformation, state.history)
            found[elements] = means
        return found

    @cached_property
    def remembers(self) -> Bools:
        """(E,) whether elements have points that remember all stress but that of pores."""
        found = np.zeros(len(self.manifold.elements), dtype=bool)
        if isinstance(self.matter, Matter):
            found[self.matter.points.rule.owner] = True
        return found

    def strain_energy(self, state: "State") -> float:
        """Energy (J) stored in the material, but for what an initial stress counts by itself."""
        q = state.deformation
        if self.matter is None:
            return float(q @ product(self.stiffness, q)) / 2
        return self._stored(state)

    @kept_of_object
    def _stored(self, state: "State") -> float:
        """Energy of the last states, which several reports ask for."""
        assert self.matter is not None
        return self.matter.energy(state.deformation, state.history)

    def dissipated(self, before: "State", after: "State") -> float:
        """Work (J) of the stress in a step less what the material stores of it."""
        if self.matter is None or self.finite:  # which stores all
            return 0.0
        mean = (self.internal(before) + self.internal(after)) / 2
        work = float(mean @ (after.deformation - before.deformation))
        work -= self.swollen(before, after)
        return work - self.strain_energy(after) + self.strain_energy(before)

    def swollen(self, before: "State", after: "State") -> float:
        """Work (J) of the stress in a step on what swells of matter that is not linear."""
        matter = self.matter
        return matter.swollen(before.history, after.history) if isinstance(matter, Matter) else 0.0

    @kept_of_object
    def internal(self, state: "State") -> Floats:
        """Internal force (n,) of nonlinear material; kept for the last states."""
        assert self.matter is not None
        return self.matter.internal(state.deformation, state.history)

    def missed_work(self, before: "State", after: "State") -> float:
        """Return by how much the mean force of both ends does more work (J) than is stored.

        It is a matter of finite strain, whose force is no line in the displacement; what others do
        beyond is dissipated.
        """
        if self.matter is None:
            return 0.0
        return self.matter.missed(before.deformation, after.deformation)
