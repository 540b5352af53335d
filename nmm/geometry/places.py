"""Places of supports and loads: points and segments against the edges of polygons."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from integration.arrays import Floats, Ints
from integration.polygons import Polygons
from nmm.errors import Fault, GeometryError

_RELATIVE = 1e-9  # of the extent: well above rounding, well below any feature


@dataclass(frozen=True)
class EdgeParts:
    """Parts of edges that lie on a segment.

    Attributes
    ----------
    edge : (m,)
        Index of the edge.
    start, end : (m, 2)
        Ends of the part, in the sense of the edge.
    """

    edge: Ints
    start: Floats
    end: Floats

    @property
    def lengths(self) -> Floats:
        """(m,) length of each part."""
        return np.asarray(np.hypot(*(self.end - self.start).T))


def tolerance(points: Floats) -> float:
    """Distance below which a point counts as being on an edge: 1e-9 of the extent of all points."""
    extent = float(np.hypot(*np.ptp(points, axis=0)))
    rounding = 16 * np.finfo(float).eps * float(np.abs(points).max())
    return max(_RELATIVE * extent, rounding)


def polygons_at(polygons: Polygons, point: Floats, within: float) -> Ints:
    """Polygons that contain a point or come within a distance of it, in order."""
    distance = shapely.distance(polygons.to_shapely(), shapely.Point(point))
    return np.flatnonzero(distance <= within)


def edge_distances(polygons: Polygons, points: Floats) -> Floats:
    """Distance (n,) of each point from the nearest edge of the polygons."""
    outline = shapely.union_all(shapely.boundary(polygons.to_shapely()))
    return np.asarray(shapely.distance(outline, shapely.points(points)))


def edges_on(start: Floats, end: Floats, segment: Floats, within: float) -> EdgeParts:
    """Parts of edges that lie on a segment; edges that only touch it have none.

    Parameters
    ----------
    start, end : (n, 2)
        Ends of the edges.
    segment : (2, 2)
        Ends of the segment.
    within
        Largest distance between a part and the segment.
    """
    length = float(np.hypot(*(segment[1] - segment[0])))
    along = (segment[1] - segment[0]) / length
    across = np.array([-along[1], along[0]])
    s0, s1 = (start - segment[0]) @ along, (end - segment[0]) @ along
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        t = np.clip((np.array([[0.0], [length]]) - s0) / (s1 - s0), 0.0, 1.0)
    low, high = np.min(t, axis=0), np.max(t, axis=0)
    step = end - start
    p, q = start + low[:, None] * step, start + high[:, None] * step
    off = np.maximum(np.abs((p - segment[0]) @ across), np.abs((q - segment[0]) @ across))
    long = np.hypot(*(q - p).T)
    edge = np.flatnonzero((off <= within) & (long > within) & (np.abs(s1 - s0) > within))
    return EdgeParts(edge, p[edge], q[edge])


def insert_vertices(polygon: Polygons, points: Floats, place: str) -> Polygons:
    """Polygons with points on their edges made vertices, exactly where they are given.

    Raises
    ------
    GeometryError
        A point is farther from every edge than the tolerance.
    """
    within = tolerance(polygon.points)
    start, end = polygon.points, polygon.points[polygon.next_point]
    step = end - start
    chosen: dict[int, list[tuple[float, list[float]]]] = {}
    for point in points:  # a few points
        t = np.clip(np.sum((point - start) * step, axis=1) / np.sum(step**2, axis=1), 0.0, 1.0)
        away = np.hypot(*(start + t[:, None] * step - point).T)
        if away.min() > within:
            value = f"point {point.tolist()} is {away.min():.3g} m away"
            remedy = "move it onto an edge, or leave it out"
            raise GeometryError(Fault(place, value, "a point on the boundary", remedy))
        if np.hypot(*(start - point).T).min() > within:
            edge = int(np.argmin(away))
            chosen.setdefault(edge, []).append((float(t[edge]), point.tolist()))
    if not chosen:
        return polygon
    edges = sorted((edge, *entry) for edge, entries in chosen.items() for entry in entries)
    return _inserted(polygon, edges, within)


def _inserted(
    polygon: Polygons, edges: list[tuple[int, float, list[float]]], within: float
) -> Polygons:
    rows, values = [], []
    last: tuple[int, list[float]] | None = None
    for edge, _, point in edges:
        if last is None or last[0] != edge or np.hypot(*np.subtract(point, last[1])) > within:
            rows.append(edge + 1)
            values.append(point)
        last = (edge, point)
    points = np.insert(polygon.points, rows, values, axis=0)
    rings = polygon.ring_of_point[np.asarray(rows) - 1]
    added = np.bincount(rings, minlength=len(polygon.ring_offsets) - 1)
    counts = np.diff(polygon.ring_offsets) + added
    offsets = np.concatenate([[0], np.cumsum(counts)]).astype(np.int64)
    return Polygons(points, offsets, polygon.polygon_offsets)
