"""The window of an update: the cells about the new segments of grown cracks."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import shapely

from covers.cutting.cut import Cutting
from covers.cutting.domain import Segments
from covers.cutting.layers.lines import REACH, CutLines, settled_on, within
from covers.cutting.touched_cells import touched_cells
from covers.mathematical.patch_mesh import PatchMesh
from integration.arrays import Bools


@dataclass(frozen=True)
class Window:
    """The cells that are cut again.

    Attributes
    ----------
    lines : CutLines
        the lines that cut the layer now.
    inner : (C,)
        cells with new elements: those that new segments touch, and their neighbours, to which a
        closure may add a vertex.
    around : (C,)
        the inner cells and all cells that share a vertex with them.
    cracks : Segments
        the cracks that meet these cells.
    """

    lines: CutLines
    inner: Bools
    around: Bools
    cracks: Segments


def window_of(before: Cutting, cracks: Segments) -> Window | None:
    """Return the window; None if everything must be cut anew.

    This is so if cracks have not only grown, or have grown near the boundary of a region: lines
    that extend beyond the window may be bent outside of it, and cross others an ulp away.
    """
    cover, cut = before.cover, before.cells
    if len(before.layers) > 1 or cover.disc_radius is not None or cut.slivers:
        return None
    old = before.layers[0]
    drawn = within(cracks, old.boundary, old.margin)
    gone, fresh = _apart(old.drawn, drawn)
    if len(gone):
        return None
    reach = REACH * before.moved
    near = old.near | touched_cells(cover, fresh, reach, old.chop)
    settled = settled_on(cover, drawn, old.boundary, near, before.moved)
    touched = near | old.rim
    # Cracks that meet others are bent there, and may cross the mesh an ulp away.
    met = np.zeros(len(touched), dtype=bool)
    for moved in _apart(old.cracks, settled):  # removed and added segments
        met |= touched_cells(cover, moved, reach, old.chop)
    inner = touched & (met | _beside(cover, met))
    around = _at_corners(cover, inner)
    if old.rim[around].any() or (old.cells.region[around] < 0).any():
        return None
    cells = replace(old.cells, touched=touched)
    lines = replace(old, drawn=drawn, cracks=settled, near=near, cells=cells)
    return Window(lines, inner, around, _meeting(settled, cover, touched & around))


def _apart(before: Segments, now: Segments) -> tuple[Segments, Segments]:
    """Return the removed and the added segments."""
    rows = [np.column_stack([part.start, part.end, part.owner]) for part in (before, now)]
    _, which = np.unique(np.concatenate(rows), axis=0, return_inverse=True)
    which = which.ravel()
    old, new = which[: len(before)], which[len(before) :]
    return before.take(~np.isin(old, new)), now.take(~np.isin(new, old))


def _beside(cover: PatchMesh, cells: Bools) -> Bools:
    """Cells (C,) across an edge from some cells (C,)."""
    edge = cover.edges.of_cell[cells].ravel()
    sides = np.concatenate([cover.edges.left[edge], cover.edges.right[edge]])
    found = np.zeros(len(cells), dtype=bool)
    found[sides[sides >= 0]] = True
    return found


def _at_corners(cover: PatchMesh, cells: Bools) -> Bools:
    """Cells (C,) that share a vertex with some cells (C,), these among them."""
    corner = np.zeros(len(cover.vertices), dtype=bool)
    corner[cover.cell_vertices[cells]] = True
    return np.asarray(corner[cover.cell_vertices].any(axis=1))


def _meeting(cracks: Segments, cover: PatchMesh, cells: Bools) -> Segments:
    """Return the segments that meet cells (C,)."""
    shapes = cover.cells.take(cells).to_shapely()
    met = shapely.STRtree(cracks.lines()).query(shapes, predicate="intersects")[1]
    return cracks.take(np.unique(met))
