"""Order of elimination and the fronts it leads to, for the pattern of a symmetric matrix.

Unknowns with nearly equal columns (those of a block, of a cover) are eliminated together, so the
graph that is ordered has one node for each such group. Minimum degree (Liu 1985) orders the nodes,
large graphs are dissected first where that saves work; columns with nested structure make up
supernodes, small ones are merged with their parents at the price of a few explicit zeros
(Ashcraft, Grimes 1989).
"""

from dataclasses import dataclass
from functools import cached_property

import numba as nb
import numpy as np
import numpy.typing as npt
from scipy.sparse import csc_array

from integration.arrays import Floats, Ints
from nmm.solvers.frontal.dissection import dissect
from nmm.solvers.frontal.metis import metis, metis_order
from nmm.solvers.frontal.scatter import Shape, lower_places, upper_places

Index = npt.NDArray[np.int32]

ALIKE_COLUMNS = 0.75
"""Part of their rows that columns share which are eliminated together. Entries that round to zero
drop out of sums of matrices, so the columns of one cover are not quite equal."""
WORTH = 3e5
"""Multiplications a node from which on a dissection is tried: it takes as long as these, and saves
a third of them on nets of triangles."""


@dataclass(frozen=True)
class Fronts:
    """The plan of a multifrontal factorisation of one pattern.

    Attributes
    ----------
    indptr, indices
        The pattern.
    order
        (n,) unknown that is eliminated at every place.
    first
        (S+1,) first place of every supernode.
    row_start, rows
        Places of the rows below each supernode, ascending, ragged.
    panel_start
        (S+1,) start of each supernode's panel of the factor, stored by columns.
    n_children
        (S,) supernodes whose updates a supernode collects: those last on the stack.
    source, target
        Entries of the matrix in its lower triangle, after ordering, and their place in the panels.
    stack_size
        Largest stack of updates.
    mirrored
        Whether the pattern is symmetric. Sums of sparse matrices drop an entry that rounds to zero
        and may keep its mirror image; the plan has room for both.
    """

    indptr: Index
    indices: Index
    order: Ints
    first: Ints
    row_start: Ints
    rows: Ints
    panel_start: Ints
    n_children: Ints
    source: Ints
    target: Ints
    stack_size: int
    mirrored: bool = True

    @classmethod
    def of(cls, matrix: csc_array, mirrored: bool = True) -> "Fronts":
        """Plan the factorisation of a symmetric matrix with sorted rows."""
        indptr = matrix.indptr.astype(np.int32, copy=False)
        indices = matrix.indices.astype(np.int32, copy=False)
        node_of = _groups(indptr, indices)
        weight = np.bincount(node_of)
        graph_ptr, graph = _quotient(indptr, indices, node_of, len(weight))
        if not mirrored:
            graph_ptr, graph = _both_ways(graph_ptr, graph)
        columns = _columns(graph_ptr, graph, weight)
        node_order, start, structure = columns.order, columns.start, columns.structure
        node_weight = weight[node_order]
        first_node = _supernodes(start, structure, columns.parent, node_weight)
        fronts = _expanded(first_node, start, structure, node_weight)
        rank = np.empty_like(node_order)
        rank[node_order] = np.arange(len(rank))
        order = np.argsort(rank[node_of], kind="stable")
        source, target = lower_places(indptr, indices, order, fronts)
        n_children, stack = _stack(*fronts[:3])
        places = n_children, source, target, int(stack)
        return cls(indptr, indices, order, *fronts, *places, mirrored)

    @property
    def shape(self) -> Shape:
        """First places, row starts, rows and panel starts."""
        return self.first, self.row_start, self.rows, self.panel_start

    @cached_property
    def beside_start(self) -> Ints:
        """(S+1,) starts of what stands beside pivot blocks, behind the panels."""
        sizes = np.diff(self.first) * np.diff(self.row_start)
        return np.concatenate([[0], np.cumsum(sizes)]) + int(self.panel_start[-1])

    @cached_property
    def places(self) -> tuple[Ints, Ints]:
        """All entries of the matrix, and their places in the panels and beside them."""
        pattern = self.indptr, self.indices, self.order
        source, target = upper_places(*pattern, self.shape, self.beside_start)
        return np.concatenate([self.source, source]), np.concatenate([self.target, target])

    def fits(self, matrix: csc_array) -> bool:
        """Whether the matrix has the pattern of this plan."""
        return np.array_equal(self.indptr, matrix.indptr) and np.array_equal(
            self.indices, matrix.indices
        )


