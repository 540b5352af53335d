"""Rubber-like elasticity of finite strain."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.errors import FormulationError
from nmm.materials.base import FiniteResponse
from nmm.materials.elastic import Elastic
from nmm.materials.tensors import ISOTROPIC

# Newton's method for the stretch across a sheet: as many iterations, and the share of a stretch of
# one that the last may move it by.
MOST, ROUNDED = 50, 1e-15


@dataclass(frozen=True)
class NeoHookean(Elastic):
    """Compressible neo-Hookean law (Simo and Pister 1984; Bonet and Wood 2008, 6.4.3).

    ``W = mu / 2 (tr C - 3 - 2 ln J) + lambda / 2 (ln J)^2`` of the stretch ``C = F^T F`` and the
    change of volume ``J``, with Lame's constants of the moduli, for finite strain; at small strain,
    and in every formulation that knows no other, it is Hooke's law.
    """

    def __post_init__(self) -> None:
        if self.poisson_ratio >= 0.5:
            raise FormulationError(
                f"poisson_ratio: {self.poisson_ratio}: expected less than 1/2, where the volume "
                "resists infinitely: take for example 0.4999"
            )

    def potential(self, strain: Floats, plane: str) -> FiniteResponse:
        """See `Law.potential`; not a number where the volume is turned inside out."""
        e, nu = self.young_modulus, self.poisson_ratio
        mu, lame = e / (2 * (1 + nu)), e * nu / ((1 + nu) * (1 - 2 * nu))
        exx, eyy, twice = strain.T
        # C less one, and the change of area squared less one: exact where strains are small.
        growth = 2 * (exx + eyy)
        area = growth + 4 * exx * eyy - twice**2
        with np.errstate(invalid="ignore", divide="ignore"):
            log = np.log1p(area) / 2
            across = np.zeros_like(log) if plane == "strain" else _across(log, lame / mu)
            log = log + np.log1p(across) / 2
            energy = mu / 2 * (growth + across - 2 * log) + lame / 2 * log**2
            inverse = np.stack([1 + 2 * eyy, 1 + 2 * exx, -twice], axis=1) / (1 + area)[:, None]
        stress = mu * (ISOTROPIC - inverse) + (lame * log)[:, None] * inverse
        # d ln J / dE is the inverse of C, times what the sheet across gives way.
        volume = np.full_like(log, lame)
        if plane == "stress":
            volume = lame * mu * (1 + across) / (lame / 2 + mu * (1 + across))
        found = volume[:, None, None] * np.einsum("mi,mj->mij", inverse, inverse)
        found += 2 * (mu - lame * log)[:, None, None] * _products(inverse)
        return FiniteResponse(energy, stress, found)

    def potential_across(self, strain: Floats, plane: str) -> Floats:
        """See `Law.potential_across`: ``lambda ln J``, as nothing is stretched across."""
        if plane == "stress":
            return np.zeros(len(strain))
        e, nu = self.young_modulus, self.poisson_ratio
        exx, eyy, twice = strain.T
        area = 2 * (exx + eyy) + 4 * exx * eyy - twice**2
        return np.asarray(e * nu / ((1 + nu) * (1 - 2 * nu)) * np.log1p(area) / 2)


def _across(log: Floats, ratio: float) -> Floats:
    """Stretch squared less one (m,) across a sheet without stress there.

    It is the root of ``c + ratio (log + ln(1 + c) / 2)``, ``log`` (m,) that of the area.
    """
    found = np.zeros_like(log)
    for _ in range(MOST):
        off = found + ratio * (log + np.log1p(found) / 2)
        step = off / (1 + ratio / (2 * (1 + found)))
        # Concave: a step from the left falls short, one from the right stays inside.
        found = np.maximum(found - step, (found - 1) / 2)
        if not np.nanmax(np.abs(step), initial=0.0) > ROUNDED * np.nanmax(1 + found, initial=1.0):
            break
    return found


def _products(inverse: Floats) -> Floats:
    """``-1/2 d C^-1 / dE`` (m, 3, 3) in the components of stress and of strain (xx, yy, 2 xy)."""
    xx, yy, xy = inverse.T
    return np.stack(
        [
            np.stack([xx * xx, xy * xy, xx * xy], axis=1),
            np.stack([xy * xy, yy * yy, yy * xy], axis=1),
            np.stack([xx * xy, yy * xy, (xx * yy + xy * xy) / 2], axis=1),
        ],
        axis=1,
    )
