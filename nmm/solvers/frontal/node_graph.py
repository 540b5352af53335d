"""The graph that is ordered: a node for each group of unknowns with nearly equal columns."""

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Index, Ints
from nmm.compiled import compiled
from nmm.solvers.kernels.ascending import ascend

ALIKE_COLUMNS = 0.75
"""Part of their rows that columns share which are eliminated together. Entries that round to zero
drop out of sums of matrices, so the columns of one cover are not quite equal."""


def node_graph(indptr: Index, indices: Index, mirrored: bool) -> tuple[Ints, Index, Index]:
    """Return the node (n,) of every column, and the graph of the nodes, each with itself.

    Parameters
    ----------
    indptr, indices
        Pattern of a matrix with sorted rows.
    mirrored
        Whether the pattern is symmetric; else the graph is that of it and its mirror image.
    """
    node_of = _groups(indptr, indices)
    graph_ptr, graph = _quotient(indptr, indices, node_of, int(node_of[-1]) + 1)
    return node_of, *((graph_ptr, graph) if mirrored else _both_ways(graph_ptr, graph))


@compiled
def _groups(indptr: Index, indices: Index) -> Ints:
    """Node of every column: columns follow each other into one that differ by few rows.

    Alike is judged against the first column of the node, and both must be coupled.
    """
    n = len(indptr) - 1
    node_of = np.zeros(n, dtype=np.int64)
    node, head = 0, 0
    for j in range(1, n):
        a, end_a = indptr[head], indptr[head + 1]
        b, end_b = indptr[j], indptr[j + 1]
        most = max(end_a - a, end_b - b)
        common, coupled = 0, False
        while a < end_a and b < end_b:
            if indices[a] == indices[b]:
                coupled = coupled or indices[a] == head
                common += 1
                a += 1
                b += 1
            elif indices[a] < indices[b]:
                a += 1
            else:
                b += 1
        if common < most and (not coupled or common < ALIKE_COLUMNS * most):
            node += 1
            head = j
        node_of[j] = node
    return node_of


@compiled
def _quotient(indptr: Index, indices: Index, node_of: Ints, n: int) -> tuple[Index, Index]:
    """Graph of the nodes, each with itself, rows ascending."""
    ptr = np.zeros(n + 1, dtype=np.int32)
    graph = np.empty(len(indices) + n, dtype=np.int32)
    mark = np.full(n, -1)
    total, first, j = 0, 0, 0
    for node in range(n):
        first = total
        mark[node] = node
        graph[total] = node
        total += 1
        while j < len(node_of) and node_of[j] == node:
            for k in range(indptr[j], indptr[j + 1]):
                other = node_of[indices[k]]
                if mark[other] != node:
                    mark[other] = node
                    graph[total] = other
                    total += 1
            j += 1
        ascend(graph[first:total])
        ptr[node + 1] = total
    return ptr, graph[:total].copy()


def _both_ways(graph_ptr: Index, graph: Index) -> tuple[Index, Index]:
    n = len(graph_ptr) - 1
    one = csc_array((np.ones(len(graph)), graph, graph_ptr), shape=(n, n))
    both = csc_array(one + one.T)
    both.sort_indices()
    return both.indptr.astype(np.int32), both.indices.astype(np.int32)
