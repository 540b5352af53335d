"""Which cells lines touch, and in which region the others lie."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import shapely

from covers.base import Cover
from covers.domain import Segments
from integration.arrays import Bools, Floats, Ints


def cell_boxes(cover: Cover) -> shapely.STRtree:
    """Search tree of the cells' bounding boxes."""
    corners = cover.vertices[cover.cell_vertices]
    low, high = corners.min(axis=1), corners.max(axis=1)
    return shapely.STRtree(shapely.box(low[:, 0], low[:, 1], high[:, 0], high[:, 1]))


def touched_cells(
    cover: Cover, boxes: shapely.STRtree, lines: Segments, distance: float, size: float
) -> Bools:
    """Cells (C,) nearer than ``distance`` (m) to any of the lines.

    Parameters
    ----------
    size : float
        length to which lines are chopped before the search, about the size of a cell, m.
    """
    touched = np.zeros(len(cover.cell_vertices), dtype=bool)
    if not len(lines):
        return touched
    pieces = _chopped(lines, size)
    low = np.minimum(pieces[:, 0], pieces[:, 1]) - distance
    high = np.maximum(pieces[:, 0], pieces[:, 1]) + distance
    piece, cell = boxes.query(shapely.box(low[:, 0], low[:, 1], high[:, 0], high[:, 1]))
    candidates, row = np.unique(cell, return_inverse=True)
    shapes = np.asarray(shapely.polygons(cover.vertices[cover.cell_vertices[candidates]]))
    chopped = np.asarray(shapely.linestrings(pieces))
    near = np.asarray(shapely.dwithin(chopped[piece], shapes[row], distance))
    touched[cell[near]] = True
    return touched


def region_of_cells(cover: Cover, shapes: npt.NDArray[np.object_], regions: Ints) -> Ints:
    """Region (C,) that holds the middle of each cell, -1 outside all ``regions``."""
    middle = cover.vertices[cover.cell_vertices].mean(axis=1)
    found = np.full(len(middle), -1, dtype=np.int64)
    row, cell = shapely.STRtree(shapely.points(middle)).query(shapes[regions], predicate="contains")
    found[cell] = regions[row]
    return found


def _chopped(lines: Segments, size: float) -> Floats:
    """Pieces (n, 2, 2) of lines not longer than ``size``."""
    along = lines.end - lines.start
    number = np.ceil(np.hypot(*along.T) / size).astype(np.int64).clip(1)
    line = np.repeat(np.arange(len(lines)), number)
    place = np.arange(len(line)) - np.repeat(np.cumsum(number) - number, number)
    share = np.stack([place, place + 1], axis=1) / number[line, None]
    return np.asarray(lines.start[line, None] + share[..., None] * along[line, None])
