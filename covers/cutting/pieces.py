"""Elements of a layer of regions: whole cells, and faces of cells that lines touch."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from covers.cutting.connectivity import Joins
from covers.cutting.plane_graph.faces import Cells, Faces
from covers.cutting.plane_graph.half_edges import walks
from covers.mathematical.patch_mesh import PatchMesh
from integration.arrays import Bools, Floats, Ints
from integration.permutations import inverse
from integration.plane_vectors import cross
from integration.polygons import Polygons


@dataclass(frozen=True)
class Pieces:
    """Elements of a layer.

    Attributes
    ----------
    elements : Polygons
        simple polygons, counter-clockwise, in the order of cells.
    cell, region : (E,)
        cell and region of each element.
    whole : (E,)
        whether the element is its cell, with corners in the order of the cell.
    of_loop : (loops,)
        element of each face, or -1.
    of_cell : (C,)
        element of each cell that no line touches, or -1.
    lost_area : float
        area of the faces left out, m2.
    lost : int
        number of them.
    """

    elements: Polygons
    cell: Ints
    region: Ints
    whole: Bools
    of_loop: Ints
    of_cell: Ints
    lost_area: float
    lost: int


# Faces narrower than about twice so many steps of the resolution are rounding.
THIN = 1.0
# Decimals of centroids, in sizes of the cell, by which faces of a cell are ordered.
DECIMALS = 6


def pieces_of(cover: PatchMesh, cells: Cells, faces: Faces, smallest: float, step: float) -> Pieces:
    """Return the elements.

    Parameters
    ----------
    smallest : float
        faces below this share of the area of their cell are left out.
    step : float
        resolution, m; faces of this width are left out, too.
    """
    half = faces.half
    area, perimeter = _loop_sizes(faces)
    divided = np.zeros(half.n_loops, dtype=bool)
    divided[half.loop[np.repeat(faces.closure, 2)]] = True
    material = (faces.cell >= 0) & (faces.region >= 0)
    cell_area = np.where(material, cover.cells.areas[faces.cell], np.inf)
    # A sliver beside a closure shares the covers of its neighbour and is harmless.
    least = np.maximum(smallest * cell_area, THIN * step * perimeter)
    sliver = material & ~divided & (area < least)

    loops, whole_cells = np.flatnonzero(material & ~sliver), np.flatnonzero(cells.whole)
    cell = np.concatenate([faces.cell[loops], whole_cells])
    region = np.concatenate([faces.region[loops], cells.region[whole_cells]])
    x, y = np.pad(_middles(cover, faces, loops), ((0, len(whole_cells)), (0, 0))).T
    order = np.lexsort((y, x, region, cell))
    rank = inverse(order)
    of_loop = np.full(half.n_loops, -1, dtype=np.int64)
    of_loop[loops] = rank[: len(loops)]
    of_cell = np.full(len(cells.touched), -1, dtype=np.int64)
    of_cell[whole_cells] = rank[len(loops) :]
    elements, whole = _rings(cover, faces, of_loop, of_cell)
    return Pieces(
        elements, cell[order], region[order], whole, of_loop, of_cell,
        float(area[sliver].sum()), int(sliver.sum()),
    )  # fmt: skip


def joins_of(cover: PatchMesh, cells: Cells, faces: Faces, pieces: Pieces, group: Ints) -> Joins:
    """Return the joined pairs of elements.

    Parameters
    ----------
    group : (R,)
        regions of the same number are joined across common boundaries.
    """
    half = faces.half
    element = pieces.of_loop[half.loop]
    across = neighbours(faces, pieces, element)
    joined = np.flatnonzero(joined_sides(faces, pieces, element, across, group))
    # Edges between two faces occur on both sides, those to a whole cell on one.
    alone = pieces.of_loop[half.loop[joined ^ 1]] < 0
    once = joined[alone | (element[joined] < across[joined])]
    begin = faces.points[half.origin[once]]
    once = once[np.lexsort((begin[:, 1], begin[:, 0], across[once], element[once]))]
    edges = cells.edges
    left, right = pieces.of_cell[edges.left], pieces.of_cell[edges.right]
    inner = np.flatnonzero((edges.left >= 0) & (edges.right >= 0) & (left >= 0) & (right >= 0))
    return Joins(
        np.concatenate([element[once], left[inner]]),
        np.concatenate([across[once], right[inner]]),
        np.concatenate([faces.points[half.origin[once]], cover.vertices[edges.start[inner]]]),
        np.concatenate([faces.points[half.head[once]], cover.vertices[edges.end[inner]]]),
    )


def neighbours(faces: Faces, pieces: Pieces, element: Ints) -> Ints:
    """Return the element (2 n,) on the other side of each half-edge; -1 without one."""
    opposite = np.arange(len(element)) ^ 1
    other = faces.side[opposite]
    whole = np.where(other >= 0, pieces.of_cell[other], -1)
    return np.where(element[opposite] >= 0, element[opposite], whole)


def joined_sides(faces: Faces, pieces: Pieces, element: Ints, across: Ints, group: Ints) -> Bools:
    """Return which half-edges (2 n,) have elements on both sides without a discontinuity.

    ``element`` and ``across`` (2 n,) are the elements on both sides, -1 outside; ``group`` (N,) is
    that of regions.
    """
    both = (element >= 0) & (across >= 0)
    same = group[pieces.region[element]] == group[pieces.region[across]]
    return np.asarray(both & same & (np.repeat(faces.crack, 2) < 0))


def _loop_sizes(faces: Faces) -> tuple[Floats, Floats]:
    """Area of each loop, positive for a face on its left (m2), and perimeter (m)."""
    half = faces.half
    first = np.unique(half.loop, return_index=True)[1]
    anchor = faces.points[half.origin[first]][half.loop]
    one, two = faces.points[half.origin] - anchor, faces.points[half.head] - anchor
    doubled = cross(one, two)
    length = np.hypot(*(two - one).T)
    area = 0.5 * np.bincount(half.loop, doubled, minlength=half.n_loops)
    perimeter = np.bincount(half.loop, length, minlength=half.n_loops)
    return np.asarray(area, dtype=float), np.asarray(perimeter, dtype=float)


def _middles(cover: PatchMesh, faces: Faces, loops: Ints) -> Floats:
    """Rounded centroids (m, 2) of faces in sizes of their cells.

    They give the faces of a cell an order that does not depend on that of the lines.
    """
    half = faces.half
    row = np.full(half.n_loops, -1, dtype=np.int64)
    row[loops] = np.arange(len(loops))
    member = np.flatnonzero(row[half.loop] >= 0)
    which, cell = row[half.loop[member]], faces.cell[half.loop[member]]
    size = np.sqrt(cover.cells.areas[cell])[:, None]
    corner = cover.vertices[cover.cell_vertices[cell, 0]]
    one = (faces.points[half.origin[member]] - corner) / size
    two = (faces.points[half.head[member]] - corner) / size
    doubled = cross(one, two)
    total = np.bincount(which, doubled, minlength=len(loops))
    moment = [np.bincount(which, doubled * part, minlength=len(loops)) for part in (one + two).T]
    middle = np.stack(moment, axis=1) / np.maximum(3 * total, np.finfo(float).tiny)[:, None]
    return np.asarray(np.round(middle, DECIMALS))


def _rings(cover: PatchMesh, faces: Faces, of_loop: Ints, of_cell: Ints) -> tuple[Polygons, Bools]:
    """Polygons of all elements, and whether each is its whole cell."""
    half, corners = faces.half, cover.cell_vertices.shape[1]
    member = np.flatnonzero(of_loop[half.loop] >= 0)
    length = np.bincount(half.loop[member], minlength=half.n_loops)
    uncut = np.bincount(half.loop[member[faces.on_mesh[member // 2]]], minlength=half.n_loops)
    # Polygons start at corner 0 of their cell, so that whole cells keep their order; if that is cut
    # off, at the leftmost point.
    zero = cover.vertices[cover.cell_vertices[faces.cell[half.loop[member]], 0]]
    begins = (faces.points[half.origin[member]] == zero).all(axis=1)
    x, y = faces.points[half.origin[member]].T
    order = np.lexsort((member, y, x, ~begins, half.loop[member]))
    loops, first = np.unique(half.loop[member[order]], return_index=True)
    walk = walks(half.next, member[order][first], length[loops])

    n = int((of_loop >= 0).sum() + (of_cell >= 0).sum())
    number = np.full(n, corners, dtype=np.int64)
    number[of_loop[loops]] = length[loops]
    offset = np.concatenate([[0], np.cumsum(number)])
    whole = np.ones(n, dtype=bool)
    whole[of_loop[loops]] = (length[loops] == corners) & (uncut[loops] == corners)
    points = np.empty((int(offset[-1]), 2))
    begin = np.cumsum(length[loops]) - length[loops]
    shift = np.repeat(offset[of_loop[loops]] - begin, length[loops])
    points[np.arange(len(walk)) + shift] = faces.points[half.origin[walk]]
    cells = np.flatnonzero(of_cell >= 0)
    places = offset[of_cell[cells]][:, None] + np.arange(corners)
    points[places] = cover.vertices[cover.cell_vertices[cells]]
    return Polygons(points, offset, np.arange(n + 1)), whole
