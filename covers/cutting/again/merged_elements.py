"""Elements and joins of an updated cut: kept and new ones in the order of their cells."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from covers.cutting.again.window import Window
from covers.cutting.connectivity import Joins
from covers.cutting.cut_cells import CutCells, Layer
from integration.arrays import Bools, Ints
from integration.permutations import inverse
from integration.polygons import Polygons


@dataclass(frozen=True)
class MergedElements:
    """Elements of an updated cut.

    Attributes
    ----------
    elements, cell, region, whole
        As in `covers.cutting.cut_cells.CutCells`.
    joins
        Joined pairs of elements.
    kept : (A,)
        merged number of each old element, -1 for removed ones.
    made : (B,)
        merged number of each element of the window.
    fresh : (B,)
        whether the element of the window is new; else it equals a kept one.
    """

    elements: Polygons
    cell: Ints
    region: Ints
    whole: Bools
    joins: Joins
    kept: Ints
    made: Ints
    fresh: Bools


def merged_elements(old: CutCells, local: Layer, window: Window) -> MergedElements | None:
    """Merge elements; None if elements about the new ones have changed."""
    pieces = local.pieces
    stays, fresh = ~window.inner[old.element_cell], window.inner[pieces.cell]
    near = np.flatnonzero(stays & window.around[old.element_cell])
    unchanged = np.flatnonzero(~fresh)
    # Both are in the order of cells, and in a fixed order within a cell.
    if pieces.lost or not np.array_equal(old.element_cell[near], pieces.cell[unchanged]):
        return None
    ringed, found = old.elements.take(near), pieces.elements.take(unchanged)
    if not np.array_equal(ringed.points, found.points):  # a closure extends beyond the window
        return None
    cell = np.concatenate([old.element_cell[stays], pieces.cell[fresh]])
    order = np.argsort(cell, kind="stable")
    rank = inverse(order)
    kept = np.full(len(stays), -1, dtype=np.int64)
    kept[stays] = rank[: stays.sum()]
    made = np.empty(len(fresh), dtype=np.int64)
    made[fresh], made[unchanged] = rank[stays.sum() :], kept[near]
    elements = Polygons.concatenate([old.elements.take(stays), pieces.elements.take(fresh)])
    return MergedElements(
        elements.take(order),
        cell[order],
        np.concatenate([old.element_region[stays], pieces.region[fresh]])[order],
        np.concatenate([old.element_whole[stays], pieces.whole[fresh]])[order],
        _joins(old.joins, kept, local.joins, made, fresh, window.lines.cells.touched[cell[order]]),
        kept,
        made,
        fresh,
    )


def _joins(old: Joins, kept: Ints, local: Joins, made: Ints, fresh: Bools, cut: Bools) -> Joins:
    """Merge joins; ``cut`` tells which merged elements lie in cells that a line touches."""
    known = old.take((kept[old.first] >= 0) & (kept[old.second] >= 0))
    new = local.take(fresh[local.first] | fresh[local.second])
    first = np.concatenate([kept[known.first], made[new.first]])
    second = np.concatenate([kept[known.second], made[new.second]])
    start = np.concatenate([known.start, new.start])
    end = np.concatenate([known.end, new.end])
    # Joins of whole cells follow in the order of the mesh.
    rough = np.flatnonzero(cut[first] | cut[second])
    x, y = start[rough].T
    rough = rough[np.lexsort((y, x, second[rough], first[rough]))]
    order = np.concatenate([rough, np.flatnonzero(~(cut[first] | cut[second]))])
    return Joins(first[order], second[order], start[order], end[order])
