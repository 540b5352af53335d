"""Determinants of acoustic tensors: whether a band of strain can begin in matter.

Strain may jump across a band with the normal ``n`` where ``Q = n C n`` of the tangents ``C`` is
singular (Hadamard 1903; Rudnicki and Rice 1975). Where its determinant is negative for some normal
the equations of equilibrium are no longer elliptic.
"""

from dataclasses import dataclass
from typing import Self

import numpy as np

from integration.arrays import Floats

# A determinant is a polynomial in cosines and sines of 2 and 4 times the angle: five tell it.
_KNOWN = np.pi * np.arange(5) / 5
# Angles (rad) among which the least is looked for, one degree apart, and then refined.
_TRIED = np.pi * np.arange(180) / 180
_REFINED = 3


@dataclass(frozen=True)
class Determinants:
    """Determinants of the acoustic tensors of m tangents over the angle of the normal.

    Attributes
    ----------
    terms
        (m, 5) factors of 1, cos and sin of twice, cos and sin of four times the angle (Pa^2).
    """

    terms: Floats

    @classmethod
    def of(cls, tangent: Floats) -> Self:
        """Return those of tangents (m, 3, 3) from strain (xx, yy, 2 xy) to stress (Pa)."""
        c, s = np.cos(_KNOWN), np.sin(_KNOWN)
        zero = np.zeros_like(c)
        normal = np.stack([np.stack([c, zero, s]), np.stack([zero, s, c])], axis=1)
        tensor = np.einsum("pia,mpq,qja->maij", normal, tangent, normal)
        values = tensor[..., 0, 0] * tensor[..., 1, 1] - tensor[..., 0, 1] * tensor[..., 1, 0]
        return cls(values @ np.linalg.inv(_waves(_KNOWN)).T)

    def at(self, angle: Floats) -> Floats:
        """Return the determinants (m, k) at normals of angles (k,) from x (rad)."""
        return np.asarray(self.terms @ _waves(angle).T)

    def least(self) -> tuple[Floats, Floats]:
        """Return the least determinants (m,) over all normals, and the angles (m,) of these."""
        angle = _TRIED[self.at(_TRIED).argmin(axis=1)]
        for _ in range(_REFINED):  # Newton's method, from within half a degree
            slope, bend = (np.einsum("mk,mk->m", self.terms, _waves(angle, n)) for n in (1, 2))
            bends = bend > 0
            angle = angle - np.where(bends, slope / np.where(bends, bend, 1.0), 0.0).clip(
                -0.01, 0.01
            )
        return np.einsum("mk,mk->m", self.terms, _waves(angle)), angle


def _waves(angle: Floats, derivative: int = 0) -> Floats:
    """Return (k, 5): 1, cos and sin of twice and four times angles (k,), or their derivatives."""
    turn = derivative * np.pi / 2
    waves = [np.full_like(angle, 0.0 if derivative else 1.0)]
    for n in (2, 4):
        waves += [
            n**derivative * np.cos(n * angle + turn),
            n**derivative * np.sin(n * angle + turn),
        ]
    return np.stack(waves, axis=1)
