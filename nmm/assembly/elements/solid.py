"""A solid on a manifold: integrals over its elements whatever its law, of mass, loads, strain."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from covers.approximation.groups.element_group import ElementGroup
from covers.approximation.manifold import Manifold
from covers.cutting.cut_cells import CutCells
from integration.arrays import Floats
from integration.contraction import contract
from integration.sparse import csc_array, csr_array, diags_array
from nmm.assembly.elements import element_matrices
from nmm.assembly.elements.element_sums import ElementMatrices, summed_matrix, summed_vector
from nmm.assembly.elements.lumping import check_positive


@dataclass(frozen=True)
class Solid:
    """What is approximated, and how heavy and stiff it is.

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
    cut
        How the cut left the mathematical cover; every block is a whole cell.
    lumped
        Whether the mass couples no cover with another.
    point_mass
        (n, n) of masses at points, which joins the mass; None without any.
    """

    manifold: Manifold
    elasticity: Floats
    density: Floats
    modulus: Floats
    thickness: float
    cut: CutCells
    lumped: bool = False
    point_mass: csc_array | None = None

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

    @cached_property
    def rigid_spread(self) -> csc_array:
        """(n_unknowns, 3 B) from forces and moments of bodies to forces on the unknowns."""
        return csc_array(self.rigid_projection.T)

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
        return self.manifold.elements.areas

    @cached_property
    def _strain_rows(self) -> list[Floats]:
        return [element_matrices.mean_strain_rows(group) for group in self.manifold.groups]

    def _matrix(self, element: ElementMatrices, material: Floats) -> csc_array:
        return summed_matrix(self.manifold, element, material)

    def _vector(self, element: Callable[[ElementGroup], Floats]) -> Floats:
        return summed_vector(self.manifold, element)
