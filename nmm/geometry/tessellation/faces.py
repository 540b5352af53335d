"""Faces of a line work: noded once, so that neighbours share their vertices bit by bit."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt
import shapely

from integration.arrays import Bools, Ints

Shapes = npt.NDArray[np.object_]


def faces(lines: Sequence[Any] | Shapes) -> Shapes:
    """All faces enclosed by lines, which are broken where they meet.

    A crossing is computed once, for all faces around it; a vertex on the edge of another face
    becomes a vertex of that face too.
    """
    return faces_and_dangles(lines)[0]


def faces_and_dangles(
    lines: Sequence[Any] | Shapes, grid: float | None = None
) -> tuple[Shapes, Shapes]:
    """Faces as `faces` gives them, and the pieces of lines that bound no face.

    With a grid all vertices are rounded to its multiples (snap rounding, Hobby 1999), so that lines
    that almost coincide become one, and no two faces overlap by rounding.
    """
    noded = shapely.union_all(np.asarray(lines, dtype=object), grid_size=grid)
    found, bridges, dangles, _ = shapely.polygonize_full([noded])
    others = np.concatenate([shapely.get_parts(bridges), shapely.get_parts(dangles)])
    return shapely.get_parts(found), others


def inside(candidates: Shapes, region: Any) -> Bools:
    """Faces that lie in a region; none may cross its boundary."""
    shapely.prepare(region)
    return np.asarray(shapely.contains(region, shapely.point_on_surface(candidates)))


def owners(points: Shapes, shapes: Shapes) -> Ints:
    """Shape that holds each point, -1 for none."""
    owner = np.full(len(points), -1, dtype=np.int64)
    index, shape = shapely.STRtree(shapes).query(points, predicate="within")
    owner[index] = shape
    return owner
