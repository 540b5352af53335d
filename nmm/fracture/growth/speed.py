"""How fast tips run: never faster than Rayleigh's wave, and slower where little energy comes in."""

from collections.abc import Callable

import numpy as np

from integration.arrays import Floats, Ints
from nmm.assembly.model import Model

# From the share (n,) of the toughness that tips at rest have reached to their speed, as a part of
# that of Rayleigh's wave.
SpeedLaw = Callable[[Floats], Floats]


def freund(share: Floats) -> Floats:
    """Parts (n,) at which what comes in is what growth takes.

    A tip that runs takes in ``G (1 - v / c_R)``, G that of the same crack at rest, to 1 % (Freund
    1990, 7.4). That this is G_c makes ``v = c_R (1 - G_c / G)``.
    """
    reached = np.maximum(share, 1.0)
    return np.asarray(1 - 1 / reached**2)


def rayleigh_bound(share: Floats) -> Floats:
    """Parts (n,) of tips that run as fast as they can once they are critical."""
    return np.asarray((share >= 1.0).astype(float))


SPEEDS: dict[str, SpeedLaw] = {"freund": freund, "rayleigh": rayleigh_bound}
"""Laws of speed by their names in a scene."""


def rayleigh_speeds(model: Model, element: Ints, kappa: Floats) -> Floats:
    """Speeds (n,) of Rayleigh's wave in elements (n,) of Kolosov's constant ``kappa`` (m/s)."""
    shear = model.elasticity[element, 2, 2]
    part = np.array([rayleigh_part(float(one)) for one in kappa])  # a handful of tips
    return np.asarray(part * np.sqrt(shear / model.density[element]))


def rayleigh_part(kappa: float) -> float:
    """Speed of Rayleigh's wave over that of shear: ``(2 - s)^2 = 4 sqrt(1 - s) sqrt(1 - s q)``.

    ``s`` is its square and ``q = (kappa - 1) / (kappa + 1)`` that of shear over that of pressure,
    in plane strain as in plane stress. Squared it is a cubic with one root between 0 and 1.
    """
    q = (kappa - 1) / (kappa + 1)
    roots = np.roots([1.0, -8.0, 24.0 - 16.0 * q, -16.0 * (1.0 - q)])
    real = roots[np.abs(roots.imag) < 1e-9].real
    return float(np.sqrt(real[(real > 0) & (real < 1)].max()))
