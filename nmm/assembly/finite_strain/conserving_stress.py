"""The stress of a step whose work is the energy that matter gains in it, to rounding.

``S = S(E_m) + (W_1 - W_0 - S(E_m) : dE) / (dE : dE) dE`` with the mean ``E_m`` of the Green strains
at both ends (Gonzalez 2000). For a law that is linear in the Green strain the second term vanishes,
and it is the mean of both stresses (Simo and Tarnow 1992).
"""

from collections.abc import Callable

import numpy as np

from integration.arrays import Floats
from nmm.materials.base import FiniteResponse

# Weights of (xx, yy, 2 xy) in the product of two strains.
PRODUCT = np.array([1.0, 1.0, 0.5])


def conserving_stress(
    potential: Callable[[Floats], FiniteResponse], before: Floats, after: Floats
) -> FiniteResponse:
    """Return the stress (m, 3) of a step between Green strains (m, 3), its tangent by ``after``.

    The energy is that at the end.
    """
    start, middle, end = (potential(one) for one in (before, (before + after) / 2, after))
    change = after - before
    across = PRODUCT * change
    square = (across * change).sum(axis=1)
    # Where nothing strains there is nothing to put right.
    inverse = np.divide(1.0, square, out=np.zeros_like(square), where=square > 0)
    missing = end.energy - start.energy - (middle.stress * change).sum(axis=1)
    share = missing * inverse
    slope = end.stress - middle.stress - np.einsum("mij,mj->mi", middle.tangent, change) / 2
    slope = (slope - 2 * share[:, None] * across) * inverse[:, None]
    tangent = middle.tangent / 2 + across[:, :, None] * slope[:, None, :]
    tangent = tangent + share[:, None, None] * np.diag(PRODUCT)
    return FiniteResponse(end.energy, middle.stress + share[:, None] * across, tangent)
