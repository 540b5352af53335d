"""Polygons as cells that viewers draw right: convex ones whole, the others as triangles."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Bools, Ints
from integration.plane_vectors import cross
from integration.polygons import Polygons


@dataclass(frozen=True)
class PolygonCells:
    """Cells over the points of polygons.

    Attributes
    ----------
    connectivity
        Point indices of all cells, one after the other.
    offsets
        (n,) end of each cell in `connectivity`.
    polygon
        (n,) polygon that each cell is a part of.
    """

    connectivity: Ints
    offsets: Ints
    polygon: Ints


def cells(polygons: Polygons) -> PolygonCells:
    """Return the cells of polygons; triangles use the polygon's own vertices."""
    whole = drawable(polygons)
    chosen = np.flatnonzero(whole)
    sizes = np.bincount(polygons.polygon_of_point, minlength=len(polygons))
    points = np.flatnonzero(whole[polygons.polygon_of_point])
    triangles, owner = _triangles(polygons, np.flatnonzero(~whole))
    lengths = np.concatenate([sizes[chosen], np.full(len(triangles), 3)])
    return PolygonCells(
        connectivity=np.concatenate([points, triangles.ravel()]).astype(np.int64),
        offsets=np.cumsum(lengths).astype(np.int64),
        polygon=np.concatenate([chosen, owner]).astype(np.int64),
    )


def drawable(polygons: Polygons) -> Bools:
    """(N,) whether a polygon is convex and has no hole: viewers draw it as a fan of triangles."""
    points = polygons.points
    ahead = points[polygons.next_point] - points
    after = ahead[polygons.next_point]
    turn = cross(ahead, after)
    size = np.hypot(*ahead.T) * np.hypot(*after.T)
    side = np.sign(polygons.ring_areas)[polygons.ring_of_point]
    hollow = turn * side < -1e-12 * size
    reentrant = np.bincount(polygons.polygon_of_point, weights=hollow, minlength=len(polygons))
    return np.asarray((reentrant == 0) & (np.diff(polygons.polygon_offsets) == 1))


def _triangles(polygons: Polygons, chosen: Ints) -> tuple[Ints, Ints]:
    """Constrained Delaunay triangles of the chosen polygons as point indices, and their owners."""
    if not len(chosen):
        return np.zeros((0, 3), dtype=np.int64), np.zeros(0, dtype=np.int64)
    import shapely

    collections = shapely.constrained_delaunay_triangles(polygons.take(chosen).to_shapely())
    parts, owner = shapely.get_parts(collections, return_index=True)
    corners = shapely.get_coordinates(shapely.get_exterior_ring(parts)).reshape(-1, 4, 2)[:, :3]
    owner = chosen[owner]
    index = {
        (polygon, x, y): point
        for point, (polygon, x, y) in enumerate(
            zip(polygons.polygon_of_point.tolist(), *polygons.points.T.tolist(), strict=True)
        )
    }
    flat = zip(np.repeat(owner, 3).tolist(), *corners.reshape(-1, 2).T.tolist(), strict=True)
    return np.array([index[key] for key in flat], dtype=np.int64).reshape(-1, 3), owner
