"""Which way cracks kink, and how near they are to it."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from nmm.fracture.criteria.base import CRITERIA
from nmm.verification.base import Case, Check, Checks

# K_I and K_II, and the kinks (degrees) and intensities of both criteria.
MIXED = ((1.0, 0.05), (1.0, 0.25), (1.0, 0.5), (1.0, 1.0), (0.2, 1.0), (0.0, 1.0))
ANGLES = {
    "hoop_stress": (-5.69651590, -25.33293861, -40.20781872, -53.13010235, -66.75956464,
                    -70.52877937),
    "strain_energy_density": (-5.678076, -24.164637, -37.627234, -51.906734, -74.630382,
                              -82.337744),
}  # fmt: skip
EQUIVALENT = (1.0037337395, 1.0853006672, 1.2827945709, 1.7888543820, 1.2673806457, 1.1547005384)
POISSON = 0.3


@dataclass(frozen=True)
class MixedKinks(Case):
    """Kinks of given intensities; no body is solved."""

    name = "GR1"
    title = "Kinks of cracks in mixed mode"
    source = "Largest hoop stress and least density in the sector where it pulls, by direct search"
    criterion: str = "hoop_stress"
    parameters: ClassVar = {"criterion": ANGLES}

    @property
    def variant(self) -> str:
        return self.criterion.replace("_", " ")

    def checks(self, formulation: str) -> Checks:
        one, two = np.transpose(MIXED)
        found = CRITERIA.make(self.criterion).kink(one, two, np.full(len(one), 3 - 4 * POISSON))
        exact = self.criterion == "hoop_stress"
        digits, reason = (1e-8, "digits of the table") if exact else (3e-6, "a search of values")
        checks = {}
        for n, (pair, expected) in enumerate(zip(MIXED, ANGLES[self.criterion], strict=True)):
            label = f"K_I, K_II = {pair[0]:g}, {pair[1]:g}"
            angle = float(np.degrees(found.angle[n]))
            checks[f"{label}: kink (deg)"] = Check(angle, expected, digits, reason, 1.0)
            if exact:
                size = float(found.equivalent[n])
                checks[f"{label}: K"] = Check(size, EQUIVALENT[n], 1e-10, "digits of the table")
        return checks
