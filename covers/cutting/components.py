"""Connected components and groups, numbered in the order of their first members."""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array

from integration.arrays import Floats, Ints


def components(n: int, first: Ints, second: Ints) -> Ints:
    """Connected component (n,) of each of ``n`` things, given pairs (p,) of connected ones."""
    from scipy.sparse.csgraph import connected_components

    graph = csr_array((np.ones(len(first), dtype=np.int8), (first, second)), shape=(n, n))
    label = connected_components(graph, directed=False)[1].astype(np.int64)
    return by_first_occurrence(label, np.unique(label, return_index=True)[1])[1]


def unique_rows(points: Floats) -> tuple[Ints, Ints]:
    """First occurrences (k,) of the distinct rows of points (n, 2), in order, and each row (n,)."""
    order = np.lexsort((points[:, 1], points[:, 0]))
    ordered = points[order]
    new = np.ones(len(points), dtype=bool)
    new[1:] = (ordered[1:] != ordered[:-1]).any(axis=1)
    group = np.empty(len(points), dtype=np.int64)
    group[order] = np.cumsum(new) - 1
    return by_first_occurrence(group, order[new])  # the sort is stable: first means first


def by_first_occurrence(group: Ints, first: Ints) -> tuple[Ints, Ints]:
    """Groups (n,) renumbered in the order of their first members (k,): first members, groups."""
    order = np.argsort(first)
    rank = np.empty(len(first), dtype=np.int64)
    rank[order] = np.arange(len(first))
    return first[order], rank[group]
