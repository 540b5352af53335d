"""Isotropic linear elasticity in plane stress and plane strain."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.materials.base import Law


@dataclass(frozen=True)
class Elastic(Law):
    """Hooke's law.

    Attributes
    ----------
    young_modulus
        Pa.
    poisson_ratio
        Between -1 and 0.5.
    """

    young_modulus: float
    poisson_ratio: float

    def stiffness(self, plane: str) -> Floats:
        """Return the plane stiffness; plane strain is plane stress with E/(1-nu^2), nu/(1-nu)."""
        e, nu = self.young_modulus, self.poisson_ratio
        if plane == "strain":
            e, nu = e / (1 - nu**2), nu / (1 - nu)
        return e / (1 - nu**2) * np.array([[1, nu, 0], [nu, 1, 0], [0, 0, (1 - nu) / 2]])

    def kolosov(self, plane: str) -> float:
        """Return ``(3 - nu) / (1 + nu)`` in plane stress, ``3 - 4 nu`` in plane strain."""
        nu = self.poisson_ratio
        return 3 - 4 * nu if plane == "strain" else (3 - nu) / (1 + nu)

    @property
    def modulus(self) -> float:
        """Young's modulus (Pa)."""
        return self.young_modulus


def elastic_energy(
    young_modulus: float, poisson_ratio: float, stress: Floats, zz: Floats
) -> Floats:
    """Return the energy (m,) in J/m3 of stresses (m, 3: xx, yy, xy) and (m,) across."""
    xx, yy, xy = stress.T
    squares = xx**2 + yy**2 + zz**2 + 2 * (1 + poisson_ratio) * xy**2
    mixed = poisson_ratio * (xx * yy + yy * zz + zz * xx)
    return np.asarray((squares / 2 - mixed) / young_modulus)
