"""Supernodes: columns of nested structure that are eliminated as one (Ashcraft, Grimes 1989)."""

import numpy as np

from integration.arrays import Ints
from integration.ragged import offsets, ranges
from nmm.compiled import compiled


@compiled
def supernodes(start: Ints, structure: Ints, parent: Ints, weight: Ints) -> Ints:
    """First node of every supernode, and the number of nodes at the end.

    Nested columns first; then a supernode takes in the one before it where that is its child and
    few zeros come with it.
    """
    n = len(parent)
    kept = np.empty(n + 1, dtype=np.int64)
    columns, below, zeros = np.empty(n), np.empty(n), np.empty(n)
    last = np.empty(n, dtype=np.int64)
    top = 0
    k = 0
    while k < n:
        begin = k
        size = float(weight[k])
        while (
            k + 1 < n
            and parent[k] == k + 1
            and start[k + 1] - start[k] == start[k + 2] - start[k + 1] + 1
        ):
            k += 1
            size += weight[k]
        rest = 0.0
        for e in range(start[k], start[k + 1]):
            rest += weight[structure[e]]
        kept[top], columns[top], below[top], zeros[top], last[top] = begin, size, rest, 0.0, k
        top += 1
        k += 1
        while top > 1:
            child, own = top - 2, top - 1
            above = parent[last[child]]
            if above < kept[own] or above > last[own]:
                break
            wide = columns[child] + columns[own]
            waste = columns[child] * (columns[own] + below[own] - below[child])
            total = zeros[child] + zeros[own] + waste
            part = total / (wide * (wide + 1) / 2 + wide * below[own])
            if not (part < 0.02 or (wide < 96 and part < 0.1) or (wide < 24 and part < 0.3)):
                break
            columns[child], below[child], zeros[child] = wide, below[own], total
            last[child] = last[own]
            top -= 1
    kept[top] = n
    return kept[: top + 1].copy()


def in_unknowns(
    first_node: Ints, start: Ints, structure: Ints, weight: Ints
) -> tuple[Ints, Ints, Ints, Ints]:
    """First places, row starts, rows and panel starts of supernodes, in unknowns."""
    at = offsets(weight)
    last = first_node[1:] - 1
    below_last, counts = ranges(start, last)
    nodes = structure[below_last]
    rows, width = ranges(at, nodes)
    owner = np.repeat(np.arange(len(last)), counts)
    below = np.bincount(owner, weights=width, minlength=len(last)).astype(np.int64)
    first = at[first_node]
    columns = np.diff(first)
    return first, offsets(below), rows, offsets(columns * (columns + below))


@compiled
def stack_of_updates(first: Ints, row_start: Ints, rows: Ints) -> tuple[Ints, int]:
    """Children of every supernode, and the largest stack of their updates."""
    count = len(first) - 1
    owner = np.empty(first[-1], dtype=np.int64)
    for s in range(count):
        for k in range(first[s], first[s + 1]):
            owner[k] = s
    children = np.zeros(count, dtype=np.int64)
    held = np.zeros(count, dtype=np.int64)
    level, most = 0, 0
    for s in range(count):
        below = row_start[s + 1] - row_start[s]
        most = max(most, level + below * below)
        level += below * below - held[s]
        if below:
            above = owner[rows[row_start[s]]]
            children[above] += 1
            held[above] += below * below
    return children, most
