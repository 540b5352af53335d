"""Patches of meshes of finite elements: the star of cells about each vertex."""

from __future__ import annotations

import numpy as np

from integration.arrays import Floats, Ints


def star_sizes(vertices: Floats, cell_vertices: Ints) -> Floats:
    """Largest distance (V,) from each vertex to a corner of the cells about it, m."""
    corners = vertices[cell_vertices]
    spans = np.linalg.norm(corners[:, :, None] - corners[:, None, :], axis=3).max(axis=2)
    sizes = np.zeros(len(vertices))
    np.maximum.at(sizes, cell_vertices.ravel(), spans.ravel())
    return np.where(sizes > 0, sizes, sizes.max(initial=1.0))


def counter_clockwise(vertices: Floats, cell_vertices: Ints) -> Ints:
    """The same cells with corners ordered counter-clockwise from the same first corner.

    Raises
    ------
    ValueError
        A cell without area, or one that is not convex.
    """
    corners = vertices[cell_vertices]
    sides = np.roll(corners, -1, axis=1) - corners
    onward = np.roll(sides, -1, axis=1)
    turns = sides[..., 0] * onward[..., 1] - sides[..., 1] * onward[..., 0]
    clockwise = turns.sum(axis=1) < 0
    bad = np.flatnonzero((turns * np.where(clockwise, -1.0, 1.0)[:, None] <= 0).any(axis=1))
    if len(bad):
        raise ValueError(
            f"cell {bad[0]}: {corners[bad[0]].tolist()}: a convex cell with area expected: "
            "repair the mesh"
        )
    mirrored = np.concatenate([cell_vertices[:, :1], cell_vertices[:, :0:-1]], axis=1)
    return np.where(clockwise[:, None], mirrored, cell_vertices)
