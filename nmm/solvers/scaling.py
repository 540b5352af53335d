"""Scaling of matrices to entries of about one, before they are decomposed."""

import sys

import numpy as np

from integration.arrays import Floats
from integration.sparse import csc_array
from nmm.solvers.unchecked import largest, made_of


def jacobi_scale(matrix: csc_array) -> Floats:
    """(n,) ``1/sqrt(|a_ii|)``; the largest entry of the column stands in for a zero diagonal."""
    diagonal = np.abs(_diagonal(matrix))
    if (diagonal == 0.0).any():
        column = largest(matrix)
        diagonal = np.where(diagonal > 0, diagonal, np.where(column > 0, column, 1.0))
    return np.asarray(1.0 / np.sqrt(diagonal))


SWEEPS = 3
"""Of Ruiz's scaling."""


def ruiz_scale(matrix: csc_array) -> Floats:
    """(n,) factors that bring the largest entry of every row and column near one (Ruiz 2001)."""
    scale = np.ones(matrix.shape[0])
    for _ in range(SWEEPS):
        now = scaled(matrix, scale, 0.0)
        entry = np.maximum(largest(now.tocsr()), largest(now))
        scale = scale / np.sqrt(np.where(entry > 0, entry, 1.0))
    return scale


def scaled(matrix: csc_array, scale: Floats, shift: float) -> csc_array:
    """``diag(scale) matrix diag(scale)`` plus ``shift`` on the diagonal; zeros keep their place."""
    data, diagonals = _scaled_data(matrix, scale, shift)
    scaled = made_of(csc_array, data, matrix.indices, matrix.indptr, matrix.shape)
    scaled.has_sorted_indices = matrix.has_sorted_indices
    if shift and diagonals < len(scale):
        from scipy.sparse import eye_array

        data, _ = _scaled_data(matrix, scale, 0.0)
        plain = csc_array((data, matrix.indices, matrix.indptr), shape=matrix.shape)
        scaled = csc_array(plain + shift * eye_array(len(scale)))
    return scaled


def _scaled_data(matrix: csc_array, scale: Floats, shift: float) -> tuple[Floats, int]:
    """Scaled entries, the shift added to those on the diagonal, and the number of these."""
    if _compiles(matrix):
        from nmm.solvers.kernels.scaling_kernel import scaled_data

        return scaled_data(matrix.indptr, matrix.indices, matrix.data, scale, shift)
    column = np.repeat(np.arange(len(scale)), np.diff(matrix.indptr))
    data = matrix.data * scale[matrix.indices] * scale[column]
    diagonal = np.flatnonzero(matrix.indices == column)
    data[diagonal] += shift
    return data, len(diagonal)


def _diagonal(matrix: csc_array) -> Floats:
    """(n,) entries on the diagonal."""
    if _compiles(matrix):
        from nmm.solvers.kernels.scaling_kernel import diagonal

        return diagonal(matrix.indptr, matrix.indices, matrix.data)
    return np.asarray(matrix.diagonal())


def _compiles(matrix: csc_array) -> bool:
    """Whether the process has imported compiled code, and it is made for the matrix."""
    return "numba" in sys.modules and bool(matrix.indices.dtype == np.int32)
