"""Gradients of displacement, Green strains, and how one changes with the other.

Gradients ``H = F - 1`` are written (xx, xy, yx, yy), component first and direction second, as are
stresses by force and direction as it was (first Piola-Kirchhoff). The Green strain
``(F^T F - 1) / 2`` is written (xx, yy, 2 xy), so that its product with a second Piola-Kirchhoff
stress (xx, yy, xy) is work.
"""

import numpy as np

from integration.arrays import Floats


def green(gradient: Floats) -> Floats:
    """Return the Green strain (m, 3), exact where gradients (m, 4) are small."""
    a, b, c, d = gradient.T
    return np.stack(
        [a + (a * a + c * c) / 2, d + (b * b + d * d) / 2, b + c + a * b + c * d], axis=1
    )


def strain_rates(gradient: Floats) -> Floats:
    """Return the derivative (m, 3, 4) of the Green strain by the gradient (m, 4)."""
    a, b, c, d = gradient.T
    found = np.zeros((len(gradient), 3, 4))
    found[:, 0, 0], found[:, 0, 2] = 1 + a, c
    found[:, 1, 1], found[:, 1, 3] = b, 1 + d
    found[:, 2, 0], found[:, 2, 1], found[:, 2, 2], found[:, 2, 3] = b, 1 + a, 1 + d, c
    return found


def turning(stress: Floats) -> Floats:
    """Return how the force of second Piola-Kirchhoff stresses (m, 3) turns: (m, 4, 4).

    It is the derivative of ``strain_rates^T S`` by the gradient at a stress that stays, the
    geometric part of a tangent.
    """
    xx, yy, xy = stress.T
    found = np.zeros((len(stress), 4, 4))
    for first in (0, 2):
        found[:, first, first], found[:, first + 1, first + 1] = xx, yy
        found[:, first, first + 1] = found[:, first + 1, first] = xy
    return found


def volumes(gradient: Floats) -> Floats:
    """Return the determinants (m,) of the deformation gradient: areas over what they were."""
    a, b, c, d = gradient.T
    return np.asarray((1 + a) * (1 + d) - b * c)


def kirchhoff(gradient: Floats, stress: Floats) -> Floats:
    """Return the Kirchhoff stress ``F S F^T`` (m, 3: xx, yy, xy): Cauchy's times the volume."""
    f = np.eye(2) + gradient.reshape(-1, 2, 2)
    tensor = f @ stress[:, [[0, 2], [2, 1]]] @ np.swapaxes(f, 1, 2)
    return np.stack([tensor[:, 0, 0], tensor[:, 1, 1], tensor[:, 0, 1]], axis=1)
