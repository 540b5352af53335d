"""Order in which nodes are eliminated: minimum degree, dissected first where that saves work."""

from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Index, Ints
from integration.permutations import inverse
from integration.ragged import offsets
from nmm.solvers.frontal.column_structure import elimination_tree, structures
from nmm.solvers.frontal.dissection import dissect
from nmm.solvers.libraries.optional import METIS

WORTH = 3e5
"""Multiplications a node from which on a dissection is tried: it takes as long as these, and saves
a third of them on nets of triangles."""


@dataclass(frozen=True)
class Columns:
    """Order of the nodes with the columns of the factor: parents and rows below, ragged."""

    order: Ints
    parent: Ints
    start: Ints
    structure: Ints

    @classmethod
    def of(cls, graph_ptr: Index, graph: Index, order: Ints) -> "Columns":
        """Return the columns of a graph whose nodes are eliminated in ``order`` (n,)."""
        _, postorder = elimination_tree(graph_ptr, graph, order, inverse(order))
        order = order[postorder]
        given = graph_ptr, graph, order, inverse(order)
        parent, _ = elimination_tree(*given)
        return cls(order, parent, *structures(*given, parent))

    def operations(self, weight: Ints) -> float:
        """Multiplications of the factorisation, nodes standing for ``weight`` (n,) unknowns."""
        own = weight[self.order]
        sums = offsets(own[self.structure])
        below = sums[self.start[1:]] - sums[self.start[:-1]]
        return float((own * (own + below).astype(np.float64) ** 2).sum())


def columns(graph_ptr: Index, graph: Index, weight: Ints) -> Columns:
    """Columns by minimum degree; dissected first where that is worth trying and turns out less."""
    plain = Columns.of(graph_ptr, graph, _minimum_degree(graph_ptr, graph))
    operations = plain.operations(weight)
    if operations < WORTH * len(weight):
        return plain
    parted = Columns.of(graph_ptr, graph, _dissected(graph_ptr, graph, weight))
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


@cache
def metis() -> Any:
    """Return the package pymetis; None where it is not installed or does not load."""
    return METIS.load("cholesky") if METIS.loads else None


def orders() -> str:
    """Name of what dissects large graphs, for summaries."""
    return "METIS" if metis() is not None else "nested dissection of its own"


def metis_order(ptr: Index, graph: Index, weight: Ints) -> Ints:
    """Order of elimination of a graph (Karypis, Kumar 1998), given as to `dissect`."""
    owner = np.repeat(np.arange(len(ptr) - 1), np.diff(ptr))
    others = graph != owner
    starts = offsets(np.bincount(owner[others], minlength=len(ptr) - 1))
    package = metis()
    adjacency = package.CSRAdjacency(starts.astype(np.int32), graph[others])
    order, _ = package.nested_dissection(adjacency, vweights=weight.astype(np.int32))
    return np.asarray(order, dtype=np.int64)
