"""Edges of a mesh of cells, with the cells on both sides."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from integration.arrays import Ints


@dataclass(frozen=True)
class MeshEdges:
    """Edges between vertices; -1 stands for the outside of the mesh.

    Attributes
    ----------
    start, end : (M,)
        vertices of each edge.
    left, right : (M,)
        cells on the left and right of start -> end.
    of_cell : (C, v)
        edge from corner ``i`` to corner ``i + 1`` of each cell.
    """

    start: Ints
    end: Ints
    left: Ints
    right: Ints
    of_cell: Ints


def mesh_edges(cell_vertices: Ints) -> MeshEdges:
    """Return the edges of cells given by their corners (C, v), counter-clockwise.

    Raises
    ------
    ValueError
        Two cells are on the same side of an edge: they overlap, or are clockwise.
    """
    n, corners = cell_vertices.shape
    start = cell_vertices.ravel()
    end = np.roll(cell_vertices, -1, axis=1).ravel()
    size = int(cell_vertices.max(initial=0)) + 1
    key = np.minimum(start, end) * size + np.maximum(start, end)
    first, edge = np.unique(key, return_index=True, return_inverse=True)[1:]
    cell = np.repeat(np.arange(n), corners)
    forward = start == start[first[edge]]
    left = np.full(len(first), -1, dtype=np.int64)
    right = left.copy()
    left[edge[forward]] = cell[forward]
    right[edge[~forward]] = cell[~forward]
    twice = np.where(forward, left[edge], right[edge]) != cell
    if twice.any():
        side = int(np.flatnonzero(twice)[0])
        raise ValueError(
            f"cell {cell[side]}: its edge {start[side]}-{end[side]} is also an edge of another "
            "cell on the same side: one cell expected on each side: "
            "order corners counter-clockwise and drop cells that overlap"
        )
    return MeshEdges(start[first], end[first], left, right, edge.reshape(n, corners))
