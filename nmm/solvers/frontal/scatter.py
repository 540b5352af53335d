"""Where the entries of a matrix go in the panels of its factor."""

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Index, Ints
from nmm.compiled import compiled

Shape = tuple[Ints, Ints, Ints, Ints]
"""First places, row starts, rows and panel starts of supernodes."""


def lower_places(indptr: Index, indices: Index, order: Ints, shape: Shape) -> tuple[Ints, Ints]:
    """Entries in the lower triangle, after ordering, and their places."""
    nothing = np.empty(0, dtype=np.int64)
    return _places(indptr, indices, np.arange(len(indices)), order, *shape, nothing)


def upper_places(
    indptr: Index, indices: Index, order: Ints, shape: Shape, beside_start: Ints
) -> tuple[Ints, Ints]:
    """Entries above the diagonal, after ordering, and their places.

    Those of a pivot block go into its panel; those beside it follow all panels, transposed, and
    start at ``beside_start`` (S+1,) for every supernode.
    """
    n = len(indptr) - 1
    # The transpose, its entries the numbers of those of the pattern.
    turned = csc_array((np.arange(len(indices)), indices, indptr), shape=(n, n)).tocsr()
    pattern = turned.indptr.astype(np.int32), turned.indices.astype(np.int32)
    return _places(*pattern, turned.data, order, *shape, beside_start)


@compiled
def _places(
    indptr: Index,
    indices: Index,
    entry: Ints,
    order: Ints,
    first: Ints,
    row_start: Ints,
    rows: Ints,
    panel_start: Ints,
    beside_start: Ints,
) -> tuple[Ints, Ints]:
    """Lower triangle of a pattern, or of its transpose where there are starts beside panels."""
    n, above = len(order), len(beside_start) > 0
    place, local = np.empty(n, dtype=np.int64), np.empty(n, dtype=np.int64)
    for k in range(n):
        place[order[k]] = k
    source = np.empty(len(indices), dtype=np.int64)
    target = np.empty(len(indices), dtype=np.int64)
    count = 0
    for s in range(len(first) - 1):
        c, r = first[s + 1] - first[s], row_start[s + 1] - row_start[s]
        for k in range(c):
            local[first[s] + k] = k
        for k in range(r):
            local[rows[row_start[s] + k]] = c + k
        for k in range(c):
            j = order[first[s] + k]
            for e in range(indptr[j], indptr[j + 1]):
                i = place[indices[e]]
                if i < first[s] + k or (above and i == first[s] + k):
                    continue
                row = local[i]
                source[count] = entry[e]
                if not above:
                    target[count] = panel_start[s] + k * (c + r) + row
                elif row < c:
                    target[count] = panel_start[s] + row * (c + r) + k
                else:
                    target[count] = beside_start[s] + k * r + row - c
                count += 1
    return source[:count].copy(), target[:count].copy()
