"""Bodies and physical covers of an updated cut."""

from __future__ import annotations

import numpy as np

from covers.cutting.again.merged_elements import MergedElements
from covers.cutting.again.window import Window
from covers.cutting.components import components
from covers.cutting.connectivity import Joins, bodies, physical_covers
from covers.cutting.cut_cells import CutCells
from covers.mathematical.patch_mesh import PatchMesh
from integration.arrays import Bools, Ints
from integration.permutations import inverse


def merged_bodies(old: CutCells, parts: MergedElements, window: Window) -> Ints:
    """Return the body (E,) of each element: as before if the window stays connected, else anew."""
    inside = window.around[parts.cell]
    own = np.unique(old.element_body[window.around[old.element_cell]])
    row, joins = _among(inside, parts.joins)
    together = components(int(inside.sum()), row[joins.first], row[joins.second])
    if len(own) > 1 or together.any():
        return bodies(len(parts.cell), parts.region, parts.joins)
    body = np.full(len(parts.cell), own[0], dtype=np.int64)
    stays = parts.kept >= 0
    body[parts.kept[stays]] = old.element_body[stays]
    return body


def merged_covers(
    cover: PatchMesh, old: CutCells, parts: MergedElements, window: Window
) -> tuple[Ints, Ints, Ints]:
    """Return the covers (E, k) of elements, and the patch (P,) and an element (P,) of each cover.

    Connected parts are found again for patches with cells that were cut again.
    """
    asked = np.zeros(cover.n_patches + 1, dtype=bool)  # the last entry is for -1
    asked[cover.cell_patches[window.inner]] = True
    asked[-1] = False
    patches = cover.cell_patches[parts.cell]
    mine = asked[patches]
    some = np.asarray(mine.any(axis=1))
    row, joins = _among(some, parts.joins)
    local = Joins(row[joins.first], row[joins.second], joins.start, joins.end)
    found = physical_covers(
        cover,
        parts.elements.take(some),
        parts.cell[some],
        parts.region[some],
        local,
        window.lines.cells.touched,
    )
    kept, new = np.flatnonzero(~asked[old.cover_patch]), np.flatnonzero(asked[found.patch])
    patch = np.concatenate([old.cover_patch[kept], found.patch[new]])
    order = np.argsort(patch, kind="stable")
    rank = inverse(order)
    was = np.full(old.n_covers + 1, -1, dtype=np.int64)
    was[kept] = rank[: len(kept)]
    now = np.full(len(found.patch) + 1, -1, dtype=np.int64)
    now[new] = rank[len(kept) :]
    covers = np.full(patches.shape, -1, dtype=np.int64)
    stays = parts.kept >= 0
    covers[parts.kept[stays]] = was[old.covers[stays]]
    there = np.flatnonzero(some)
    covers[there] = np.where(mine[there], now[found.of_element], covers[there])
    first = np.empty(len(order), dtype=np.int64)
    element, slot = np.nonzero(covers >= 0)
    first[covers[element, slot]] = element
    return covers, patch[order], first


def _among(chosen: Bools, joins: Joins) -> tuple[Ints, Joins]:
    """Row (E,) of each chosen element among the chosen ones, and the joins between them."""
    row = np.cumsum(chosen) - 1
    return row, joins.take(chosen[joins.first] & chosen[joins.second])
