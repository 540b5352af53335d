"""A stress that is given at the points of bodies that bend by any angle, beside that of their law.

It is a second Piola-Kirchhoff stress ``S``, which turns and stretches with the material and stores
``S : E``: that of the start of a run, or what heat takes from a law that is linear in the Green
strain ``E``.
"""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.assembly.finite_strain.finite_matter import FiniteMatter
from nmm.assembly.finite_strain.gradients import green, kirchhoff, strain_rates, turning, volumes


@dataclass(frozen=True)
class GivenStress:
    """Forces of given stresses (Q, 3) at material points.

    Attributes
    ----------
    matter
        Its points.
    """

    matter: FiniteMatter

    def force(self, stress: Floats, *deformations: Floats) -> Floats:
        """Return the internal force (n,) at the mean of deformations (n,).

        At the mean of both ends of a step its work is exactly what is stored, and it makes no
        moment about the mean place.
        """
        middle = sum(deformations, start=np.zeros_like(deformations[0])) / len(deformations)
        rates = strain_rates(self.matter.points.strain(middle))
        return self.matter.force(middle, np.einsum("qij,qi->qj", rates, stress))

    def stiffness(self, stress: Floats, share: float) -> csc_array:
        """Return how the force turns (n, n) with a ``share`` of a motion."""
        return self.matter.stiffness(share * turning(stress))

    def energy(self, stress: Floats, deformation: Floats) -> float:
        """Return ``S : E`` over the bodies (J)."""
        strain = green(self.matter.points.strain(deformation))
        density = np.einsum("qi,qi->q", stress, strain)
        return self.matter.thickness * float(self.matter.points.rule.weights @ density)

    def mean(self, stress: Floats, deformation: Floats) -> Floats:
        """Return the mean Cauchy stress (E, 3) of the elements, in global axes (Pa)."""
        gradient, points = self.matter.points.strain(deformation), self.matter.points
        _, found = points.means(kirchhoff(gradient, stress))
        _, area = points.means(volumes(gradient)[:, None])
        return np.asarray(found / area)
