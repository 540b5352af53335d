"""Cutting: mathematical cover x material x discontinuities = elements and physical covers.

All lines (edges of the cells that are touched, boundaries of regions, cracks) are put into one
plane graph, in which points within 2^-46 of the model's extent are one
(`covers.cutting.resolution`, `covers.cutting.snap_rounding`). Everything after that is topology:
faces are elements, shared edges connect them, and physical covers are connected components (Shi
1991; Terada, Asai and Yamagishi 2003). Nothing is decided by comparing lengths or areas. Cells that
no line touches keep their shape.

100 000 triangles with 2 600 cut elements take 0.4 s of one core, 1 000 blocks on 10 000 triangles
0.3 s (`benchmarks/bench_cutting.py`).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from covers.cutting.closures import closed_faces
from covers.cutting.cracks import clipped, crack_segments, settled
from covers.cutting.cut_boundary import boundary_of
from covers.cutting.cut_cells import CutCells, Layer, assembled
from covers.cutting.domain import Domain, Segments, domain_of
from covers.cutting.faces import BOUNDARY, CRACK, MESH, Cells, Sources
from covers.cutting.pieces import joins_of, pieces_of
from covers.cutting.resolution import Resolution, resolution_of
from covers.cutting.snap_rounding import lines_between, node
from covers.cutting.touched_cells import region_of_cells, touched_cells
from covers.mathematical.base import Cover
from integration.arrays import Bools, Floats, Ints
from integration.polygons import Polygons, diameters

# Lines within this many steps of the resolution of a cell touch it.
TOUCH = 8
# Cells must be larger than this many steps of the resolution.
COARSE = 1e4


def cut(
    cover: Cover,
    regions: Polygons | npt.ArrayLike,
    cracks: Sequence[npt.ArrayLike] = (),
    *,
    glue: npt.ArrayLike | None = None,
    tolerance: float = 1e-8,
    smallest: float = 1e-15,
) -> CutCells:
    """Cut a mathematical cover by regions of material and by cracks.

    Parameters
    ----------
    cover : Cover
        cells and patches; must reach around all regions.
    regions : Polygons or array of shapely polygons
        pieces of material. Regions that touch are separate bodies, those that overlap too.
    cracks : sequence of (n, 2)
        polylines in any position: through, ending inside, branching, crossing, along edges of
        cells, through nodes. A crack cuts every region that it runs through.
    glue : (R,), optional
        regions of one number share physical covers across their common boundary: one body of
        several materials.
    tolerance : float
        cracks nearer than this part of the smallest cell's diameter to a vertex of the mesh, a
        corner of a region or another crack's point pass exactly through it, and ends nearer to a
        line end on it. Boundaries of regions are never moved.
    smallest : float
        faces of less than this part of their cell are left out and reported.

    Returns
    -------
    CutCells

    Raises
    ------
    ValueError
        Invalid regions or cracks, a cover that does not reach around a region, or cells that are
        too small to be told from rounding.
    """
    polygons = regions if isinstance(regions, Polygons) else Polygons.from_shapely(regions)
    if not len(polygons):
        raise ValueError("regions: none: at least one expected: give the material to be cut")
    resolution = resolution_of(_extremes(cover, polygons))
    size = diameters(cover.cells)
    if size.min() < COARSE * resolution.step:
        raise ValueError(
            f"cover: cells of {size.min():.2g} m: more than {COARSE * resolution.step:.2g} m "
            "expected at these coordinates: move the model towards the origin or use larger cells"
        )
    domain = domain_of(polygons, glue, TOUCH * resolution.step)
    moved = max(tolerance * float(size.min()), TOUCH * resolution.step)
    layers = [
        _cut_layer(cover, domain, layer, crack_segments(cracks), resolution, moved, smallest, size)
        for layer in range(int(domain.layer.max()) + 1)
    ]
    return assembled(cover, domain, layers, resolution, moved)


def _extremes(cover: Cover, regions: Polygons) -> Floats:
    """Two corners of the box of the regions and of the cells that may be cut by them."""
    low, high = regions.points.min(axis=0), regions.points.max(axis=0)
    corners = cover.vertices[cover.cell_vertices]
    first, last = corners.min(axis=1), corners.max(axis=1)
    near = ((first <= high) & (last >= low)).all(axis=1)
    if not near.any():
        raise ValueError(
            f"cover: no cell near the regions between {low.tolist()} and {high.tolist()}: a cover "
            "around them expected: make it over these bounds"
        )
    return np.stack(
        [np.minimum(low, first[near].min(axis=0)), np.maximum(high, last[near].max(axis=0))]
    )


def _cut_layer(
    cover: Cover,
    domain: Domain,
    layer: int,
    cracks: Segments,
    resolution: Resolution,
    tolerance: float,
    smallest: float,
    size: Floats,
) -> Layer:
    boundary = domain.boundary(layer)
    members = np.flatnonzero(domain.layer == layer)
    low, high = boundary.start.min(axis=0), boundary.start.max(axis=0)
    margin = float(size.max())
    cracks = clipped(cracks, low - margin, high + margin)

    chop = float(np.median(size))
    near = touched_cells(cover, cracks, 3 * tolerance, chop)
    touched = near | touched_cells(cover, boundary, TOUCH * resolution.step, chop)
    touched |= _at_the_rim(cover)
    cracks = _settled(cover, cracks, boundary, near, tolerance)
    cells = Cells(cover.edges, touched, region_of_cells(cover, domain.shapes, members, touched))

    mesh = np.unique(cover.edges.of_cell[touched])
    lines = [_mesh_segments(cover, mesh), boundary, cracks]
    sources = Sources(
        np.repeat([MESH, BOUNDARY, CRACK], [len(part) for part in lines]),
        np.concatenate([part.owner for part in lines]),
    )
    start = np.concatenate([part.start for part in lines])
    end = np.concatenate([part.end for part in lines])
    count = np.arange(len(start))
    graph = lines_between(np.concatenate([start, end]), resolution, count, count + len(start))
    graph = node(graph, count >= len(mesh), resolution)
    faces = closed_faces(graph, sources, cells, resolution, 2 * margin)

    pieces = pieces_of(cover, cells, faces, smallest, resolution.step)
    joins = joins_of(cover, cells, faces, pieces, domain.group)
    edges, tips = boundary_of(faces, pieces, domain.group)
    return Layer(pieces, joins, edges, tips, touched)


def _at_the_rim(cover: Cover) -> Bools:
    """Cells (C,) with a corner on the rim of the mesh: the boundary runs there, if anywhere."""
    outer = (cover.edges.left < 0) | (cover.edges.right < 0)
    rim = np.zeros(len(cover.vertices), dtype=bool)
    rim[cover.edges.start[outer]] = rim[cover.edges.end[outer]] = True
    return np.asarray(rim[cover.cell_vertices].any(axis=1))


def _settled(
    cover: Cover, cracks: Segments, boundary: Segments, near: Bools, tolerance: float
) -> Segments:
    vertices = np.unique(cover.cell_vertices[near])
    edges = _mesh_segments(cover, np.unique(cover.edges.of_cell[near]))
    return settled(cracks, boundary, cover.vertices[vertices], edges, tolerance)


def _mesh_segments(cover: Cover, edges: Ints) -> Segments:
    start, end = cover.edges.start[edges], cover.edges.end[edges]
    return Segments(cover.vertices[start], cover.vertices[end], edges)
