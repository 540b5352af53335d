"""Cutting by grown cracks, with the same result to the last bit as cutting everything anew.

The order of elements, edges and covers follows from their places (`covers.cutting.pieces`), so that
kept and new ones only have to be merged.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from covers.cutting.again.merged_boundary import merged_boundary, merged_tips
from covers.cutting.again.merged_covers import merged_bodies, merged_covers
from covers.cutting.again.merged_elements import merged_elements
from covers.cutting.again.window import Window, window_of
from covers.cutting.cracks import crack_segments
from covers.cutting.cut import Cutting, cutting
from covers.cutting.cut_cells import CutCells, Layer
from covers.cutting.layers.arranged import arranged


def cut_again(before: Cutting, cracks: Sequence[npt.ArrayLike]) -> Cutting:
    """Cut the same cover and regions by other cracks.

    Parameters
    ----------
    before : Cutting
        the previous cut.
    cracks : sequence of (n, 2)
        polylines. If they are the previous ones with new segments at their ends, inside the
        regions, only cells about these segments are cut again.

    Returns
    -------
    Cutting
        What `covers.cutting.cut.cutting` would return.
    """
    window = window_of(before, crack_segments(cracks))
    found = None if window is None else _merged(before, window)
    if window is None or found is None:
        return cutting(
            before.cover,
            before.regions,
            cracks,
            glue=before.group,
            tolerance=before.tolerance,
            smallest=before.smallest,
            rounding=before.rounding,
        )
    return replace(before, layers=(window.lines,), cells=found)


def _arranged(before: Cutting, window: Window) -> Layer:
    cells = window.lines.cells
    local = replace(
        cells,
        touched=cells.touched & window.around,
        region=np.where(window.around, cells.region, -1),
    )
    nothing = window.lines.boundary.take(np.zeros(0, dtype=np.int64))
    return arranged(
        before.cover,
        local,
        nothing,
        window.cracks,
        2 * window.lines.margin,
        before.resolution,
        before.smallest,
        before.group,
        part=True,
    )


def _merged(before: Cutting, window: Window) -> CutCells | None:
    """Return the merged cut; None if kept and new parts do not fit."""
    if not window.inner.any():  # new segments outside of all material
        return before.cells
    old, local = before.cells, _arranged(before, window)
    parts = merged_elements(old, local, window)
    if parts is None:
        return None
    boundary = merged_boundary(old.boundary, local.boundary, parts)
    if boundary is None:
        return None
    body = merged_bodies(old, parts, window)
    covers, patch, first = merged_covers(before.cover, old, parts, window)
    return replace(
        old,
        elements=parts.elements,
        element_cell=parts.cell,
        element_region=parts.region,
        element_body=body,
        element_whole=parts.whole,
        covers=covers,
        cover_patch=patch,
        cover_region=parts.region[first],
        cover_body=body[first],
        boundary=replace(boundary, body=body[boundary.element]),
        tips=merged_tips(old.tips, local.tips, parts),
        joins=parts.joins,
    )
