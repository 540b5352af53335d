"""Stress and intensities of cracks that start at a hole, as dislocations beside a free circle."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import numpy.typing as npt

from integration.arrays import Floats

Complexes = npt.NDArray[np.complex128]

Potentials = tuple[Complexes, Complexes, Complexes]
"""Derivatives ``phi'``, ``phi''`` and ``psi'`` of the potentials of Muskhelishvili (1953)."""


@dataclass(frozen=True)
class HoleWithCracks:
    """A plane with a hole of radius 1 and cracks along x from it, under unit tension along y.

    The cracks are edge dislocations ``A(x)`` that leave the hole free of traction. The integral
    equation of free crack faces has a Cauchy kernel and is solved at Chebyshev's points (Erdogan
    and Gupta 1972). The whole of hole and crack carries no dislocation, so that one crack leaves
    the opposite of its opening at the mouth in the hole; two leave nothing.

    Attributes
    ----------
    length
        Of each crack, in radii.
    both
        Whether there is a crack on either side, else on the right alone.
    points
        Number of points of a crack.
    """

    length: float
    both: bool
    points: int = 200

    @cached_property
    def places(self) -> Floats:
        """Where dislocations are (n,)."""
        k = np.arange(self.points)
        return 1 + self.length / 2 * (1 + np.cos((2 * k + 1) * np.pi / (2 * self.points)))

    @cached_property
    def smooth(self) -> Floats:
        """Density (n,) of dislocations times the root that grows at the tip."""
        n = self.points
        x = 1 + self.length / 2 * (1 + np.cos(np.pi * np.arange(1, n) / n))
        rows = self._stress_of_each(x.astype(np.complex128))[:, :, 1]
        # No root grows at the mouth: the interpolant is zero there.
        mouth = (-1.0) ** np.arange(n) * np.tan((2 * np.arange(n) + 1) * np.pi / (4 * n)) / n
        applied = 1 + 0.5 / x**2 + 1.5 / x**4
        matrix = np.vstack([rows * np.pi / n * self.length / 2, mouth])
        return np.linalg.solve(matrix, np.append(-applied, 0.0))

    @property
    def intensity(self) -> float:
        """K_I at a tip."""
        k = np.arange(self.points)
        tip = (-1.0) ** k / np.tan((2 * k + 1) * np.pi / (4 * self.points)) / self.points
        return float(abs(tip @ self.smooth) * np.pi * np.sqrt(2 * np.pi * self.length))

    def stress(self, points: Floats) -> Floats:
        """Stress (m, 3) at points (m, 2) away from the cracks, in units of the tension."""
        z = points[:, 0] + 1j * points[:, 1]
        tension = _stress(z, *_of_tension(z))
        share = self.smooth * np.pi / self.points * self.length / 2
        return np.asarray(tension + np.einsum("mnc,n->mc", self._stress_of_each(z), share))

    def _stress_of_each(self, z: Complexes) -> Floats:
        """Stress (m, n, 3) at points (m,) of unit dislocations, and what balances them."""
        z, places = z[:, None], self.places[None, :]
        balance = _of_dislocations(z, -places) if self.both else _of_hole(z)
        found = _of_dislocations(z, places)
        return _stress(z, *(one - other for one, other in zip(found, balance, strict=True)))


def _of_dislocations(z: Complexes, b: Floats) -> Potentials:
    """Unit dislocations across x at ``b`` beside the free circle, which has none in it."""
    outer = 1 / (z * (1 - b * z))
    pole = b * (1 / b**2 - 1) / (1 - b * z) ** 2
    image = outer - pole
    slope = -(1 - 2 * b * z) * outer**2 - 2 * b * pole / (1 - b * z)
    psi = outer - 1 / (b * z**2) + image / z**2 - slope / z
    own = 1 / (z - b)
    return own + image, slope - own**2, psi + own + b * own**2


def _of_hole(z: Complexes) -> Potentials:
    """A unit dislocation across x in the free circle itself."""
    return 1 / z, -1 / z**2, 1 / z + 2 / z**3


def _of_tension(z: Complexes) -> Potentials:
    """Unit tension along y about the free circle (Kirsch 1898)."""
    return 0.25 + 0.5 / z**2, -1 / z**3, 0.5 + 0.5 / z**2 + 1.5 / z**4


def _stress(
    z: Complexes,
    first: Complexes,
    slope: Complexes,
    second: Complexes,
) -> Floats:
    """Stress (..., 3): xx + yy = 4 Re phi', yy - xx + 2 i xy = 2 (conj(z) phi'' + psi')."""
    mean, apart = 2 * first.real, z.conj() * slope + second
    return np.stack([mean - apart.real, mean + apart.real, apart.imag], axis=-1)
