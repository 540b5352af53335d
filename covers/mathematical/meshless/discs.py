"""The discs that meet cells."""

from __future__ import annotations

import numpy as np

from integration.arrays import Floats, Ints
from integration.ragged import within

# Centres of discs nearer than this share of the largest distance differ by rounding alone.
LIKE = 1e-6


def discs_of_cells(nodes: Floats, radius: Floats, corners: Floats) -> Ints:
    """Return the patches (C, k) whose open disc meets each cell, padded with -1.

    Discs have ``nodes`` (V, 2) and ``radius`` (V,), m; cells ``corners`` (C, v, 2), convex and
    counter-clockwise.
    """
    from scipy.spatial import cKDTree

    middle = corners.mean(axis=1)
    reach = np.linalg.norm(corners - middle[:, None], axis=2).max(axis=1)
    found = cKDTree(nodes).query_ball_point(
        middle, reach + radius.max(initial=0.0), return_sorted=True
    )
    cell = np.repeat(np.arange(len(corners)), [len(row) for row in found])
    node = np.concatenate([np.empty(0, dtype=np.int64), *map(np.asarray, found)]).astype(np.int64)
    meets = _distance(corners[cell], nodes[node]) < radius[node] * (1 - 1e-12)
    cell, node = cell[meets], node[meets]
    number = np.bincount(cell, minlength=len(corners))
    place = within(number)
    patches = np.full((len(corners), number.max(initial=0)), -1, dtype=np.int64)
    patches[cell, place] = node
    return patches


def with_discs_alike(shape: Ints, patches: Ints, nodes: Floats, corner: Floats) -> Ints:
    """Return shapes (C,) of cells, divided where their patches (C, k) are placed differently.

    Cells have a first ``corner`` (C, 2), discs ``nodes`` (V, 2), m. A disc that just touches cells
    is a patch of some of them only, by rounding. Shapes of -1 stay.
    """
    away = np.where(patches[:, :, None] >= 0, nodes[patches] - corner[:, None], 0.0)
    grain = LIKE * np.abs(away).max(initial=0.0)
    places = np.round(away / (grain if grain > 0 else 1.0)).reshape(len(patches), -1)
    key = np.column_stack([shape, patches >= 0, places])
    parted = np.unique(key, axis=0, return_inverse=True)[1].ravel()
    return np.where(shape >= 0, parted, -1)


def _distance(corners: Floats, points: Floats) -> Floats:
    """Distance (m,) from points to convex counter-clockwise cells (m, v, 2), zero inside."""
    side = np.roll(corners, -1, axis=1) - corners
    away = points[:, None] - corners
    along = np.clip((away * side).sum(axis=2) / (side**2).sum(axis=2), 0.0, 1.0)
    to_side = np.linalg.norm(away - along[..., None] * side, axis=2).min(axis=1)
    inside = (side[..., 0] * away[..., 1] - side[..., 1] * away[..., 0] >= 0).all(axis=1)
    return np.where(inside, 0.0, to_side)
