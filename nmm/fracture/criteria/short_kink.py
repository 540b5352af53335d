"""Stress intensity factors at the tip of an infinitesimal kink from those of the main crack.

``k = F(angle) K``, with series in m = angle / pi for traction-free faces (Amestoy and Leblond
1992). They hold for any load and any isotropic material.
"""

import numpy as np
from numpy.polynomial import Polynomial

from integration.arrays import Floats

P = np.pi

# Coefficients of m^0, m^2, ... of F11 and F22, of m, m^3, ... of F12 and F21.
F11 = (
    1.0, -3 * P**2 / 8, P**2 - 5 * P**4 / 128, P**2 / 9 - 11 * P**4 / 72 + 119 * P**6 / 15360,
    5.07790, -2.88312, -0.0925, 2.996, -4.059, 1.63, 4.1,
)  # fmt: skip
F12 = (
    -3 * P / 2, 10 * P / 3 + P**3 / 16, -2 * P - 133 * P**3 / 180 + 59 * P**5 / 1280,
    12.313906, -7.32433, 1.5793, 4.0216, -6.915, 4.21, 4.56,
)  # fmt: skip
F21 = (
    P / 2, -4 * P / 3 - P**3 / 48, -2 * P / 3 + 13 * P**3 / 30 - 59 * P**5 / 3840,
    -6.176023, 4.44112, -1.5340, -2.0700, 4.684, -3.95, -1.32,
)  # fmt: skip
F22 = (
    1.0, -4 - 3 * P**2 / 8, 8 / 3 + 29 * P**2 / 18 - 5 * P**4 / 128,
    -32 / 15 - 4 * P**2 / 9 - 1159 * P**4 / 7200 + 119 * P**6 / 15360,
    10.58254, -4.78511, -1.8804, 7.280, -7.591, 0.25, 12.5,
)  # fmt: skip


def _series(coefficients: tuple[float, ...], odd: int) -> Polynomial:
    spread = np.zeros(2 * len(coefficients) - 1 + odd)
    spread[odd::2] = coefficients
    return Polynomial(spread)


SERIES = ((_series(F11, 0), _series(F12, 1)), (_series(F21, 1), _series(F22, 0)))


def kink_intensities(
    angle: Floats, opening: Floats, sliding: Floats, order: int = 0
) -> tuple[Floats, Floats]:
    """Return k_I and k_II (..., n) at the tip of a short kink, or their derivatives by the angle.

    Parameters
    ----------
    angle
        (..., n) kink angle, up to 120 degrees either way (rad).
    opening, sliding
        (n,) K_I and K_II of the main crack (Pa m^1/2).
    order
        Order of the derivative.
    """
    (a, b), (c, d) = (
        tuple(one.deriv(order)(angle / P) / P**order for one in row) for row in SERIES
    )
    return np.asarray(a * opening + b * sliding), np.asarray(c * opening + d * sliding)
