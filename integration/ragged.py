"""Ragged arrays: rows of one array in consecutive ranges between offsets."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from integration.arrays import Floats, Ints


def offsets(counts: npt.ArrayLike) -> Ints:
    """Offsets (n + 1,) of ranges of given lengths (n,)."""
    ends = np.cumsum(np.asarray(counts, dtype=np.int64), dtype=np.int64)
    return np.concatenate([np.zeros(1, dtype=np.int64), ends])


def ranges(bounds: Ints, chosen: Ints) -> tuple[Ints, Ints]:
    """Rows (m,) of the chosen ranges (k,), one after the other, and the length (k,) of each."""
    counts = np.diff(bounds)[chosen]
    return np.repeat(bounds[:-1][chosen], counts) + within(counts), counts


def within(counts: Ints) -> Ints:
    """Place (m,) of each row in its range, of ranges of given lengths (n,)."""
    return np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)


def sums(values: Floats, bounds: Ints) -> Floats:
    """Sum (n, ...) of the rows (m, ...) of each range, none of which may be empty."""
    if len(bounds) == 1:
        return np.zeros((0, *values.shape[1:]))
    return np.add.reduceat(values, bounds[:-1], axis=0)
