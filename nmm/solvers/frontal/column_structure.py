"""Elimination tree and rows of the factor below every node (Liu 1990; George, Liu 1981)."""

import numpy as np

from integration.arrays import Index, Ints
from nmm.compiled import compiled
from nmm.solvers.kernels.ascending import ascend, extended


@compiled
def elimination_tree(ptr: Index, graph: Index, order: Ints, place: Ints) -> tuple[Ints, Ints]:
    """Return the parent (n,) of every node of an order, -1 at roots, and a postorder (n,).

    ``place`` (n,) is where each node stands in the order.
    """
    n = len(order)
    parent = np.full(n, -1)
    ancestor = np.full(n, -1)
    for k in range(n):
        for e in range(ptr[order[k]], ptr[order[k] + 1]):
            i = place[graph[e]]
            while i != -1 and i < k:
                above = ancestor[i]
                ancestor[i] = k
                if above == -1:
                    parent[i] = k
                i = above
    return parent, _postorder(parent)


@compiled
def _postorder(parent: Ints) -> Ints:
    """Nodes of a forest, each after its children, which are taken in ascending order."""
    n = len(parent)
    head = np.full(n, -1)  # first child, then the next that is not visited
    following = np.full(n, -1)
    for k in range(n - 1, -1, -1):
        if parent[k] >= 0:
            following[k] = head[parent[k]]
            head[parent[k]] = k
    post = np.empty(n, dtype=np.int64)
    stack = np.empty(n, dtype=np.int64)
    count = 0
    for root in range(n):
        if parent[root] >= 0:
            continue
        top = 0
        stack[0] = root
        while top >= 0:
            node = stack[top]
            child = head[node]
            if child >= 0:
                head[node] = following[child]
                top += 1
                stack[top] = child
            else:
                post[count] = node
                count += 1
                top -= 1
    return post


@compiled
def structures(
    ptr: Index, graph: Index, order: Ints, place: Ints, parent: Ints
) -> tuple[Ints, Ints]:
    """Rows below every node in the factor, ascending."""
    n = len(order)
    head = np.full(n, -1)
    following = np.full(n, -1)
    start = np.zeros(n + 1, dtype=np.int64)
    rows = np.empty(4 * len(graph) + 64, dtype=np.int64)
    mark = np.full(n, -1)
    total = 0
    for k in range(n):
        first = total
        if total + n > len(rows):
            rows = extended(rows, 2 * len(rows) + n)
        mark[k] = k
        for e in range(ptr[order[k]], ptr[order[k] + 1]):
            i = place[graph[e]]
            if i > k and mark[i] != k:
                mark[i] = k
                rows[total] = i
                total += 1
        child = head[k]
        while child >= 0:
            for e in range(start[child], start[child + 1]):
                i = rows[e]
                if mark[i] != k and i > k:
                    mark[i] = k
                    rows[total] = i
                    total += 1
            child = following[child]
        ascend(rows[first:total])
        start[k + 1] = total
        if parent[k] >= 0:
            following[k] = head[parent[k]]
            head[parent[k]] = k
    return start, rows[:total].copy()