@dataclass(frozen=True)
class _Columns:
    """Order of the nodes with the columns of the factor: parents and rows below, ragged."""

    order: Ints
    parent: Ints
    start: Ints
    structure: Ints

    @classmethod
    def of(cls, graph_ptr: Index, graph: Index, order: Ints) -> "_Columns":
        _, postorder = _tree(graph_ptr, graph, order)
        order = order[postorder]
        parent, _ = _tree(graph_ptr, graph, order)
        return cls(order, parent, *_structures(graph_ptr, graph, order, parent))

    def operations(self, weight: Ints) -> float:
        """Multiplications of the factorisation, nodes standing for ``weight`` (n,) unknowns."""
        own = weight[self.order]
        sums = np.concatenate([[0], np.cumsum(own[self.structure])])
        below = sums[self.start[1:]] - sums[self.start[:-1]]
        return float((own * (own + below).astype(np.float64) ** 2).sum())


def _columns(graph_ptr: Index, graph: Index, weight: Ints) -> _Columns:
    """Columns by minimum degree; dissected first where that is worth trying and turns out less."""
    plain = _Columns.of(graph_ptr, graph, _minimum_degree(graph_ptr, graph))
    operations = plain.operations(weight)
    if operations < WORTH * len(weight):
        return plain
    parted = _Columns.of(graph_ptr, graph, _dissected(graph_ptr, graph, weight))
    return parted if parted.operations(weight) < operations else plain


def _dissected(graph_ptr: Index, graph: Index, weight: Ints) -> Ints:
    if metis() is not None:
        return metis_order(graph_ptr, graph, weight)
    n = len(weight)
    inside, separators = dissect(graph_ptr, graph, weight)
    ones = csc_array((np.ones(len(graph)), graph, graph_ptr), shape=(n, n))
    parts = csc_array(ones[inside][:, inside])
    parts.sort_indices()
    return np.concatenate([inside[_minimum_degree(parts.indptr, parts.indices)], separators])


def _both_ways(graph_ptr: Index, graph: Index) -> tuple[Index, Index]:
    n = len(graph_ptr) - 1
    one = csc_array((np.ones(len(graph)), graph, graph_ptr), shape=(n, n))
    both = csc_array(one + one.T)
    both.sort_indices()
    return both.indptr.astype(np.int32), both.indices.astype(np.int32)


@nb.njit(cache=True)
def skew(indptr: Index, indices: Index, data: Floats) -> tuple[float, bool]:
    """Largest difference of a matrix with sorted rows from its mirror image; alike in pattern."""
    n = len(indptr) - 1
    at = np.empty(n, dtype=np.int64)  # next entry below the diagonal of each column
    most, alike = 0.0, True
    for j in range(n):
        k = indptr[j]
        while k < indptr[j + 1] and indices[k] < j:
            i = indices[k]
            while at[i] < indptr[i + 1] and indices[at[i]] < j:
                most, alike = max(most, abs(data[at[i]])), False
                at[i] += 1
            if at[i] < indptr[i + 1] and indices[at[i]] == j:
                most = max(most, abs(data[k] - data[at[i]]))
                at[i] += 1
            else:
                most, alike = max(most, abs(data[k])), False
            k += 1
        if k < indptr[j + 1] and indices[k] == j:
            k += 1
        at[j] = k
    for j in range(n):
        for k in range(at[j], indptr[j + 1]):
            most, alike = max(most, abs(data[k])), False
    return most, alike


