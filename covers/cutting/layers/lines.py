"""The lines that cut a layer of regions, and the cells that they touch."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from covers.cutting.cracks import clipped, settled
from covers.cutting.domain import Domain, Segments
from covers.cutting.plane_graph.faces import Cells
from covers.cutting.resolution import Resolution
from covers.cutting.touched_cells import region_of_cells, touched_cells
from covers.mathematical.patch_mesh import PatchMesh
from integration.arrays import Bools, Ints
from integration.polygons import diameters

# Lines within so many steps of the resolution of a cell touch it.
TOUCHING_STEPS = 8
# Cells within so many tolerances of a crack are touched by it, however it is snapped.
REACH = 3


@dataclass(frozen=True)
class CutLines:
    """The lines that cut a layer of regions, and the cells that they touch.

    Attributes
    ----------
    boundary, drawn, cracks : Segments
        boundaries of the regions; cracks as given, and after snapping.
    rim, near : (C,)
        whether the boundary touches the cell or it has a corner on the rim of the mesh; whether
        cracks touch it.
    cells : Cells
        the cells, with those that any line touches, and the regions of the others.
    chop, margin : float
        median and largest size of the cells, m.
    """

    boundary: Segments
    drawn: Segments
    cracks: Segments
    rim: Bools
    near: Bools
    cells: Cells
    chop: float
    margin: float


def lines_of(
    cover: PatchMesh,
    domain: Domain,
    layer: int,
    cracks: Segments,
    resolution: Resolution,
    tolerance: float,
) -> CutLines:
    """Return the lines that cut a layer."""
    boundary = domain.boundary(layer)
    members = np.flatnonzero(domain.layer == layer)
    size = diameters(cover.cells)
    margin, chop = float(size.max()), float(np.median(size))
    drawn = within(cracks, boundary, margin)
    near = touched_cells(cover, drawn, REACH * tolerance, chop)
    rim = touched_cells(cover, boundary, TOUCHING_STEPS * resolution.step, chop) | _at_the_rim(
        cover
    )
    cracks = settled_on(cover, drawn, boundary, near, tolerance)
    touched = near | rim
    cells = Cells(cover.edges, touched, region_of_cells(cover, domain.shapes, members, touched))
    return CutLines(boundary, drawn, cracks, rim, near, cells, chop, margin)


def within(cracks: Segments, boundary: Segments, margin: float) -> Segments:
    """Return cracks clipped to the bounding box of the boundary with a margin."""
    low, high = boundary.start.min(axis=0), boundary.start.max(axis=0)
    return clipped(cracks, low - margin, high + margin)


def _at_the_rim(cover: PatchMesh) -> Bools:
    """Cells (C,) with a corner on the rim of the mesh, where the boundary may run."""
    outer = (cover.edges.left < 0) | (cover.edges.right < 0)
    rim = np.zeros(len(cover.vertices), dtype=bool)
    rim[cover.edges.start[outer]] = rim[cover.edges.end[outer]] = True
    return np.asarray(rim[cover.cell_vertices].any(axis=1))


def settled_on(
    cover: PatchMesh, cracks: Segments, boundary: Segments, near: Bools, tolerance: float
) -> Segments:
    """Return cracks snapped to the boundary and to the mesh of the cells ``near`` them."""
    vertices = np.unique(cover.cell_vertices[near])
    edges = mesh_segments(cover, np.unique(cover.edges.of_cell[near]))
    return settled(cracks, boundary, cover.vertices[vertices], edges, tolerance)


def mesh_segments(cover: PatchMesh, edges: Ints) -> Segments:
    """Return edges of the mesh as segments, with the edge as owner."""
    start, end = cover.edges.start[edges], cover.edges.end[edges]
    return Segments(cover.vertices[start], cover.vertices[end], edges)
