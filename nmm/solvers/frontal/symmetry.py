"""Whether a sparse matrix is its own mirror image."""

import numpy as np

from integration.arrays import Floats, Index
from nmm.compiled import compiled


@compiled
def skew(indptr: Index, indices: Index, data: Floats) -> tuple[float, bool]:
    """Largest difference of a matrix with sorted rows from its mirror image; alike in pattern."""
    n = len(indptr) - 1
    at = np.empty(n, dtype=np.int64)  # next entry below the diagonal of each column
    most, alike = 0.0, True
    for j in range(n):
        k = indptr[j]
        while k < indptr[j + 1] and indices[k] < j:
            i = indices[k]
            while at[i] < indptr[i + 1] and indices[at[i]] < j:
                most, alike = max(most, abs(data[at[i]])), False
                at[i] += 1
            if at[i] < indptr[i + 1] and indices[at[i]] == j:
                most = max(most, abs(data[k] - data[at[i]]))
                at[i] += 1
            else:
                most, alike = max(most, abs(data[k])), False
            k += 1
        if k < indptr[j + 1] and indices[k] == j:
            k += 1
        at[j] = k
    for j in range(n):
        for k in range(at[j], indptr[j + 1]):
            most, alike = max(most, abs(data[k])), False
    return most, alike
