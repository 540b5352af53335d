"""Where the entries of a matrix go in the panels of its factor."""

import numba as nb
import numpy as np
import numpy.typing as npt
from scipy.sparse import csc_array

from integration.arrays import Ints

Index = npt.NDArray[np.int32]
Shape = tuple[Ints, Ints, Ints, Ints]
"""First places, row starts, rows and panel starts of supernodes."""


@nb.njit(cache=True)
def lower_places(
    indptr: Index,
    indices: Index,
    order: Ints,
    first: Ints,
    row_start: Ints,
    rows: Ints,
    panel_start: Ints,
) -> tuple[Ints, Ints]:
    """Entries in the lower triangle, after ordering, and their places."""
    n = len(order)
    place = np.empty(n, dtype=np.int64)
    for k in range(n):
        place[order[k]] = k
    source = np.empty(len(indices), dtype=np.int64)
    target = np.empty(len(indices), dtype=np.int64)
    count = 0
    for s in range(len(first) - 1):
        columns = first[s + 1] - first[s]
        below = rows[row_start[s] : row_start[s + 1]]
        height = columns + len(below)
        for k in range(first[s], first[s + 1]):
            j = order[k]
            for e in range(indptr[j], indptr[j + 1]):
                i = place[indices[e]]
                if i < k:
                    continue
                inside = i < first[s + 1]
                row = i - first[s] if inside else columns + np.searchsorted(below, i)
                source[count] = e
                target[count] = panel_start[s] + (k - first[s]) * height + row
                count += 1
    return source[:count].copy(), target[:count].copy()


def upper_places(
    indptr: Index, indices: Index, order: Ints, shape: Shape, beside_start: Ints
) -> tuple[Ints, Ints]:
    """Entries above the diagonal, after ordering, and their places.

    Those of a pivot block go into its panel; those beside it follow all panels, transposed, and
    start at ``beside_start`` (S+1,) for every supernode.
    """
    n, (first, _, _, panel_start) = len(order), shape
    number = np.arange(len(indices))
    turned = csc_array((number, indices, indptr), shape=(n, n)).T.tocsc()
    pattern = turned.indptr.astype(np.int32), turned.indices.astype(np.int32)
    source, mirrored = lower_places(*pattern, order, *shape)
    s = np.searchsorted(panel_start, mirrored, side="right") - 1
    wide = np.diff(first)[s]
    high = np.diff(panel_start)[s] // wide
    column, row = np.divmod(mirrored - panel_start[s], high)
    inside = panel_start[s] + row * high + column
    beside = beside_start[s] + column * (high - wide) + row - wide
    target = np.where(row < wide, inside, beside)
    off = row != column
    return turned.data[source[off]], target[off]
