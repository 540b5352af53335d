"""What is known of a load that is left of forces that cancel."""

import numpy as np

from integration.arrays import Floats

LEAST = 1e-6
"""Part of forces that cancel below which what is left of them is not looked at more closely."""


def known_load(among: Floats) -> float:
    """Return the size of a load from which on it counts as it is, left of forces ``among`` (n,).

    Their rounding does work on motions without strain, where functions depend on one another, and
    nothing balances it. A load a million times as small as they are would be judged by that.
    """
    return LEAST * float(np.sqrt(np.einsum("i,i->", among, among)))
