"""Damping of a contact spring that gives a prescribed coefficient of restitution."""

import numpy as np


def restitution(damping: float) -> float:
    """Coefficient of restitution of a spring and a damper that part when the force is zero.

    Schwager and Poeschel (2007), equations 21 to 23, for a share ``damping`` of critical damping.
    """
    if damping < 1:
        root = np.sqrt(1 - damping**2)
        angle = np.arctan2(2 * damping * root, 1 - 2 * damping**2)
        return float(np.exp(-damping / root * (np.pi - angle)))
    if damping == 1:
        return float(np.exp(-2.0))
    root = np.sqrt(damping - 1) * np.sqrt(damping + 1)
    return float(np.exp(-2 * damping / root * np.log(damping + root)))


def damping_of(coefficient: float) -> float:
    """Share of critical damping whose `restitution` is ``coefficient``, in (0, 1]."""
    from scipy.optimize import brentq

    if coefficient >= 1:
        return 0.0
    # Beyond critical damping it is below 1 / share^2.
    most = 1 / np.sqrt(coefficient)
    return float(brentq(lambda share: restitution(share) - coefficient, 0.0, most))
