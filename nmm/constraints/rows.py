"""Sparse rows of displacements at points."""

import numpy as np
from scipy.sparse import csr_array

from integration.arrays import Floats, Ints

# Directions of the components.
AXES = np.eye(2)


def sparse_rows(unknowns: Ints, values: Floats, n: int) -> csr_array:
    """Matrix (2m, n) of rows (m, 2, L) with unknowns (m, L), component minor."""
    m, _, length = values.shape
    columns = np.repeat(unknowns[:, None, :], 2, axis=1)
    offsets = np.arange(2 * m + 1) * length
    found = csr_array((values.ravel(), columns.ravel(), offsets), shape=(2 * m, n))
    found.sum_duplicates()
    return found
