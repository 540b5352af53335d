"""Products with normal and tangential rows (m, n) of contacts, compiled: one pass over both."""

from typing import Any

import numpy as np
import numpy.typing as npt

from integration.arrays import Floats
from integration.sparse import csc_array, csr_array
from nmm.compiled import compiled, place
from nmm.solvers.unchecked import magnitudes

Index = npt.NDArray[Any]
Compressed = tuple[Index, Index, Floats]
"""Pointers, numbers and entries of a compressed matrix."""


def compressed(matrix: csr_array | csc_array) -> Compressed:
    """Return a matrix as compiled code takes it."""
    return matrix.indptr, matrix.indices, matrix.data


def stretched(normal_rows: csr_array, tangent_rows: csr_array, increment: Floats) -> Floats:
    """(2, m) how far each contact opens and slips (m) under unknowns (n,)."""
    moved = np.empty((2, normal_rows.shape[0]))
    for rows, found in zip((normal_rows, tangent_rows), moved, strict=True):
        products_along(compressed(rows), increment, found)
    return moved


def terms_of_stretches(
    normal_rows: csr_array, tangent_rows: csr_array, increment: Floats
) -> Floats:
    """(2, m) sums of the sizes of the terms of which `stretched` is made (m): what it rounds."""
    return stretched(magnitudes(normal_rows), magnitudes(tangent_rows), np.abs(increment))


def along(rows: csr_array, increment: Floats) -> Floats:
    """(m,) ``rows @ increment``."""
    found = np.empty(rows.shape[0])
    products_along(compressed(rows), increment, found)
    return found


def pushed(
    normal_rows: csr_array, tangent_rows: csr_array, normal: Floats, shear: Floats
) -> Floats:
    """(n,) ``normal_rows.T @ normal + tangent_rows.T @ shear``: what forces (N) do on unknowns."""
    found = np.zeros(normal_rows.shape[1])
    push(compressed(normal_rows), compressed(tangent_rows), normal, shear, found)
    return found


@compiled
def products_along(rows: Compressed, x: Floats, found: Floats) -> None:
    """Write the products of compressed rows with ``x`` (n,) to ``found`` (m,)."""
    pointers, columns, entries = rows
    for c in range(len(pointers) - 1):
        total = 0.0
        for k in range(place(pointers[c]), place(pointers[c + 1])):
            total += entries[k] * x[place(columns[k])]
        found[c] = total


@compiled
def push(
    normal_rows: Compressed, tangent_rows: Compressed, normal: Floats, shear: Floats, found: Floats
) -> None:
    """Add what normal and shear forces (m,) do to ``found`` (n,)."""
    normal_pointers, normal_columns, normal_entries = normal_rows
    tangent_pointers, tangent_columns, tangent_entries = tangent_rows
    for c in range(len(normal)):
        for k in range(place(normal_pointers[c]), place(normal_pointers[c + 1])):
            found[place(normal_columns[k])] += normal_entries[k] * normal[c]
        for k in range(place(tangent_pointers[c]), place(tangent_pointers[c + 1])):
            found[place(tangent_columns[k])] += tangent_entries[k] * shear[c]
