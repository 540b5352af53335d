"""Local functions singular at a point: first terms of the series of Williams (1952, 1957).

About a notch whose bisector is the x axis, with polar coordinates r and t,

    u_x = r^l [ (k - Q (l + 1)) cos(l t) - l cos((l - 2) t) ]
    u_y = r^l [ (k + Q (l + 1)) sin(l t) + l sin((l - 2) t) ]

for symmetric modes, and with sin for cos in u_x and -cos for sin in u_y for antisymmetric ones.
The faces ``t = +-a`` are traction-free for the exponents ``l`` and ratios ``Q`` of
`covers.local_functions.corner_functions`; ``l = 1/2`` is the crack tip.
"""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats


@dataclass(frozen=True)
class SingularFunctions:
    """Vector functions about a point.

    Attributes
    ----------
    exponent, ratio, symmetric
        ``l``, ``Q`` and symmetry of each of the n modes.
    kappa
        Kolosov's constant of the material: 3 - 4 nu in plane strain, (3 - nu) / (1 + nu) in plane
        stress.
    length
        Radius (m) at which the functions have a size of about one.
    """

    exponent: tuple[float, ...]
    ratio: tuple[float, ...]
    symmetric: tuple[bool, ...]
    kappa: float
    length: float

    @property
    def number(self) -> int:
        """Number of modes."""
        return len(self.exponent)

    def evaluate(self, radius: Floats, angle: Floats) -> tuple[Floats, Floats]:
        """Return values (m, n, 2) and gradients (m, n, 2 components, 2 directions).

        Both in the axes of the notch; ``angle`` (m,) lies between the faces.
        """
        pairs = [self._mode(mode, radius, angle) for mode in range(self.number)]
        return np.stack([u for u, _ in pairs], 1), np.stack([g for _, g in pairs], 1)

    def values(self, radius: Floats, angle: Floats) -> Floats:
        """Return the values (m, n, 2) alone, in the axes of the notch."""
        modes = range(self.number)
        found = [self._scale(one, radius) * self._angular(one, angle)[0] for one in modes]
        return np.stack(found, 1)

    def _mode(self, mode: int, radius: Floats, angle: Floats) -> tuple[Floats, Floats]:
        value, slope = self._angular(mode, angle)
        scale = self._scale(mode, radius)
        gradient = _cartesian(self.exponent[mode] * value, slope, angle)
        return scale * value, (scale / radius[:, None])[:, :, None] * gradient

    def _scale(self, mode: int, radius: Floats) -> Floats:
        """Factor (m, 1) of the angular functions of a mode."""
        return ((radius / self.length) ** self.exponent[mode])[:, None]

    def _angular(self, mode: int, angle: Floats) -> tuple[Floats, Floats]:
        """Functions (m, 2) of the angle, and their derivatives by it."""
        power, q = self.exponent[mode], self.ratio[mode]
        lead = np.array([self.kappa - q * (power + 1), self.kappa + q * (power + 1)])
        other = np.array([-power, power])
        shift = 0.0 if self.symmetric[mode] else np.pi / 2
        # Antisymmetric modes: cos -> sin and sin -> -cos is a shift of the angle by pi / 2.
        parts = [
            _wave(power, power * angle - shift, power, lead),
            _wave(power, (power - 2) * angle - shift, power - 2, other),
        ]
        return parts[0][0] + parts[1][0], parts[0][1] + parts[1][1]


def _wave(power: float, phase: Floats, rate: float, factor: Floats) -> tuple[Floats, Floats]:
    """Angular functions ``(a cos, b sin)`` (m, 2) and their derivatives by the angle."""
    c, s = np.cos(phase), np.sin(phase)
    return np.stack([factor[0] * c, factor[1] * s], 1), rate * np.stack(
        [-factor[0] * s, factor[1] * c], 1
    )


def _cartesian(by_radius: Floats, by_angle: Floats, angle: Floats) -> Floats:
    """Gradients (m, 2, 2) at radius one from derivatives (m, 2) by radius and by angle."""
    c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
    return np.stack([by_radius * c - by_angle * s, by_radius * s + by_angle * c], axis=2)
