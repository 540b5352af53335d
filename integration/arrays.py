"""Names of the array types that the three packages share."""

from typing import Any

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]
Bools = npt.NDArray[np.bool_]
Index = npt.NDArray[np.int32]  # patterns of sparse matrices


def columns(*parts: Floats) -> Floats:
    """Vectors (m,) as the columns (m, k) of one array: `numpy.stack` by two calls, not fourteen."""
    return np.array(parts).T.copy()


def same(one: npt.NDArray[Any], other: npt.NDArray[Any]) -> bool:
    """Whether two arrays are one object, or as long as each other with the same entries."""
    if one is other or one.shape != other.shape:
        return one is other
    return bool(np.logical_and.reduce(one == other, axis=None))
