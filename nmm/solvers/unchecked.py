"""Sparse matrices made and multiplied without the checks of scipy's own operators.

A step multiplies by some twenty matrices and makes half a dozen, of blocks as few as two: checking
them takes ten times as long as the product. Results agree with those of scipy to the last digit.
"""

from collections.abc import Callable
from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt

from integration.arrays import Floats
from integration.sparse import csc_array, csr_array

Matrix = TypeVar("Matrix", csc_array, csr_array)


class _Products(dict[type, Callable[..., None]]):
    """Compiled products of scipy by the kind of matrix."""

    def __missing__(self, kind: type) -> Callable[..., None]:
        from scipy.sparse import _sparsetools, csc_array, csr_array

        self[csr_array], self[csc_array] = _sparsetools.csr_matvec, _sparsetools.csc_matvec
        if kind not in self:
            raise KeyError(kind)
        return self[kind]


class _Empty(dict[Any, tuple[Any, dict[str, Any]]]):
    """Kinds of matrices with what one without entries holds."""

    def __missing__(self, kind: Any) -> tuple[Any, dict[str, Any]]:
        made = kind((1, 1))
        self[kind] = type(made), vars(made)
        return self[kind]


_PRODUCTS, _EMPTY = _Products(), _Empty()


def product(matrix: csc_array | csr_array, vector: Floats) -> Floats:
    """Return ``matrix @ vector`` (n,) in floating-point numbers."""
    height, width = matrix.__dict__["_shape"]
    found = np.zeros(height)
    given = matrix.indptr, matrix.indices, matrix.data, vector, found
    _PRODUCTS[type(matrix)](height, width, *given)
    return found


def magnitudes(matrix: Matrix) -> Matrix:
    """Return the sizes of all entries; ``abs`` of a matrix would sort those of its own."""
    data, pattern = np.abs(matrix.data), (matrix.indices, matrix.indptr)
    return made_of(type(matrix), data, *pattern, matrix.shape)


def largest(matrix: Matrix) -> Floats:
    """Return the size of the largest entry (k,) of each column of csc, each row of csr; 0 of none.

    scipy's ``max`` would sort indices that `magnitudes` shares with the matrix, and not its data.
    """
    found, (some,) = np.zeros(len(matrix.indptr) - 1), np.diff(matrix.indptr).nonzero()
    if len(some):
        found[some] = np.maximum.reduceat(np.abs(matrix.data), matrix.indptr[some])
    return found


def made_of(
    kind: type[Matrix],
    data: Floats,
    indices: npt.NDArray[Any],
    indptr: npt.NDArray[Any],
    shape: tuple[int, int],
) -> Matrix:
    """Return a compressed matrix of arrays that fit each other, which it keeps."""
    true, empty = _EMPTY[kind]
    made: Matrix = true.__new__(true)
    parts = {"data": data, "indices": indices, "indptr": indptr, "_shape": shape}
    made.__dict__.update(empty | parts)
    return made
