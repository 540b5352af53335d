"""The elastic stiffness and stress of a solid, with pressures that hold volumes."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from integration.arrays import Floats
from integration.contraction import contract
from integration.sparse import csc_array, csr_array
from nmm.assembly.elements import element_matrices
from nmm.assembly.elements.solid import Solid
from nmm.assembly.projected_volumes.excess import excess, held_pressures
from nmm.assembly.projected_volumes.pressures import Pressures
from nmm.materials.tensors import ISOTROPIC


@dataclass(frozen=True)
class ElasticSolid(Solid):
    """A solid with Hooke's law.

    Attributes
    ----------
    projected
        Whether pressures on patches resist changes of volume (`projected_volumes`).
    """

    projected: bool = False

    @cached_property
    def stiffness(self) -> csc_array:
        """Elastic stiffness (n_unknowns, n_unknowns)."""
        if not self.projected or self.pressures is None:
            return self._matrix(element_matrices.stiffness, self.thickness * self.elasticity)
        drained = self._matrix(element_matrices.stiffness, self.thickness * self.drained)
        held = csr_array(self.pressures.root @ self.pressures.divergence)
        return csc_array(drained + self.thickness * (held.T @ held))

    @cached_property
    def pressures(self) -> Pressures | None:
        """Pressures of materials that resist volume much more than shear; None without any.

        Where the volume is resisted in every point they serve edges alone
        (`nmm.constraints.nitsche.volume_lift`) and are of the degree of the strains, which are held
        exactly where they are polynomials.

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
        return np.asarray(
            self.elasticity - self.bulk[:, None, None] * np.outer(ISOTROPIC, ISOTROPIC)
        )

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

    def mean_stress(self, deformation: Floats, pressure: Floats | None = None) -> Floats:
        """Mean elastic stress (E, 3) in body axes of the unknowns ``deformation``.

        ``pressure`` (k,) is that of the patches where it is known better, see `pressure`.
        """
        strain = self.mean_strain(deformation)
        known = self.pressure(deformation) if pressure is None else pressure
        if known is None:
            return contract("eij,ej->ei", self.elasticity, strain)
        assert self.pressures is not None
        mean = (self.pressures.integrals(self.manifold) @ known) / self.element_area
        return np.asarray(contract("eij,ej->ei", self.drained, strain) + mean[:, None] * ISOTROPIC)
