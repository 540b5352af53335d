"""Connected components and groups, numbered in the order of their first members."""

from __future__ import annotations

import numpy as np

from integration.arrays import Floats, Ints
from integration.permutations import inverse


def components(n: int, first: Ints, second: Ints) -> Ints:
    """Return the connected component (n,) of each of ``n`` things, given connected pairs (p,).

    Each thing points to a lower one or to itself. Of two roots that a pair connects the higher is
    hooked to the lower, and pointers are followed to their ends, until all pairs are in one
    component. Each pass removes at least half of the roots with neighbours (Shiloach and Vishkin
    1982).
    """
    root = np.arange(n)
    one, two = first, second
    while len(one):  # as many passes as the logarithm of the largest component
        low, high = np.minimum(one, two), np.maximum(one, two)
        np.minimum.at(root, high, low)
        root = _ends(root)
        one, two = root[one], root[two]
        apart = one != two
        one, two = one[apart], two[apart]
    return np.asarray((np.cumsum(root == np.arange(n)) - 1)[root])


def _ends(pointer: Ints) -> Ints:
    """Ends (n,) of chains of pointers (n,) to lower places."""
    while True:  # each pass doubles the length followed
        further = pointer[pointer]
        if (further == pointer).all():
            return pointer
        pointer = further


def unique_rows(points: Floats) -> tuple[Ints, Ints]:
    """Return first occurrences (k,) of distinct points (n, 2), and the number (n,) of each."""
    order = np.lexsort((points[:, 1], points[:, 0]))
    ordered = points[order]
    new = np.ones(len(points), dtype=bool)
    new[1:] = (ordered[1:] != ordered[:-1]).any(axis=1)
    group = np.empty(len(points), dtype=np.int64)
    group[order] = np.cumsum(new) - 1
    return by_first_occurrence(group, order[new])  # the sort is stable: first means first


def by_first_occurrence(group: Ints, first: Ints) -> tuple[Ints, Ints]:
    """Renumber groups (n,) by their first members (k,); return first members and groups."""
    order = np.argsort(first)
    rank = inverse(order)
    return first[order], rank[group]
