"""Cracks and joints as polylines, snapped to what they nearly touch."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
import shapely

from covers.cutting.components import components, unique_rows
from covers.cutting.domain import Segments
from integration.arrays import Floats, Ints


def crack_segments(cracks: Sequence[npt.ArrayLike]) -> Segments:
    """Return the segments of polylines, each an array (n, 2) of points (m).

    Raises
    ------
    ValueError
        A crack has fewer than two distinct points, another shape, or is not finite.
    """
    lines = [_polyline(crack, number) for number, crack in enumerate(cracks)]
    if not lines:
        return Segments(np.empty((0, 2)), np.empty((0, 2)), np.empty(0, dtype=np.int64))
    owner = np.repeat(np.arange(len(lines)), [len(line) - 1 for line in lines])
    start = np.concatenate([line[:-1] for line in lines])
    return Segments(start, np.concatenate([line[1:] for line in lines]), owner)


def clipped(segments: Segments, low: Floats, high: Floats) -> Segments:
    """Return the parts of segments inside a box (Liang and Barsky 1984); inner ends stay exact.

    ``low`` and ``high`` (2,) are corners of the box, m.
    """
    along = segments.end - segments.start
    with np.errstate(divide="ignore", invalid="ignore"):
        one, two = (low - segments.start) / along, (high - segments.start) / along
    flat = along == 0
    outside = flat & ((segments.start < low) | (segments.start > high))
    enter = np.where(flat, -np.inf, np.minimum(one, two)).max(axis=1).clip(min=0.0)
    leave = np.where(flat, np.inf, np.maximum(one, two)).min(axis=1).clip(max=1.0)
    kept = (enter < leave) & ~outside.any(axis=1)
    start = np.where(enter[:, None] > 0, segments.start + enter[:, None] * along, segments.start)
    end = np.where(leave[:, None] < 1, segments.start + leave[:, None] * along, segments.end)
    return Segments(start, end, segments.owner).take(kept)


def settled(
    cracks: Segments, boundary: Segments, vertices: Floats, edges: Segments, tolerance: float
) -> Segments:
    """Return cracks moved by at most ``tolerance`` (m) onto what they nearly touch.

    Ends and kinks within the tolerance of a corner of a region, a vertex of the mesh or each other
    are moved to it; else to the nearest place of a boundary or mesh edge within the tolerance. Then
    segments that pass such a point within the tolerance are bent to pass through it. All else stays
    exactly as it is.

    Parameters
    ----------
    boundary, edges
        boundaries of regions and edges of the mesh near the cracks.
    vertices : (n, 2)
        vertices of the mesh near the cracks.
    """
    if not len(cracks):
        return cracks
    ends = np.concatenate([cracks.start, cracks.end])
    first, point = unique_rows(ends)
    places = _settled_points(ends[first], boundary, vertices, edges, tolerance)
    moved = Segments(places[point[: len(cracks)]], places[point[len(cracks) :]], cracks.owner)
    stops = np.concatenate([boundary.start, vertices, places])
    return _bent(moved, stops[unique_rows(stops)[0]], tolerance)


def _settled_points(
    points: Floats, boundary: Segments, vertices: Floats, edges: Segments, tolerance: float
) -> Floats:
    from scipy.spatial import cKDTree

    places = points.copy()
    unmoved = np.ones(len(points), dtype=bool)
    for targets in (boundary.start, vertices):  # corners of regions have priority over the mesh
        if len(targets):
            distance, nearest = cKDTree(targets).query(places, distance_upper_bound=tolerance)
            found = unmoved & np.isfinite(distance)
            places[found] = targets[np.asarray(nearest)[found]]
            unmoved &= ~found
    places, unmoved = _clustered(places, unmoved, tolerance)
    for segments in (boundary, edges):
        wanted = np.flatnonzero(unmoved)
        row, foot = _feet(places[wanted], segments, tolerance)
        places[wanted[row]] = foot
        unmoved[wanted[row]] = False
    return places


def _clustered(
    places: Floats, unmoved: npt.NDArray[np.bool_], tolerance: float
) -> tuple[Floats, npt.NDArray[np.bool_]]:
    """Merge points within the tolerance of each other: to one already moved, or to the first."""
    from scipy.spatial import cKDTree

    pairs = cKDTree(places).query_pairs(tolerance, output_type="ndarray").reshape(-1, 2)
    group = components(len(places), pairs[:, 0], pairs[:, 1])
    order = np.lexsort((unmoved, group))
    leader = order[np.unique(group[order], return_index=True)[1]][group]
    return np.where(unmoved[:, None], places[leader], places), unmoved & unmoved[leader]


def _feet(points: Floats, segments: Segments, tolerance: float) -> tuple[Ints, Floats]:
    """Rows of points within the tolerance of a segment, and the nearest places on segments."""
    if not (len(points) and len(segments)):
        return np.empty(0, dtype=np.int64), np.empty((0, 2))
    row, segment = shapely.STRtree(segments.lines()).query(
        shapely.points(points), predicate="dwithin", distance=tolerance
    )
    start, along = segments.start[segment], segments.end[segment] - segments.start[segment]
    share = ((points[row] - start) * along).sum(axis=1) / (along**2).sum(axis=1)
    foot = start + np.clip(share, 0.0, 1.0)[:, None] * along
    order = np.lexsort((((points[row] - foot) ** 2).sum(axis=1), row))
    nearest = order[np.unique(row[order], return_index=True)[1]]
    return row[nearest], foot[nearest]


def _bent(cracks: Segments, stops: Floats, tolerance: float) -> Segments:
    """Bend segments to pass through all points (``stops``) within the tolerance."""
    kept = (cracks.start != cracks.end).any(axis=1)
    cracks = cracks.take(kept)
    segment, stop = shapely.STRtree(np.asarray(shapely.points(stops))).query(
        cracks.lines(), predicate="dwithin", distance=tolerance
    )
    start, along = cracks.start[segment], cracks.end[segment] - cracks.start[segment]
    share = ((stops[stop] - start) * along).sum(axis=1) / (along**2).sum(axis=1)
    own = (stops[stop] == start).all(axis=1) | (stops[stop] == cracks.end[segment]).all(axis=1)
    passed = (share > 0) & (share < 1) & ~own
    n = len(cracks)
    row = np.concatenate([np.arange(n), segment[passed], np.arange(n)])
    place = np.concatenate([cracks.start, stops[stop[passed]], cracks.end])
    order = np.lexsort((np.concatenate([np.full(n, -1.0), share[passed], np.full(n, 2.0)]), row))
    row, place = row[order], place[order]
    link = row[1:] == row[:-1]
    bent = Segments(place[:-1][link], place[1:][link], cracks.owner[row[1:][link]])
    return bent.take((bent.start != bent.end).any(axis=1))


def _polyline(crack: npt.ArrayLike, number: int) -> Floats:
    points = np.array(crack, dtype=float)
    if points.ndim != 2 or points.shape[1:] != (2,) or not np.isfinite(points).all():
        raise ValueError(
            f"crack {number}: shape {points.shape} or not finite: (n, 2) numbers expected: "
            "give rows of x and y"
        )
    distinct = np.ones(len(points), dtype=bool)
    distinct[1:] = (points[1:] != points[:-1]).any(axis=1)
    if distinct.sum() < 2:
        raise ValueError(
            f"crack {number}: {int(distinct.sum())} distinct points: at least 2 expected: "
            "add points or leave the crack out"
        )
    return points[distinct]
