"""What a criterion of growth is: from the intensities at a tip to a kink and its intensity."""

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.registry import Registry


@dataclass(frozen=True)
class Kink:
    """How cracks would go on.

    Attributes
    ----------
    angle
        (n,) from the direction ahead of each tip, counter-clockwise, rad.
    equivalent
        (n,) the intensity in opening alone that is as near to growth (Pa m^1/2): a crack grows
        where it reaches K_Ic. Zero and below where a crack is pressed shut.
    """

    angle: Floats
    equivalent: Floats


class Criterion(ABC):
    """Base of criteria: pure functions of the intensities and of Kolosov's constant.

    Intensities of any size have the same kink, intensities of opening alone none, and sliding the
    other way the mirrored one.
    """

    @abstractmethod
    def kink(self, opening: Floats, sliding: Floats, kappa: Floats) -> Kink:
        """Return the kinks of tips.

        Parameters
        ----------
        opening, sliding
            (n,) K_I and K_II (Pa m^1/2). K_II > 0 turns a crack clockwise.
        kappa
            (n,) Kolosov's constant, 3 - 4 nu in plane strain, (3 - nu) / (1 + nu) in plane stress.
        """


def hoop_angle(opening: Floats, sliding: Floats) -> Floats:
    """Angle (n,) of the largest hoop stress about a tip, without cancellation (rad)."""
    return np.asarray(2 * np.arctan2(-2 * sliding, opening + np.sqrt(opening**2 + 8 * sliding**2)))


CRITERIA: Registry[type[Criterion]] = Registry(
    "fracture criterion",
    Criterion,
    {
        "hoop_stress": "nmm.fracture.criteria.hoop_stress:HoopStress",
        "strain_energy_density": "nmm.fracture.criteria.strain_energy_density:StrainEnergyDensity",
        "straight_ahead": "nmm.fracture.criteria.straight_ahead:StraightAhead",
        "energy_release": "nmm.fracture.criteria.energy_release:EnergyRelease",
    },
)
