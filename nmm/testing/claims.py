"""How a property that is not kept is told: what, the number found, what was tolerated."""

import numpy as np
import numpy.typing as npt


def claim(kept: bool | np.bool_, sentence: str) -> None:
    """Raise unless a property is kept; unlike ``assert`` also under ``python -O``.

    Raises
    ------
    AssertionError
        With the sentence.
    """
    if not kept:
        raise AssertionError(sentence)


def close(
    what: str, found: npt.ArrayLike, expected: npt.ArrayLike, tolerance: float, why: str = ""
) -> None:
    """Claim that numbers are equal within a tolerance.

    Raises
    ------
    AssertionError
        Naming the property, the largest difference and the tolerance; also where shapes differ or
        a number is not finite.
    """
    one, other = np.asarray(found, dtype=float), np.asarray(expected, dtype=float)
    shape = np.broadcast_shapes(one.shape, other.shape) if one.ndim or other.ndim else ()
    claim(one.shape == shape, f"{what}: shape {one.shape}, expected {shape}")
    off = float(np.max(np.abs(one - other), initial=0.0))
    reason = f" ({why})" if why else ""
    claim(off <= tolerance, f"{what}: off by {off:.3g}, tolerance {tolerance:.3g}{reason}")


def finite(what: str, values: npt.ArrayLike) -> None:
    """Claim that all numbers are finite.

    Raises
    ------
    AssertionError
        Naming the first that is not.
    """
    array = np.asarray(values, dtype=float)
    bad = np.argwhere(~np.isfinite(array))
    claim(not len(bad), f"{what}: number {tuple(map(int, bad[0])) if len(bad) else ()} not finite")
