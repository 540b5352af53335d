"""Nested dissection (George 1973) of a graph that comes without coordinates.

Nodes get places in the plane from their distances to a few landmarks (Brandes, Pich 2007: pivot
scaling), and parts are cut by straight lines there. Of the nodes on both sides of a line the
lighter ones separate the part; they are eliminated after it. Parts that are small, or that no line
separates well, are left to minimum degree.
"""

import numpy as np

from integration.arrays import Bools, Floats, Index, Ints
from nmm.compiled import compiled

LANDMARKS = 8
SMALL_PART = 100
"""Nodes of a part that is not cut any more."""
LARGEST_SEPARATOR = 0.3
"""Part of the nodes beyond which a separator does not pay."""
LINES, SHIFTS = 6, (0.5, 0.45, 0.55)
"""Directions and places of the lines that are tried where a separator is heavy."""
HEAVY = 5000.0
"""Cubed mean weight of nodes times root of their number, above which trying lines pays."""
UNEVEN_HALVES = 3.0
"""Price of uneven halves: of two equal separators the one nearer the middle is taken."""


def dissect(ptr: Index, graph: Index, weight: Ints) -> tuple[Ints, Ints]:
    """Split the nodes of a graph into parts and separators.

    Parameters
    ----------
    ptr, graph
        Neighbours of each node.
    weight
        (n,) unknowns of each node.

    Returns
    -------
    The nodes inside parts, in no order, and those of separators in order of elimination.
    """
    place = _places(_distances(ptr, graph, LANDMARKS))
    order, parted = _bisected(ptr, graph, place, weight.astype(np.float64), np.array(SHIFTS))
    return order[~parted[order]], order[parted[order]]


def _places(distance: Floats) -> Floats:
    """Places (n, 2) along the principal directions of distances to landmarks (k, n)."""
    squared = distance**2
    centred = squared - squared.mean(axis=1, keepdims=True) - squared.mean(axis=0) + squared.mean()
    _, directions = np.linalg.eigh(centred @ centred.T)
    return np.ascontiguousarray((directions[:, -2:].T @ centred).T)


@compiled
def _distances(ptr: Index, graph: Index, number: int) -> Floats:
    """Steps (k, n) from landmarks, each as far from the others as a node can be."""
    n = len(ptr) - 1
    found = np.empty((number, n))
    nearest = np.full(n, np.inf)
    queue = np.empty(n, dtype=np.int64)
    start = 0
    for turn in range(-1, number):  # a first search finds an end to start from
        step = np.full(n, -1.0)
        step[start] = 0.0
        queue[0] = start
        end = 1
        for at in range(n):
            if at == end:
                break
            for e in range(ptr[queue[at]], ptr[queue[at] + 1]):
                if step[graph[e]] < 0:
                    step[graph[e]] = step[queue[at]] + 1
                    queue[end] = graph[e]
                    end += 1
        far = 2 * step.max() + 1
        for v in range(n):  # what is not connected is put far away
            if step[v] < 0:
                step[v] = far
        if turn < 0:
            start = int(np.argmax(step))
            continue
        found[turn] = step
        nearest = np.minimum(nearest, step)
        start = int(np.argmax(nearest))
    return found


@compiled
def _bisected(
    ptr: Index, graph: Index, place: Floats, weight: Floats, shifts: Floats
) -> tuple[Ints, Bools]:
    """Order in which separators follow the parts they separate; which nodes are separators."""
    n = len(ptr) - 1
    order = np.arange(n)
    parted = np.zeros(n, dtype=np.bool_)
    mark = np.full(n, -1)
    begin, end = [0], [n]
    while len(begin):
        a, b = begin.pop(), end.pop()
        if b - a <= SMALL_PART:
            continue
        mine = order[a:b].copy()
        side = _best_line(ptr, graph, mine, place[mine], weight, shifts, mark)
        count = np.bincount(side, minlength=3)
        if count[2] > LARGEST_SEPARATOR * (b - a) or count[0] == 0 or count[1] == 0:
            continue
        at = np.array([a, a + count[0], a + count[0] + count[1]])
        for k in range(b - a):
            order[at[side[k]]] = mine[k]
            at[side[k]] += 1
            parted[mine[k]] = side[k] == 2
        begin.append(a)
        end.append(a + count[0])
        begin.append(a + count[0])
        end.append(a + count[0] + count[1])
    return order, parted


@compiled
def _best_line(
    ptr: Index,
    graph: Index,
    mine: Ints,
    place: Floats,
    weight: Floats,
    shifts: Floats,
    mark: Ints,
) -> Ints:
    """Side of each node of a part: 0 and 1, 2 for the separator. ``mark`` is -1 everywhere."""
    m = len(mine)
    x, y = place[:, 0] - place[:, 0].mean(), place[:, 1] - place[:, 1].mean()
    long = 0.5 * np.arctan2(2 * (x * y).sum(), (x * x).sum() - (y * y).sum())
    heavy = (weight[mine].sum() / m) ** 3 * np.sqrt(m) > HEAVY
    lines = LINES if heavy else 1
    best, least = np.full(m, 2), np.inf
    for line in range(lines):
        angle = long + np.pi * line / lines
        along = np.cos(angle) * x + np.sin(angle) * y
        ranked = np.sort(along)
        for shift in shifts if heavy else shifts[:1]:
            bound = ranked[int(shift * m)]
            side = (along >= bound).astype(np.int64)
            right = side.sum()
            if right == m or right == 0:
                continue
            touching, lighter, size = _separator(ptr, graph, mine, side, weight, mark)
            price = size * (1 + UNEVEN_HALVES * (max(right, m - right) / m - 0.5))
            if price < least:
                least = price
                best = np.where(touching & (side == lighter), 2, side)
    return best


@compiled
def _separator(
    ptr: Index, graph: Index, mine: Ints, side: Ints, weight: Floats, mark: Ints
) -> tuple[Bools, int, float]:
    """Nodes with a neighbour on the other side, the side where they weigh less, and how much."""
    for k in range(len(mine)):
        mark[mine[k]] = side[k]
    touching = np.zeros(len(mine), dtype=np.bool_)
    total = np.zeros(2)
    for k in range(len(mine)):
        v = mine[k]
        for e in range(ptr[v], ptr[v + 1]):
            if mark[graph[e]] == 1 - side[k]:
                touching[k] = True
                total[side[k]] += weight[v]
                break
    for k in range(len(mine)):
        mark[mine[k]] = -1
    lighter = 0 if total[0] <= total[1] else 1
    return touching, lighter, total[lighter]
