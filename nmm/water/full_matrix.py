"""Matrices that are full among some unknowns: what water links by one pressure field.

Such a matrix takes `ENTRY` bytes for each pair of its unknowns over a run, with its sums and
factors: it is refused where there is not as much memory (`refuse_full`).
"""

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats, Ints
from nmm import capacity

# Bytes for each entry of the matrix: value and index, once more in a sum, and in a factor.
ENTRY = 48


def full_matrix(block: Floats, used: Ints, n: int) -> csc_array:
    """Return the matrix (n, n) with the symmetric part of ``block`` (k, k) at ``used`` (k,).

    Indices ``used`` ascend. Columns are laid out at once: triplets would take four times as much.
    """
    even = (block + block.T) / 2
    length = np.zeros(n + 1, dtype=np.int64)
    length[used + 1] = len(used)
    rows = np.tile(used, len(used))
    return csc_array((even.ravel(), rows, np.cumsum(length)), shape=(n, n))


def refuse_full(place: str, count: int, remedy: str) -> None:
    """Refuse a full matrix over ``count`` unknowns that memory cannot hold.

    Raises
    ------
    NmmError
        There is less memory.
    """
    capacity.refuse(place, f"{count} unknowns", ENTRY * count**2, remedy)
