"""The faces between noded lines, with the cell and the region of each."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from covers.cutting.components import components
from covers.cutting.plane_graph.half_edges import HalfEdges, half_edges
from covers.cutting.plane_graph.snap_rounding import Lines, undirected
from covers.mathematical.mesh_edges import MeshEdges
from integration.arrays import Bools, Floats, Ints

MESH, BOUNDARY, CRACK = 0, 1, 2


@dataclass(frozen=True)
class Sources:
    """The kinds of the lines of an arrangement: mesh edges, boundaries of regions, cracks.

    Attributes
    ----------
    kind, owner : (S,)
        `MESH`, `BOUNDARY` or `CRACK`, and the number of the mesh edge, region or crack.
    """

    kind: Ints
    owner: Ints


@dataclass(frozen=True)
class Cells:
    """The cells before lines are cut.

    Attributes
    ----------
    edges : MeshEdges
        edges of the mesh of cells.
    touched : (C,)
        whether the edges of the cell are among the lines.
    region : (C,)
        region that contains the middle of each cell, or -1.
    """

    edges: MeshEdges
    touched: Bools
    region: Ints

    @property
    def whole(self) -> Bools:
        """(C,) whether the cell is inside a region and away from all lines."""
        return ~self.touched & (self.region >= 0)


@dataclass(frozen=True)
class Faces:
    """Faces of the plane graph of all lines; half-edges as in `half_edges`.

    Attributes
    ----------
    steps, points : (V, 2)
        points of the graph in steps and in m.
    edges : (n, 2)
        edges between points.
    half : HalfEdges
        their half-edges; each loop is a face, or the outer rim of a connected group of lines.
    on_mesh : (n,)
        whether the edge lies on a mesh edge.
    crack : (n,)
        crack along the edge, or -1.
    closure : (n,)
        whether the edge is a closure, on no line.
    side : (2 n,)
        cell on the left of half-edges of the mesh; else -1.
    cell, region : (loops,)
        touched cell and region of each face; -1 outside, and for loops that are no faces.
    """

    steps: Floats
    points: Floats
    edges: Ints
    half: HalfEdges
    on_mesh: Bools
    crack: Ints
    closure: Bools
    side: Ints
    cell: Ints
    region: Ints


def faces_of(lines: Lines, sources: Sources, cells: Cells) -> Faces:
    """Return the faces between noded lines."""
    edges, edge = undirected(lines.start, lines.end)
    half = half_edges(lines.steps, edges)
    along = 2 * edge + (lines.start != edges[edge, 0])
    kind = np.where(lines.source < 0, -1, sources.kind[lines.source])
    owner = sources.owner[lines.source]

    on_mesh = np.zeros(len(edges), dtype=bool)
    side = np.full(2 * len(edges), -1, dtype=np.int64)
    mesh = kind == MESH
    on_mesh[edge[mesh]] = True
    side[along[mesh]] = cells.edges.left[owner[mesh]]
    side[along[mesh] ^ 1] = cells.edges.right[owner[mesh]]

    crack = np.full(len(edges), -1, dtype=np.int64)
    crack[edge[kind == CRACK]] = owner[kind == CRACK]
    closure = np.ones(len(edges), dtype=bool)
    closure[edge[kind >= 0]] = False

    rim = kind == BOUNDARY
    left = _material_on_the_left(len(edges), along[rim], owner[rim])

    cell = _cells_of_loops(half, on_mesh, side, cells.touched)
    length = np.hypot(*(lines.steps[half.head] - lines.steps[half.origin]).T)
    region = _regions_of_loops(half, length, left, cell, cells.region)
    return Faces(
        lines.steps, lines.points, edges, half, on_mesh, crack, closure, side, cell, region
    )


def _material_on_the_left(n: int, along: Ints, region: Ints) -> Ints:
    """Region (2 n,) whose boundary follows each half-edge more often than its opposite, or -1."""
    regions = int(region.max(initial=0)) + 1
    key, group = np.unique((along // 2) * regions + region, return_inverse=True)
    net = np.bincount(group, 1.0 - 2.0 * (along % 2), minlength=len(key))
    left = np.full(2 * n, -1, dtype=np.int64)
    runs = net != 0
    left[2 * (key[runs] // regions) + (net[runs] < 0)] = key[runs] % regions
    return left


def _cells_of_loops(half: HalfEdges, on_mesh: Bools, side: Ints, touched: Bools) -> Ints:
    """Touched cell of each loop: faces that meet off mesh edges lie in the same cell."""
    one, two = half.loop[0::2][~on_mesh], half.loop[1::2][~on_mesh]
    patch = components(half.n_loops, one, two)
    known = np.flatnonzero(side >= 0)
    known = known[touched[side[known]]]
    cell = np.full(half.n_loops, -1, dtype=np.int64)
    cell[patch[half.loop[known]]] = side[known]
    return cell[patch]


def _regions_of_loops(
    half: HalfEdges, length: Floats, left: Ints, cell: Ints, cell_region: Ints
) -> Ints:
    """Region of each loop: faces that meet off all boundaries lie in the same region or outside."""
    right = left.reshape(-1, 2)[:, ::-1].ravel()
    free = (left[0::2] < 0) & (left[1::2] < 0)
    part = components(half.n_loops, half.loop[0::2][free], half.loop[1::2][free])
    claim = np.flatnonzero((left >= 0) | (right >= 0))
    known, region = _longest_claims(part[half.loop[claim]], left[claim], length[claim])
    of_part = np.full(half.n_loops, -2, dtype=np.int64)
    of_part[known] = region
    inside = np.flatnonzero((of_part[part] == -2) & (cell >= 0))
    of_part[part[inside]] = cell_region[cell[inside]]
    return np.maximum(of_part[part], -1)


def _longest_claims(part: Ints, region: Ints, length: Floats) -> tuple[Ints, Ints]:
    """The region that the largest length of the boundary of each part belongs to, -1 outside.

    The edges of a boundary agree, but for corners of the size of rounding that snapping may have
    turned inside out.
    """
    regions = int(region.max(initial=-1)) + 2
    key, group = np.unique(part * regions + region + 1, return_inverse=True)
    total = np.bincount(group, length, minlength=len(key))
    order = np.lexsort((-total, key // regions))
    parts, first = np.unique(key[order] // regions, return_index=True)
    return parts, key[order[first]] % regions - 1
