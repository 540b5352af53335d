"""Laws of crack speed: a part of the Rayleigh wave speed that grows with the energy flow."""

from collections.abc import Callable

import numpy as np

from integration.arrays import Floats, Ints
from nmm.assembly.model import Model

# From K / K_Ic (n,) of the crack at rest to the speed of the tip over the Rayleigh wave speed.
SpeedLaw = Callable[[Floats], Floats]


def freund(share: Floats) -> Floats:
    """Relative speeds (n,) at which the energy flow equals the fracture energy.

    The flow into a running tip is ``G (1 - v / c_R)`` to 1 %, with G of the same crack at rest
    (Freund 1990, 7.4). Equal to G_c it gives ``v = c_R (1 - G_c / G)``.
    """
    reached = np.maximum(share, 1.0)
    return np.asarray(1 - 1 / reached**2)


def rayleigh_bound(share: Floats) -> Floats:
    """Relative speeds (n,) of tips that run at the Rayleigh wave speed once they are critical."""
    return np.asarray((share >= 1.0).astype(float))


SPEEDS: dict[str, SpeedLaw] = {"freund": freund, "rayleigh": rayleigh_bound}
"""Laws of crack speed by their names in a scene."""


def rayleigh_speeds(model: Model, element: Ints, kappa: Floats) -> Floats:
    """Rayleigh wave speeds (n,) in elements (n,) of Kolosov's constant ``kappa`` (n,) (m/s)."""
    shear = model.elasticity[element, 2, 2]
    part = np.array([rayleigh_part(float(one)) for one in kappa])  # a handful of tips
    return np.asarray(part * np.sqrt(shear / model.density[element]))


def rayleigh_part(kappa: float) -> float:
    """Rayleigh over shear wave speed: ``(2 - s)^2 = 4 sqrt(1 - s) sqrt(1 - s q)``.

    ``s`` is the square of this ratio, and ``q = (kappa - 1) / (kappa + 1)`` the square of shear
    over pressure wave speed, in plane strain as in plane stress. The squared equation is a cubic
    with one root between 0 and 1.
    """
    q = (kappa - 1) / (kappa + 1)
    roots = np.roots([1.0, -8.0, 24.0 - 16.0 * q, -16.0 * (1.0 - q)])
    real = roots[np.abs(roots.imag) < 1e-9].real
    return float(np.sqrt(real[(real > 0) & (real < 1)].max()))
