"""The fronts of a multifrontal factorisation, for the pattern of a symmetric matrix.

Unknowns with nearly equal columns (those of a block, of a cover) are eliminated together, so the
graph that is ordered has one node for each such group (`node_graph`). Minimum degree (Liu 1985)
orders the nodes, large graphs are dissected first where that saves work (`ordering`); columns with
nested structure make up supernodes, small ones are merged with their parents at the price of a few
explicit zeros (`supernodes`).
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Index, Ints
from integration.permutations import inverse
from integration.ragged import offsets, within
from nmm.solvers.frontal.node_graph import node_graph
from nmm.solvers.frontal.ordering import columns
from nmm.solvers.frontal.scatter import Shape, lower_places, upper_places
from nmm.solvers.frontal.supernodes import in_unknowns, stack_of_updates, supernodes


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

    @classmethod
    def of(cls, matrix: csc_array, mirrored: bool = True) -> "Fronts":
        """Plan the factorisation of a matrix with sorted rows, whose pattern may be ``mirrored``.

        Sums of sparse matrices drop an entry that rounds to zero and may keep its mirror image; the
        plan has room for both.
        """
        indptr = matrix.indptr.astype(np.int32, copy=False)
        indices = matrix.indices.astype(np.int32, copy=False)
        node_of, graph_ptr, graph = node_graph(indptr, indices, mirrored)
        weight = np.bincount(node_of)
        found = columns(graph_ptr, graph, weight)
        node_order, node_weight = found.order, weight[found.order]
        first_node = supernodes(found.start, found.structure, found.parent, node_weight)
        fronts = in_unknowns(first_node, found.start, found.structure, node_weight)
        order = np.argsort(inverse(node_order)[node_of], kind="stable")
        source, target = lower_places(indptr, indices, order, fronts)
        n_children, stack = stack_of_updates(*fronts[:3])
        return cls(indptr, indices, order, *fronts, n_children, source, target, int(stack))

    @property
    def shape(self) -> Shape:
        """First places, row starts, rows and panel starts."""
        return self.first, self.row_start, self.rows, self.panel_start

    @cached_property
    def beside_start(self) -> Ints:
        """(S+1,) starts of what stands beside pivot blocks, behind the panels."""
        sizes = np.diff(self.first) * np.diff(self.row_start)
        return offsets(sizes) + int(self.panel_start[-1])

    @cached_property
    def pivots(self) -> Ints:
        """(n,) places in the panels of the diagonal of the factor."""
        columns, height = np.diff(self.first), np.diff(self.first) + np.diff(self.row_start)
        places = np.repeat(self.panel_start[:-1], columns)
        return np.asarray(places + within(columns) * np.repeat(height + 1, columns))

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
