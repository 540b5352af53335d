"""Radial kernels of meshless weights: value and derivative by r over the radius; zero at 1."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from integration.arrays import Floats

Kernel = Callable[[Floats], tuple[Floats, Floats]]


def cubic_spline(r: Floats) -> tuple[Floats, Floats]:
    """Return the cubic spline 2/3 - 4 r^2 + 4 r^3, beyond 1/2: 4/3 (1 - r)^3; twice differentiable.

    Belytschko, Lu and Gu (1994), eq. 27 in its later form.
    """
    rest = np.maximum(1 - r, 0.0)
    near = r <= 0.5
    value = np.where(near, 2 / 3 + 4 * r**2 * (r - 1), 4 / 3 * rest**3)
    return value, np.where(near, -8 * r + 12 * r**2, -4 * rest**2)


def quartic_spline(r: Floats) -> tuple[Floats, Floats]:
    """Return the quartic spline 1 - 6 r^2 + 8 r^3 - 3 r^4 = (1 - r)^3 (1 + 3 r)."""
    rest = np.maximum(1 - r, 0.0)
    return rest**3 * (1 + 3 * r), -12 * r * rest**2


def wendland(r: Floats) -> tuple[Floats, Floats]:
    """Return Wendland's (1995) function (1 - r)^4 (1 + 4 r), positive definite in the plane."""
    rest = np.maximum(1 - r, 0.0)
    return rest**4 * (1 + 4 * r), -20 * r * rest**3


KERNELS: dict[str, Kernel] = {
    "cubic_spline": cubic_spline,
    "quartic_spline": quartic_spline,
    "wendland": wendland,
}


def kernel(name: str) -> Kernel:
    """Return the kernel of that name.

    Raises
    ------
    ValueError
        An unknown name.
    """
    if name not in KERNELS:
        raise ValueError(f"kernel: {name!r}: expected one of {', '.join(KERNELS)}: choose one")
    return KERNELS[name]