def _minimum_degree(graph_ptr: Index, graph: Index) -> Ints:
    """Minimum degree order of a graph, from SuperLU's on a diagonally dominant matrix."""
    from scipy.sparse.linalg import splu

    n = len(graph_ptr) - 1
    if n < 3:
        return np.arange(n)
    degree = np.diff(graph_ptr)
    column = np.repeat(np.arange(n), degree)
    data = np.where(graph == column, 2.0 * n, -1.0)
    matrix = csc_array((data, graph, graph_ptr), shape=(n, n))
    found = splu(
        matrix,
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )
    return np.argsort(found.perm_c).astype(np.int64)


@nb.njit(cache=True)
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


@nb.njit(cache=True)
def _quotient(indptr: Index, indices: Index, node_of: Ints, n: int) -> tuple[Index, Index]:
    """Graph of the nodes, each with itself, rows ascending."""
    ptr = np.zeros(n + 1, dtype=np.int32)
    graph = np.empty(len(indices) + n, dtype=np.int32)
    mark = np.full(n, -1, dtype=np.int64)
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
        graph[first:total].sort()
        ptr[node + 1] = total
    return ptr, graph[:total].copy()


@nb.njit(cache=True)
def _tree(ptr: Index, graph: Index, order: Ints) -> tuple[Ints, Ints]:
    n = len(order)
    place = np.empty(n, dtype=np.int64)
    for k in range(n):
        place[order[k]] = k
    parent = np.full(n, -1, dtype=np.int64)
    ancestor = np.full(n, -1, dtype=np.int64)
    for k in range(n):
        for e in range(ptr[order[k]], ptr[order[k] + 1]):
            i = place[graph[e]]
            while i != -1 and i < k:
                above = ancestor[i]
                ancestor[i] = k
                if above == -1:
                    parent[i] = k
                i = above
    head = np.full(n, -1, dtype=np.int64)
    following = np.full(n, -1, dtype=np.int64)
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
    return parent, post


@nb.njit(cache=True)
def _structures(ptr: Index, graph: Index, order: Ints, parent: Ints) -> tuple[Ints, Ints]:
    """Rows below every node in the factor, ascending."""
    n = len(order)
    place = np.empty(n, dtype=np.int64)
    for k in range(n):
        place[order[k]] = k
    head = np.full(n, -1, dtype=np.int64)
    following = np.full(n, -1, dtype=np.int64)
    start = np.zeros(n + 1, dtype=np.int64)
    rows = np.empty(4 * len(graph) + 64, dtype=np.int64)
    mark = np.full(n, -1, dtype=np.int64)
    total = 0
    for k in range(n):
        first = total
        if total + n > len(rows):
            longer = np.empty(2 * len(rows) + n, dtype=np.int64)
            longer[:total] = rows[:total]
            rows = longer
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
        rows[first:total].sort()
        start[k + 1] = total
        if parent[k] >= 0:
            following[k] = head[parent[k]]
            head[parent[k]] = k
    return start, rows[:total].copy()


@nb.njit(cache=True)
def _supernodes(start: Ints, structure: Ints, parent: Ints, weight: Ints) -> Ints:
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


def _expanded(
    first_node: Ints, start: Ints, structure: Ints, weight: Ints
) -> tuple[Ints, Ints, Ints, Ints]:
    """First places, row starts, rows and panel starts of supernodes, in unknowns."""
    at = np.concatenate([[0], np.cumsum(weight)])
    last = first_node[1:] - 1
    counts = start[last + 1] - start[last]
    within = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    nodes = structure[np.repeat(start[last], counts) + within]
    width = weight[nodes]
    inner = np.arange(width.sum()) - np.repeat(np.cumsum(width) - width, width)
    rows = np.repeat(at[nodes], width) + inner
    owner = np.repeat(np.arange(len(last)), counts)
    below = np.bincount(owner, weights=width, minlength=len(last)).astype(np.int64)
    first = at[first_node]
    columns = np.diff(first)
    panels = np.concatenate([[0], np.cumsum(columns * (columns + below))])
    return first, np.concatenate([[0], np.cumsum(below)]), rows, panels


@nb.njit(cache=True)
def _stack(first: Ints, row_start: Ints, rows: Ints) -> tuple[Ints, int]:
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
