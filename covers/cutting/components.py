"""Connected components and groups, numbered in the order of their first members."""

from __future__ import annotations

import numpy as np

from integration.arrays import Floats, Ints
from integration.permutations import inverse


def components(n: int, first: Ints, second: Ints) -> Ints:
    """Connected component (n,) of each of ``n`` things, given pairs (p,) of connected ones.

    Each thing points to a lower one or to itself. Roots that a pair joins are hooked, the higher to
    the lower, and pointers followed to their ends, until no pair is apart: at each pass half of
    the roots that have a neighbour go (Shiloach, Vishkin 1982).
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
    """Where pointers (n,) that lead to lower places end."""
    while True:  # each pass doubles the way
        further = pointer[pointer]
        if (further == pointer).all():
            return pointer
        pointer = further


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
    rank = inverse(order)
    return first[order], rank[group]
