"""A material law of one's own with an internal variable: rock that creeps in shear."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.materials.base import History, Response
from nmm.materials.elastic import Elastic

# From strain (xx, yy, 2 xy) to its deviator (xx, yy, 2 xy, zz) in plane strain.
DEVIATOR = np.array([[2, -1, 0], [-1, 2, 0], [0, 0, 3], [-1, -1, 0]]) / 3
VOLUME = np.array([1.0, 1.0, 0.0])


@dataclass(frozen=True)
class Maxwell(Elastic):
    """Elastic in volume; in shear a spring and a dashpot in series, in plane strain.

    Attributes
    ----------
    viscosity
        Of the dashpot (Pa s): what creeps is ``s / (2 viscosity)`` a second of a stress s.
    """

    viscosity: float = 1e18

    def variables(self, plane: str) -> History:
        """Return the strain of the dashpot (xx, yy, 2 xy, zz)."""
        if plane == "stress":
            raise ValueError("made for plane strain alone")
        return {"viscous_strain": np.zeros(4)}

    def update(self, strain: Floats, history: History, plane: str, step: float) -> Response:
        """Return the stress at the end of a step of ``step`` seconds (backward Euler)."""
        shear = self.young_modulus / 2 / (1 + self.poisson_ratio)
        bulk = self.young_modulus / 3 / (1 - 2 * self.poisson_ratio)
        relaxed = 1 + step * shear / self.viscosity
        left = (strain @ DEVIATOR.T - history["viscous_strain"]) / relaxed
        tensor = np.array([1.0, 1.0, 0.5]) * left[:, :3]
        stress = 2 * shear * tensor + bulk * np.outer(strain @ VOLUME, VOLUME)
        tangent = 2 * shear / relaxed * np.array([1.0, 1.0, 0.5])[:, None] * DEVIATOR[:3]
        tangent = tangent + bulk * np.outer(VOLUME, VOLUME)
        crept = strain @ DEVIATOR.T - left
        return Response(stress, np.tile(tangent, (len(strain), 1, 1)), {"viscous_strain": crept})

    def energy(self, stress: Floats, history: History, plane: str) -> Floats:
        """Return what the springs store (J/m3); the dashpot has lost the rest."""
        e, nu = self.young_modulus, self.poisson_ratio
        xx, yy, xy = stress.T
        zz = nu * (xx + yy) - e * history["viscous_strain"][:, 3]
        squares = xx**2 + yy**2 + zz**2 + 2 * (1 + nu) * xy**2
        return np.asarray((squares / 2 - nu * (xx * yy + yy * zz + zz * xx)) / e)
