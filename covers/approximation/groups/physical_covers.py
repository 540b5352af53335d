"""Physical covers as arrays, and their unknowns on an element."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from covers.local_functions.polynomials import LocalFunctions
from integration.arrays import Floats, Ints


@dataclass(frozen=True)
class PhysicalCovers:
    """Physical covers as arrays.

    Attributes
    ----------
    patch, body
        (C,) mathematical patch and body.
    centre, matrix
        (C, 2) and (C, 2, 2) local coordinates ``matrix (x - centre)`` of the local functions.
    first_unknown
        (C,) first unknown of each.
    """

    patch: Ints
    body: Ints
    centre: Floats
    matrix: Floats
    first_unknown: Ints


def unknowns_of(functions: Sequence[LocalFunctions], covers: PhysicalCovers, active: Ints) -> Ints:
    """Return the unknowns (n, L) of elements, cover after cover."""
    first = covers.first_unknown[active]
    return np.concatenate(
        [first[:, [k]] + np.arange(item.n_unknowns) for k, item in enumerate(functions)], axis=1
    )


def covers_of(functions: Sequence[LocalFunctions]) -> Ints:
    """Return the position (S,) of the cover of each scalar function."""
    return np.repeat(np.arange(len(functions)), [item.n_functions for item in functions])


def combined(functions: Sequence[LocalFunctions]) -> Floats | None:
    """Return the combination (2S, L) of all covers of an element; None for the identity."""
    if all(item.combination is None for item in functions):
        return None
    size = sum(2 * item.n_functions for item in functions)
    out = np.zeros((size, sum(item.n_unknowns for item in functions)))
    row = column = 0
    for item in functions:  # three or four covers
        part = item.combination
        block = np.eye(item.n_unknowns) if part is None else part
        out[row : row + len(block), column : column + block.shape[1]] = block
        row, column = row + len(block), column + block.shape[1]
    return out
