"""Maxwell's, Kelvin's, the standard and Burgers' solids, in shape."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.materials.viscous.base import Rheology, Viscous, above_zero

# An instant counts as this share of Kelvin's time: without time his dashpot would be rigid.
INSTANT = 1e-6


@dataclass(frozen=True)
class Maxwell(Viscous):
    """A spring and a dashpot in series: creep without bound, complete relaxation.

    Attributes
    ----------
    viscosity
        Of the dashpot (Pa s): a shear stress t flows by ``t / viscosity`` a second.
    """

    viscosity: float

    def __post_init__(self) -> None:
        above_zero(viscosity=self.viscosity)

    @property
    def branches(self) -> Rheology:
        return Rheology(0.0, np.array([self.shear]), np.array([self.viscosity / self.shear]))


@dataclass(frozen=True)
class Kelvin(Viscous):
    """A spring and a dashpot in parallel: elastic in the end, and nearly rigid at first.

    The modulus is that of the spring. A step is exact where stress is constant; an instant counts
    as 1e-6 of the time ``viscosity / G``.

    Attributes
    ----------
    viscosity
        Of the dashpot (Pa s).
    """

    viscosity: float

    def __post_init__(self) -> None:
        above_zero(viscosity=self.viscosity)

    @property
    def branches(self) -> Rheology:
        return Rheology(self.shear, np.zeros(0), np.zeros(0))

    def stiff(self, step: float) -> float:
        ratio = max(step * self.shear / self.viscosity, INSTANT)
        return float(-self.shear / np.expm1(-ratio))


@dataclass(frozen=True)
class StandardSolid(Viscous):
    """A spring in series with Kelvin's: elastic at once, softer in the end.

    Attributes
    ----------
    delayed_modulus, delayed_viscosity
        Shear modulus (Pa) and viscosity (Pa s) of what gives way in time.
    """

    delayed_modulus: float
    delayed_viscosity: float

    def __post_init__(self) -> None:
        above_zero(delayed_modulus=self.delayed_modulus, delayed_viscosity=self.delayed_viscosity)

    @property
    def branches(self) -> Rheology:
        both = self.shear + self.delayed_modulus
        modulus, time = self.shear**2 / both, self.delayed_viscosity / both
        spring = self.shear * self.delayed_modulus / both
        return Rheology(spring, np.array([modulus]), np.array([time]))


@dataclass(frozen=True)
class Burgers(Viscous):
    """Maxwell's and Kelvin's in series: creep that slows down to a constant rate.

    Attributes
    ----------
    viscosity
        Of Maxwell's dashpot (Pa s).
    delayed_modulus, delayed_viscosity
        Shear modulus (Pa) and viscosity (Pa s) of Kelvin's spring and dashpot.
    """

    viscosity: float
    delayed_modulus: float
    delayed_viscosity: float

    def __post_init__(self) -> None:
        above_zero(
            viscosity=self.viscosity,
            delayed_modulus=self.delayed_modulus,
            delayed_viscosity=self.delayed_viscosity,
        )

    @property
    def branches(self) -> Rheology:
        """See `Viscous.branches`; two of Maxwell's act as the chain does (Findley et al. 1976)."""
        relaxes = self.shear / self.viscosity
        delays = self.delayed_modulus / self.delayed_viscosity
        fast = relaxes + self.shear / self.delayed_viscosity + delays
        rates = _roots(fast, relaxes * delays)
        moduli = self.shear * (rates - delays) / (rates - rates[::-1])
        return Rheology(0.0, moduli, 1 / rates)


def _roots(total: float, product: float) -> Floats:
    """Return the two positive numbers of a given sum and product, the larger one first."""
    large = (total + np.sqrt(total**2 - 4 * product)) / 2
    return np.array([large, product / large])
