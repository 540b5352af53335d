"""Criterion of minimum strain energy density (Sih 1974)."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.fracture.criteria.base import Criterion, Kink, hoop_angle
from nmm.fracture.criteria.extremes import minimum_from


@dataclass(frozen=True)
class StrainEnergyDensity(Criterion):
    """A crack grows towards the minimum of the strain energy density, when that is K_Ic's.

    ``S = a11 K_I^2 + 2 a12 K_I K_II + a22 K_II^2`` is the strain energy density times the distance
    from the tip. Of its minima the one nearest to the maximum hoop stress is taken; those near the
    faces of the crack have no tension.
    """

    def kink(self, opening: Floats, sliding: Floats, kappa: Floats) -> Kink:
        size = np.maximum(np.hypot(opening, sliding), 1e-300)
        one, two = opening / size, sliding / size
        start = hoop_angle(one, two)
        angle = minimum_from(start, lambda t: _slopes(t, one, two, kappa))
        # Straight ahead in pure mode I the density is 2 (kappa - 1) K_I^2 in these units.
        density = _density(angle, one, two, kappa) / (2 * (kappa - 1))
        pulls = np.cos(angle / 2) * one - 3 * np.sin(angle / 2) * two
        equivalent = np.where(pulls > 0, size * np.sqrt(np.maximum(density, 0.0)), 0.0)
        return Kink(angle, np.asarray(equivalent))


def _density(t: Floats, one: Floats, two: Floats, kappa: Floats) -> Floats:
    """S times 16 pi times the shear modulus, at angles (n,)."""
    c, s = np.cos(t), np.sin(t)
    a11 = (1 + c) * (kappa - c)
    a12 = s * (2 * c - kappa + 1)
    a22 = (kappa + 1) * (1 - c) + (1 + c) * (3 * c - 1)
    return np.asarray(a11 * one**2 + 2 * a12 * one * two + a22 * two**2)


def _slopes(t: Floats, one: Floats, two: Floats, kappa: Floats) -> tuple[Floats, Floats]:
    c, s, c2, s2 = np.cos(t), np.sin(t), np.cos(2 * t), np.sin(2 * t)
    k = kappa - 1
    first = (s2 - k * s) * one**2 + 2 * (2 * c2 - k * c) * one * two + (k * s - 3 * s2) * two**2
    second = (
        (2 * c2 - k * c) * one**2 + 2 * (k * s - 4 * s2) * one * two + (k * c - 6 * c2) * two**2
    )
    return np.asarray(first), np.asarray(second)
