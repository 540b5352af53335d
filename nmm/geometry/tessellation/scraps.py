"""Slivers of a tessellation united with their neighbours."""

from __future__ import annotations

from collections import defaultdict
from math import dist

import numpy as np
import shapely

from integration.arrays import Bools, Ints
from integration.polygons import Polygons
from nmm.geometry.tessellation.faces import Shapes

_Edge = tuple[tuple[float, ...], tuple[float, ...]]


def absorb(faces: Shapes, keep: Bools, group: Ints) -> tuple[Shapes, Ints]:
    """Unite each face that is not kept with the neighbour that shares the longest border.

    Parameters
    ----------
    faces : (N,)
        Faces that share their vertices bit by bit and do not overlap.
    keep : (N,)
        Faces to keep; of scraps that only touch scraps, the first is kept too.
    group : (N,)
        Only faces of one group are united.

    Returns
    -------
    faces
        The kept faces, in order, some of them larger.
    index
        Their positions in `faces`.
    """
    if keep.all():
        return faces, np.arange(len(faces))
    borders = _borders(faces, group)
    home = {int(face): int(face) for face in np.flatnonzero(keep)}
    waiting = [int(face) for face in np.flatnonzero(~keep)]
    # Scraps next to a kept face first, then scraps next to those: a scrap may lie among scraps.
    while waiting:
        settled = {scrap: near for scrap in waiting if (near := _home(borders[scrap], home))}
        if not settled:
            settled = {waiting[0]: (0.0, waiting[0])}
        home.update({scrap: face for scrap, (_, face) in settled.items()})
        waiting = [scrap for scrap in waiting if scrap not in settled]
    parts: dict[int, list[int]] = defaultdict(list)
    for face, owner in home.items():
        parts[owner].append(face)
    index = np.array(sorted(parts), dtype=np.int64)
    united = faces[index]
    for position, owner in enumerate(index.tolist()):
        if len(parts[owner]) > 1:
            united[position] = shapely.coverage_union_all(faces[parts[owner]])
    return united, index


def _home(borders: dict[int, float], home: dict[int, int]) -> tuple[float, int] | None:
    """Longest border with faces that have a home, and that home; the first of equals."""
    found = [(length, -home[face]) for face, length in borders.items() if face in home]
    return (max(found)[0], -max(found)[1]) if found else None


def _borders(faces: Shapes, group: Ints) -> list[dict[int, float]]:
    """Length of the border of each face with each neighbour of its group."""
    polygons = Polygons.from_shapely(faces).oriented()
    start = [tuple(point) for point in polygons.points.tolist()]
    end = [start[index] for index in polygons.next_point.tolist()]
    face = polygons.polygon_of_point.tolist()
    left: dict[_Edge, int] = dict(zip(zip(start, end, strict=True), face, strict=True))
    borders: list[dict[int, float]] = [defaultdict(float) for _ in faces]
    for (a, b), here in left.items():
        there = left.get((b, a))
        if there is not None and there != here and group[there] == group[here]:
            borders[here][there] += dist(a, b)
    return borders
