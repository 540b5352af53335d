"""Orders of rows, read both ways."""

import numpy as np

from integration.arrays import Ints


def inverse(order: Ints) -> Ints:
    """Return where each row (n,) stands in an order (n,) that names every row once."""
    place = np.empty(len(order), dtype=np.int64)
    place[order] = np.arange(len(order))
    return place
