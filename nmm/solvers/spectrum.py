"""Ends of the spectrum of a symmetric matrix against a definite one."""

from typing import Any

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats

# Systems of fewer unknowns are solved whole.
WHOLE = 200

Mode = tuple[float, Floats]
"""An eigenvalue and its vector (n,), of unit size in the definite matrix."""


def highest(matrix: csc_array, against: csc_array) -> Mode:
    """Return the highest eigenvalue of positive semidefinite matrices, to four digits."""
    return _end(matrix, against, matrix.shape[0] - 1, {"which": "LM", "tol": 1e-4})


def lowest(matrix: csc_array, against: csc_array) -> Mode:
    """Return the eigenvalue nearest to zero of many unknowns, the lowest of few, to six digits."""
    return _end(matrix, against, 0, {"sigma": 0.0, "tol": 1e-6})


def _end(matrix: csc_array, against: csc_array, place: int, search: dict[str, Any]) -> Mode:
    if matrix.shape[0] < WHOLE:
        from scipy.linalg import eigh

        chosen = (place, place)
        values, modes = eigh(matrix.toarray(), against.toarray(), subset_by_index=chosen)
    else:
        from scipy.sparse.linalg import eigsh

        start = np.random.default_rng(0).normal(size=matrix.shape[0])
        values, modes = eigsh(matrix, 1, against, v0=start, **search)
    return float(values[-1]), np.asarray(modes[:, -1])
