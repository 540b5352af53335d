"""Runs of whole numbers in ascending order: sorted, and searched, in compiled code.

What numba brings for it takes two seconds to compile, with slices assigned to slices and the words
of errors that never come: `sort` 0.8 for each type, `searchsorted` 0.4.
"""

from typing import TypeVar

import numpy as np

from integration.arrays import Index, Ints
from nmm.compiled import compiled

Whole = TypeVar("Whole", Index, Ints)


@compiled
def ascend(values: Whole) -> None:
    """Sort numbers, or a slice of some, in place (Shell 1959, gaps that shrink by 5/11)."""
    gap = len(values) // 2
    while gap > 0:
        for k in range(gap, len(values)):
            value, at = values[k], k
            while at >= gap and values[at - gap] > value:
                values[at] = values[at - gap]
                at -= gap
            values[at] = value
        gap = 1 if gap == 2 else gap * 5 // 11


@compiled
def place_of(wanted: int, values: Index, first: int, end: int) -> int:
    """Place of a number that is in ``values[first:end]``, which ascends."""
    while end - first > 1:
        middle = (first + end) // 2
        if values[middle] > wanted:
            end = middle
        else:
            first = middle
    return first


@compiled
def extended(values: Whole, length: int) -> Whole:
    """Return the numbers with room for ``length`` of them."""
    longer = np.empty(length, dtype=values.dtype)
    for k in range(len(values)):
        longer[k] = values[k]
    return longer
