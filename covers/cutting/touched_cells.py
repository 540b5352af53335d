"""The cells that lines touch, and the regions of the others."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import shapely

from covers.cutting.components import components
from covers.cutting.domain import Segments
from covers.mathematical.patch_mesh import PatchMesh
from integration.arrays import Bools, Floats, Ints
from integration.ragged import within


def touched_cells(cover: PatchMesh, lines: Segments, distance: float, size: float) -> Bools:
    """Return which cells (C,) are nearer than ``distance`` (m) to any of the lines.

    Parameters
    ----------
    size : float
        length into which lines are divided for the search, about the size of a cell, m.
    """
    touched = np.zeros(len(cover.cell_vertices), dtype=bool)
    if not len(lines):
        return touched
    pieces = _chopped(lines, size)
    low = np.minimum(pieces[:, 0], pieces[:, 1]) - distance
    high = np.maximum(pieces[:, 0], pieces[:, 1]) + distance
    first, last = cover.cell_boxes
    candidates = np.flatnonzero(
        ((first <= high.max(axis=0)) & (last >= low.min(axis=0))).all(axis=1)
    )
    if not len(candidates):
        return touched
    first, last = first[candidates], last[candidates]
    close = _near_bins(first, last, low, high, size)
    candidates, first, last = candidates[close], first[close], last[close]
    if not len(candidates):
        return touched
    piece, row = shapely.STRtree(_boxes(first, last)).query(_boxes(low, high))
    shapes = np.asarray(shapely.polygons(cover.vertices[cover.cell_vertices[candidates]]))
    chopped = np.asarray(shapely.linestrings(pieces))
    near = np.asarray(shapely.dwithin(chopped[piece], shapes[row], distance))
    touched[candidates[row[near]]] = True
    return touched


def _boxes(low: Floats, high: Floats) -> npt.NDArray[np.object_]:
    return np.asarray(shapely.box(low[:, 0], low[:, 1], high[:, 0], high[:, 1]))


def _near_bins(first: Floats, last: Floats, low: Floats, high: Floats, size: float) -> Bools:
    """Boxes (C,) from ``first`` to ``last`` that share a bin of a grid with any other box.

    Much cheaper than a search tree of all boxes: occupied bins are counted by cumulative sums over
    the grid.
    """
    origin, end = first.min(axis=0), last.max(axis=0)
    # At most about four bins for each cell, however nonuniform the cells are.
    least = np.sqrt(float(np.prod(end - origin)) / (4 * len(first)))
    step = max(size, least, float((end - origin).max()) / (4 * len(first) + 1))
    shape = np.floor((end - origin) / step).astype(np.int64) + 1

    def bins(points: Floats) -> Ints:
        found = np.floor((points - origin) / step)
        return np.asarray(np.clip(found, 0, shape - 1).astype(np.int64))

    filled = np.zeros(shape + 1, dtype=np.int64)
    (i, j), (k, m) = bins(low).T, bins(high).T + 1
    for row, column, sign in ((i, j, 1), (k, j, -1), (i, m, -1), (k, m, 1)):
        np.add.at(filled, (row, column), sign)
    occupied = filled.cumsum(axis=0).cumsum(axis=1)[:-1, :-1] > 0
    total = np.zeros(shape + 1, dtype=np.int64)
    total[1:, 1:] = occupied.cumsum(axis=0).cumsum(axis=1)
    (i, j), (k, m) = bins(first).T, bins(last).T + 1
    return np.asarray(total[k, m] - total[i, m] - total[k, j] + total[i, j] > 0)


def region_of_cells(
    cover: PatchMesh, shapes: npt.NDArray[np.object_], regions: Ints, touched: Bools
) -> Ints:
    """Return the region (C,) that contains the middle of each cell, -1 outside all ``regions``.

    Neighbouring cells that no line touches lie in the same region, so that one cell of each
    connected group is looked up.
    """
    left, right = cover.edges.left, cover.edges.right
    free = (left >= 0) & (right >= 0)
    free &= ~touched[left] & ~touched[right]
    group = components(len(touched), left[free], right[free])
    first = np.unique(group, return_index=True)[1]
    middle = cover.vertices[cover.cell_vertices[first]].mean(axis=1)
    found = np.full(len(first), -1, dtype=np.int64)
    row, cell = shapely.STRtree(shapely.points(middle)).query(shapes[regions], predicate="contains")
    found[cell] = regions[row]
    return np.asarray(found[group])


def _chopped(lines: Segments, size: float) -> Floats:
    """Segments (n, 2, 2) of lines, not longer than ``size``."""
    along = lines.end - lines.start
    number = np.ceil(np.hypot(*along.T) / size).astype(np.int64).clip(1)
    line = np.repeat(np.arange(len(lines)), number)
    place = within(number)
    share = np.stack([place, place + 1], axis=1) / number[line, None]
    return np.asarray(lines.start[line, None] + share[..., None] * along[line, None])
