"""A manifold with materials: the matrices and loads of the solid, in body frames."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse import csc_array, csr_array, diags_array

from covers.cut_cells import CutCells
from covers.element_groups import ElementGroup
from covers.manifold import Manifold
from integration.arrays import Floats, Ints
from integration.polygons import areas
from nmm.assembly import element_matrices
from nmm.assembly.blocks import Part, assemble
from nmm.assembly.lumping import check_positive


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
    cut
        How the cut left a mathematical cover; None for blocks.
    """

    manifold: Manifold
    elasticity: Floats
    density: Floats
    modulus: Floats
    thickness: float
    cut: CutCells | None = None
    lumped: bool = False

    @cached_property
    def stiffness(self) -> csc_array:
        """Elastic stiffness (n_unknowns, n_unknowns)."""
        return self._matrix(element_matrices.stiffness, self.thickness * self.elasticity)

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
        found.eliminate_zeros()
        check_positive(found, self.manifold.cover_offset)
        return found

    @cached_property
    def consistent_mass(self) -> csc_array:
        """Mass of the displacement field, whatever the choice for `mass`."""
        return self._matrix(element_matrices.mass, self.thickness * self.density)

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

    def mean_stress(self, deformation: Floats) -> Floats:
        """Mean elastic stress (E, 3) in body axes of the unknowns ``deformation``."""
        return np.asarray(np.einsum("eij,ej->ei", self.elasticity, self.mean_strain(deformation)))

    def mean_strain(self, deformation: Floats) -> Floats:
        """Mean strain (E, 3) of the unknowns ``deformation``."""
        strain = np.empty((len(self.density), 3))
        for group, rows in zip(self.manifold.groups, self._strain_rows, strict=True):
            local = deformation[group.unknowns]
            strain[group.elements] = np.einsum("nil,nl->ni", rows[group.shape], local)
        return strain / self.element_area[:, None]

    @cached_property
    def element_area(self) -> Floats:
        """(E,) areas of the elements in the reference place (m2)."""
        return areas(self.manifold.elements)

    @cached_property
    def _strain_rows(self) -> list[Floats]:
        return [element_matrices.mean_strain_rows(group) for group in self.manifold.groups]

    def _matrix(
        self, element: Callable[[ElementGroup, Ints, Floats], Floats], material: Floats
    ) -> csc_array:
        """Sum element matrices; congruent elements of equal ``material`` (E, ...) share one."""
        parts = []
        for group in self.manifold.groups:  # a handful of groups
            shape, first, kind = _kinds(group.shape, material[group.elements])
            matrices = element(group, shape, material[group.elements[first]])
            parts.append(Part(group.unknowns, matrices, kind))
        return assemble(parts, self.manifold.n_unknowns, self.manifold.cover_offset)

    def _vector(self, element: Callable[[ElementGroup], Floats]) -> Floats:
        total = np.zeros(self.manifold.n_unknowns)
        for group in self.manifold.groups:  # a handful of groups
            total += np.bincount(
                group.unknowns.ravel(), element(group).ravel(), minlength=len(total)
            )
        return total


def _kinds(shape: Ints, material: Floats) -> tuple[Ints, Ints, Ints]:
    """Shape (m,) and first element (m,) of each kind of element, and the kind (n,) of each."""
    _, first = np.unique(shape, return_index=True)
    if np.array_equal(material[first][shape], material):
        return np.arange(len(first)), first, shape
    rows = np.column_stack([shape, material.reshape(len(shape), -1)])
    _, first, kind = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    return shape[first], first, kind.ravel()
