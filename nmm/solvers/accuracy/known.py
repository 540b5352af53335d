"""The part of a load that is significant where it is a sum of forces that cancel."""

from collections.abc import Sequence

import numpy as np

from integration.arrays import Floats
from integration.sparse import csc_array
from nmm.solvers.norm import norm
from nmm.solvers.unchecked import magnitudes

LEAST = 1e-6
"""Part of forces that cancel below which what is left of them is not looked at more closely."""

RESOLVED = 1e-6
"""Share of forces that cancel from which on their sum is a load without a closer look."""
TERMS = 4.0
"""Roundings of a product of a matrix: errors of a row's terms add up as the root of their number,
and the solution that it is computed from left about one rounding more."""


def known_load(among: Floats) -> float:
    """Return the size of a load from which on it counts as it is, left of forces ``among`` (n,).

    Their rounding does work on motions without strain, where functions depend on one another, and
    nothing balances it. A load a million times as small as they are would be judged by that.
    """
    return LEAST * norm(among)


def is_rounding(
    force: Floats, parts: Sequence[Floats], share: float, matrix: csc_array, at: Floats
) -> bool:
    """Whether a force (n,) is nothing but rounding of the parts that it is the sum of.

    That is no load that dependent functions can carry: it does work on motions without strain.

    Parameters
    ----------
    parts
        (n,) each: the sum of which is less than ``share`` of their sizes where they cancel.
    matrix, at
        (n, n) stiffness and the unknowns (n,) that it is multiplied by in one of the parts. Soft
        bodies move far by little strain: the product is the difference of forces far larger than
        itself, and is known to the rounding of these (Higham 2002, 3.5).
    """
    size, left = sum(norm(part) for part in parts), norm(force)
    if left < share * size:
        return True
    if left > RESOLVED * size:
        return False
    return left < TERMS * float(np.finfo(float).eps) * gross(matrix, at)


def gross(matrix: csc_array, at: Floats) -> float:
    """Return the size of what a matrix (n, n) times unknowns (n,) is the sum of."""
    return norm(magnitudes(matrix) @ np.abs(at))
