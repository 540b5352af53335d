"""The base of mixed-mode criteria: from K_I and K_II to a kink angle and an equivalent K."""

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.registry import Registry


@dataclass(frozen=True)
class Kink:
    """The direction in which cracks would grow, and how near they are to growing.

    Attributes
    ----------
    angle
        (n,) kink angle from the direction ahead of each tip, counter-clockwise (rad).
    equivalent
        (n,) K_I in pure mode I that is as near to growth (Pa m^1/2): a crack grows when it reaches
        K_Ic. Zero or negative where a crack is closed.
    """

    angle: Floats
    equivalent: Floats


class Criterion(ABC):
    """Base of mixed-mode criteria: pure functions of K_I, K_II and Kolosov's constant.

    The kink angle must not depend on the magnitude of the intensity factors, be zero in pure mode
    I, and change its sign with K_II.
    """

    @abstractmethod
    def kink(self, opening: Floats, sliding: Floats, kappa: Floats) -> Kink:
        """Return the kinks of n tips.

        Parameters
        ----------
        opening, sliding
            (n,) K_I and K_II (Pa m^1/2). K_II > 0 turns a crack clockwise.
        kappa
            (n,) Kolosov's constant, 3 - 4 nu in plane strain, (3 - nu) / (1 + nu) in plane stress.
        """


def hoop_angle(opening: Floats, sliding: Floats) -> Floats:
    """Angle (n,) of the maximum hoop stress about a tip (rad), in a form without cancellation."""
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
