"""Corner functions: the singular fields at a re-entrant corner with traction-free faces."""

import numpy as np
from scipy.optimize import brentq

from covers.local_functions.singular_functions import SingularFunctions

# Exponents this near to one belong to rotations, which polynomials contain.
ROTATION = 0.02


def corner_functions(
    angle: float, kappa: float, length: float, both: bool = False
) -> SingularFunctions:
    """Return the singular modes of a corner of given angle (Williams 1952).

    Parameters
    ----------
    angle
        Angle that the material fills, between pi and 2 pi (rad). One mode is singular below 257.4
        degrees, two above.
    kappa, length
        See `SingularFunctions`.
    both
        Whether to include the first antisymmetric mode where its stress is bounded, too.

    Raises
    ------
    ValueError
        The corner is not re-entrant.
    """
    if not np.pi < angle <= 2 * np.pi:
        raise ValueError(
            f"corner: angle {angle:.6g}: more than pi and at most 2 pi expected: only re-entrant "
            "corners have singular stresses"
        )
    half = angle / 2
    first, second = _exponent(half, 1.0), _exponent(half, -1.0)
    assert first is not None  # it exists at every re-entrant corner
    ratio = -(first - 1) / (first + 1) * _sines(first, half)
    if second is None and both:
        second = _exponent(half, -1.0, 1 + ROTATION, 2.0) or 1 + ROTATION
    if second is None:
        return SingularFunctions((first,), (ratio,), (True,), kappa, length)
    return SingularFunctions(
        (first, second), (ratio, -_sines(second, half)), (True, False), kappa, length
    )


def _sines(power: float, half: float) -> float:
    return float(np.sin((power - 1) * half) / np.sin((power + 1) * half))


def _exponent(half: float, sign: float, least: float = 0.4, most: float = 1 - 1e-9) -> float | None:
    """Smallest root of ``sin(2 l a) + sign l sin(2 a) = 0`` within bounds; None without one."""

    def equation(power: float) -> float:
        return float(np.sin(2 * power * half) + sign * power * np.sin(2 * half))

    grid = np.linspace(least, most, 241)
    values = np.array([equation(power) for power in grid])
    change = np.flatnonzero(values[:-1] * values[1:] <= 0)
    if not len(change):
        return None
    return float(brentq(equation, grid[change[0]], grid[change[0] + 1], xtol=1e-15, rtol=1e-14))
