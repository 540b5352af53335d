"""Diagonal of a matrix and a scaled copy of it, each in one sweep of compiled code."""

import numpy as np

from integration.arrays import Floats, Index
from nmm.compiled import compiled, place


@compiled
def scaled_data(
    indptr: Index, indices: Index, data: Floats, scale: Floats, shift: float
) -> tuple[Floats, int]:
    """Entries of ``diag(scale) A diag(scale) + shift``, and how many columns have a diagonal.

    On 100 bricks it takes 30 us, array operations 100.
    """
    found = np.empty(len(data))
    diagonals = 0
    for j in range(len(scale)):
        own = scale[j]
        for k in range(place(indptr[j]), place(indptr[j + 1])):
            i = indices[k]
            found[k] = data[k] * scale[place(i)] * own
            if i == j:
                found[k] += shift
                diagonals += 1
    return found, diagonals


@compiled
def diagonal(indptr: Index, indices: Index, data: Floats) -> Floats:
    """Entries (n,) on the diagonal of compressed columns."""
    found = np.zeros(len(indptr) - 1)
    for j in range(len(found)):
        for k in range(place(indptr[j]), place(indptr[j + 1])):
            if indices[k] == j:
                found[j] += data[k]
    return found
