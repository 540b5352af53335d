"""A manifold with materials: the matrices and loads of the solid, in body frames."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import csc_array, csr_array, diags_array

from covers.approximation.groups.element_group import ElementGroup
from covers.approximation.manifold import Manifold
from covers.cutting.cut_cells import CutCells
from integration.arrays import Floats, Ints
from integration.contraction import contract
from integration.polygons import areas
from nmm.assembly import element_matrices
from nmm.assembly.element_sums import ElementMatrices, summed_matrix, summed_vector
from nmm.assembly.held_volumes.excess import VOLUME, excess, held_pressures
from nmm.assembly.held_volumes.pressures import Pressures
from nmm.assembly.kept import KeptOfStates
from nmm.assembly.lumping import check_positive
from nmm.assembly.matter import Matter
from nmm.errors import FormulationError
from nmm.materials.base import History, Law
from nmm.solvers.unchecked import product

if TYPE_CHECKING:
    from covers.cutting.cut import Cutting
    from nmm.assembly.finite_strain.finite_matter import FiniteMatter
    from nmm.assembly.motion import State


@dataclass(frozen=True)
class Model:
    """What is approximated and of what it is made.

    Attributes
    ----------
    manifold
        Elements, covers, unknowns.
    elasticity
        (E, 3, 3) stress from strain of each element (Pa).
    density
        (E,) kg/m3; zeros where a scene calls for no mass.
    modulus
        (E,) Young's modulus (Pa), the unit of penalties.
    thickness
        Out-of-plane thickness (m).
    lumped
        Whether the mass couples no cover with another.
    projected
        Whether pressures on patches resist changes of volume (`held_volumes`).
    cut
        How the cut left the mathematical cover; every block is a whole cell.
    laws, law, plane
        Laws, the law (E,) of each element and "stress" or "strain", for laws that are not linear;
        without them all elements are linear.
    point_mass
        (n, n) of masses at points, which joins the mass; None without any.
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

    manifold: Manifold
    elasticity: Floats
    density: Floats
    modulus: Floats
    thickness: float
    cut: CutCells
    lumped: bool = False
    projected: bool = False
    laws: tuple[Law, ...] = ()
    law: Ints | None = None
    plane: str = "strain"
    point_mass: csc_array | None = None
    finite: bool = False
    bonded: tuple[int, ...] = ()
    cutting: "Cutting | None" = None
    cell_size: Floats | None = None

    @cached_property
    def stiffness(self) -> csc_array:
        """Elastic stiffness (n_unknowns, n_unknowns)."""
        if not self.projected or self.pressures is None:
            return self._matrix(element_matrices.stiffness, self.thickness * self.elasticity)
        drained = self._matrix(element_matrices.stiffness, self.thickness * self.drained)
        held = csr_array(self.pressures.root @ self.pressures.divergence)
        return csc_array(drained + self.thickness * (held.T @ held))

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
    def may_bend(self) -> bool:
        """Whether matter is no line in the displacements, be it in another stage."""
        return self.finite or any(not law.linear for law in self.laws or ())

    @property
    def bent(self) -> str:
        """What makes matter no line in the displacements, in words."""
        if self.finite:
            return 'finite strain ([rotation] update: "finite")'
        return "a material that is not linear"

    def history(self) -> History:
        """Return the internal variables of matter that nothing has happened to, (Q, h) by name."""
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

    def strain_energy(self, state: "State") -> float:
        """Energy (J) stored in the material, but for what an initial stress counts by itself."""
        q = state.deformation
        if self.matter is None:
            return float(q @ product(self.stiffness, q)) / 2
        return self._stored.of(state)

    @cached_property
    def _stored(self) -> KeptOfStates[float]:
        """Energy of the last states, which several reports ask for."""
        matter = self.matter
        assert matter is not None
        return KeptOfStates(lambda state: matter.energy(state.deformation, state.history))

    def dissipated(self, before: "State", after: "State") -> float:
        """Work (J) of the stress in a step less what the material stores of it."""
        if self.matter is None or self.finite:  # which stores all
            return 0.0
        mean = (self.internal(before) + self.internal(after)) / 2
        work = float(mean @ (after.deformation - before.deformation))
        return work - self.strain_energy(after) + self.strain_energy(before)

    def internal(self, state: "State") -> Floats:
        """Internal force (n,) of matter that is not linear; kept for the last states."""
        return self._internal.of(state)

    @cached_property
    def _internal(self) -> KeptOfStates[Floats]:
        matter = self.matter
        assert matter is not None
        return KeptOfStates(lambda state: matter.internal(state.deformation, state.history))

    def missed_work(self, before: "State", after: "State") -> float:
        """Return by how much the mean force of both ends does more work (J) than is stored.

        It is a matter of finite strain, whose force is no line in the displacement; what others do
        beyond is dissipated.
        """
        if self.matter is None:
            return 0.0
        return self.matter.missed(before.deformation, after.deformation)

    @cached_property
    def pressures(self) -> Pressures | None:
        """Pressures of materials that resist volume much more than shear; None without any.

        Where the volume is resisted in every point they serve edges alone
        (`nmm.constraints.volume_lift`) and are of the degree of the strains, which are held exactly
        where they are polynomials.

        Raises
        ------
        FormulationError
            Projected volumes with weights that are negative somewhere.
        """
        return held_pressures(self.manifold, self._excess, self.projected)

    @cached_property
    def bulk(self) -> Floats:
        """(E,) stiffness against changes of volume that pressures hold (Pa)."""
        excess = self._excess
        return excess if self.pressures is not None else np.zeros_like(excess)

    @cached_property
    def drained(self) -> Floats:
        """(E, 3, 3) stress from strain without what pressures hold (Pa)."""
        return np.asarray(self.elasticity - self.bulk[:, None, None] * np.outer(VOLUME, VOLUME))

    @cached_property
    def _excess(self) -> Floats:
        return excess(self.elasticity)

    def pressure(self, deformation: Floats, gap: Floats | None = None) -> Floats | None:
        """Pressures (k,) of the unknowns; None where volumes are not projected.

        ``gap`` (k,) are volumes that lie between edges and where they are held (m2).
        """
        if not self.projected or self.pressures is None:
            return None
        volume = self.pressures.divergence @ deformation
        return self.pressures.of(volume if gap is None else volume - gap)

    @cached_property
    def mass(self) -> csc_array:
        """Mass: consistent, or a block for each cover.

        Raises
        ------
        FormulationError
            A lumped mass that is not positive, of weights that are not.
        """
        if not self.lumped:
            return self.consistent_mass
        found = self._matrix(element_matrices.lumped_mass, self.thickness * self.density)
        found = self._loaded(found)
        found.eliminate_zeros()
        check_positive(found, self.manifold.cover_offset)
        return found

    @cached_property
    def consistent_mass(self) -> csc_array:
        """Mass of the displacement field, whatever the choice for `mass`."""
        return self._loaded(self._matrix(element_matrices.mass, self.thickness * self.density))

    def _loaded(self, mass: csc_array) -> csc_array:
        """Return a mass with that of points."""
        return mass if self.point_mass is None else csc_array(mass + self.point_mass)

    @cached_property
    def measure(self) -> csc_array:
        """Integral of the product of two displacements (m2): mass of unit density and thickness."""
        return self._matrix(element_matrices.mass, np.ones(len(self.density)))

    @cached_property
    def rigid_projection(self) -> csr_array:
        """Rows (3 B, n_unknowns): mean translation x, y and mean rotation of each body.

        The mean is the area-weighted least-squares fit of a rigid motion about the centroid.
        """
        modes = self.manifold.rigid_modes
        weighted = (self.measure @ modes).T.tocsr()
        norm = (weighted @ modes).diagonal()
        return csr_array(diags_array(1 / norm) @ weighted)

    def body_load(self, load: Floats) -> Floats:
        """Force vector of a load density (E, 2) in N/m3, in body axes."""
        return self._vector(
            lambda g: element_matrices.body_load(g, self.thickness * load[g.elements])
        )

    def stress_load(self, stress: Floats) -> Floats:
        """Internal force of a stress (E, 3) in Pa, in body axes."""
        return self._vector(
            lambda g: element_matrices.stress_load(g, self.thickness * stress[g.elements])
        )

    def mean_stress(self, deformation: Floats, pressure: Floats | None = None) -> Floats:
        """Mean elastic stress (E, 3) in body axes of the unknowns ``deformation``.

        ``pressure`` (k,) is that of the patches where it is known better, see `pressure`.
        """
        strain = self.mean_strain(deformation)
        known = self.pressure(deformation) if pressure is None else pressure
        if known is None:
            return np.asarray(contract("eij,ej->ei", self.elasticity, strain))
        assert self.pressures is not None
        mean = (self.pressures.integrals(self.manifold) @ known) / self.element_area
        return np.asarray(contract("eij,ej->ei", self.drained, strain) + mean[:, None] * VOLUME)

    def mean_strain(self, deformation: Floats) -> Floats:
        """Mean strain (E, 3) of the unknowns ``deformation``."""
        strain = np.empty((len(self.density), 3))
        for group, rows in zip(self.manifold.groups, self._strain_rows, strict=True):
            local = deformation[group.unknowns]
            strain[group.elements] = contract("nil,nl->ni", rows[group.shape], local)
        return strain / self.element_area[:, None]

    @cached_property
    def element_area(self) -> Floats:
        """(E,) areas of the elements in the reference place (m2)."""
        return areas(self.manifold.elements)

    @cached_property
    def _strain_rows(self) -> list[Floats]:
        return [element_matrices.mean_strain_rows(group) for group in self.manifold.groups]

    def _matrix(self, element: ElementMatrices, material: Floats) -> csc_array:
        return summed_matrix(self.manifold, element, material)

    def _vector(self, element: Callable[[ElementGroup], Floats]) -> Floats:
        return summed_vector(self.manifold, element)
