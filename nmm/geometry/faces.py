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
    return faces_and_loose_ends(lines)[0]


def faces_and_loose_ends(lines: Sequence[Any] | Shapes) -> tuple[Shapes, Shapes]:
    """Faces as `faces` gives them, and the pieces of lines that bound no face."""
    noded = shapely.union_all(np.asarray(lines, dtype=object))
    found, bridges, dangles, _ = shapely.polygonize_full([noded])
    loose = np.concatenate([shapely.get_parts(bridges), shapely.get_parts(dangles)])
    return shapely.get_parts(found), loose


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


def absorb(candidates: Shapes, keep: Bools, group: Ints) -> tuple[Shapes, Ints]:
    """Unite each face that is not kept with the neighbour that shares the longest border.

    Parameters
    ----------
    candidates : (N,)
        Faces that share their vertices.
    keep : (N,)
        Faces to keep.
    group : (N,)
        Only faces of one group are united.

    Returns
    -------
    faces
        The kept faces, in order, some of them larger.
    index
        Their positions in `candidates`.
    """
    found, keep = candidates.copy(), keep.copy()
    alive = np.ones(len(found), dtype=bool)
    # One after the other: a face that grew by one scrap may be the neighbour of the next.
    for scrap in np.flatnonzero(~keep):
        near = alive & (group == group[scrap]) & shapely.intersects(found[scrap], found)
        near[scrap] = False
        others = np.flatnonzero(near)
        edges = shapely.boundary(found[others])
        border = shapely.length(shapely.intersection(shapely.boundary(found[scrap]), edges))
        if border.size and border.max() > 0.0:
            home = others[int(np.argmax(border))]
            found[home] = shapely.coverage_union(found[home], found[scrap])
            alive[scrap] = False
            keep[home] = True
    index = np.flatnonzero(alive & keep)
    return found[index], index
