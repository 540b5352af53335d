"""Triangles that tile polygons."""

from __future__ import annotations

import numpy as np
import shapely

from integration.arrays import Bools, Floats, Ints
from integration.polygons import Polygons, diameters

# A direction in which no two vertices of rectangles and of nets of usual angles are level, so that
# rounding does not choose between them.
UP = np.array([0.6347, 0.7728])


def triangulate(polygons: Polygons) -> tuple[Floats, Ints]:
    """Counter-clockwise triangles (T, 3, 2) that tile each polygon and their polygon (T,), sorted.

    A ring seen whole from its lowest vertex, as every convex one, is cut into a fan; the others go
    through the constrained Delaunay triangulation of GEOS. No new vertices. Polygons of zero area
    have no triangles.

    Raises
    ------
    ValueError
        A polygon that crosses itself or its holes.
    """
    fans, owner, seen = _fans(polygons)
    rest = np.flatnonzero(~seen & (polygons.areas != 0.0))
    if len(rest):
        others, other_owner = _delaunay(polygons.take(rest), rest)
        fans = np.concatenate([fans, others])
        owner = np.concatenate([owner, other_owner])
        order = np.argsort(owner, kind="stable")
        fans, owner = fans[order], owner[order]
    return fans, owner


def triangulate_alike(polygons: Polygons) -> tuple[Floats, Ints]:
    """Triangles as those of `triangulate`, turned or mirrored where the polygon is.

    A ring of four and more vertices seen whole from its centroid, as every convex one, is cut into
    a fan about that point, one triangle an edge; the others are cut as `triangulate` does.

    Raises
    ------
    ValueError
        A polygon that crosses itself or its holes.
    """
    single = np.diff(polygons.polygon_offsets) == 1
    many = np.bincount(polygons.polygon_of_point, minlength=len(polygons)) > 3
    chosen = np.flatnonzero(single & many & (polygons.areas != 0.0))
    own = polygons.take(chosen)
    owner = own.polygon_of_point
    triangles = np.stack([own.centroids[owner], own.points, own.points[own.next_point]], axis=1)
    clockwise = own.ring_areas[owner] < 0
    triangles[clockwise] = triangles[clockwise][:, [0, 2, 1]]
    area = triangle_areas(triangles)
    seen = np.bincount(owner[area < 0], minlength=len(own)) == 0
    keep = seen[owner] & (area > 0)
    rest = np.setdiff1d(np.arange(len(polygons)), chosen[seen])
    others, other_owner = triangulate(polygons.take(rest))
    found = np.concatenate([triangles[keep], others])
    of = np.concatenate([chosen[owner[keep]], rest[other_owner]])
    order = np.argsort(of, kind="stable")
    return found[order], of[order]


def triangle_areas(triangles: Floats) -> Floats:
    """Signed area (T,) of triangles (T, 3, 2), positive when counter-clockwise."""
    (x1, y1), (x2, y2) = (
        (triangles[:, 1] - triangles[:, 0]).T,
        (triangles[:, 2] - triangles[:, 0]).T,
    )
    return np.asarray(0.5 * (x1 * y2 - x2 * y1))


def _fans(polygons: Polygons) -> tuple[Floats, Ints, Bools]:
    """Fans about lowest vertices, their polygons, and which polygons (N,) they tile."""
    owner = polygons.polygon_of_point
    index = np.arange(len(owner))
    lowest = _lowest(polygons)
    single = np.diff(polygons.polygon_offsets) == 1
    inner = single[owner] & (index != lowest[owner])
    inner &= polygons.next_point != lowest[owner]
    index, owner = index[inner], owner[inner]
    corners = np.stack([lowest[owner], index, polygons.next_point[index]], axis=1)
    clockwise = polygons.ring_areas[polygons.polygon_offsets[:-1]][owner] < 0
    corners[clockwise] = corners[clockwise][:, [0, 2, 1]]
    triangles = polygons.points[corners]
    area = triangle_areas(triangles)
    seen = single & (np.bincount(owner[area < 0], minlength=len(polygons)) == 0)
    keep = seen[owner] & (area > 0) & (polygons.areas != 0.0)[owner]
    return triangles[keep], owner[keep], seen


def _lowest(polygons: Polygons) -> Ints:
    """Lowest vertex (N,) of each polygon, as seen along `UP`.

    What no rule integrates exactly would else depend on the vertex at which a ring is begun.
    """
    owner = polygons.polygon_of_point
    height = (polygons.points - polygons.points[polygons.first_point][owner]) @ UP
    least = np.flatnonzero(height == np.minimum.reduceat(height, polygons.first_point)[owner])
    return np.asarray(least[np.searchsorted(owner[least], np.arange(len(polygons)))])


def _delaunay(polygons: Polygons, number: Ints) -> tuple[Floats, Ints]:
    shapes = polygons.to_shapely()
    try:
        parts = shapely.constrained_delaunay_triangles(shapes)
    except shapely.errors.GEOSException:
        raise _fault(polygons, number, ~shapely.is_valid(shapes)) from None
    corners, owner = shapely.get_coordinates(np.asarray(parts), return_index=True)
    triangles, owner = corners.reshape(-1, 4, 2)[:, :3].copy(), owner[::4]
    area = triangle_areas(triangles)
    triangles[area < 0] = triangles[area < 0][:, [0, 2, 1]]
    tiled = np.bincount(owner, np.abs(area), minlength=len(polygons))
    missed = np.abs(tiled - polygons.areas) > 1e-9 * diameters(polygons) ** 2
    if missed.any():
        raise _fault(polygons, number, missed)
    keep = area != 0.0
    return triangles[keep], number[owner[keep]]


def _fault(polygons: Polygons, number: Ints, bad: Bools) -> ValueError:
    n = int(np.flatnonzero(bad)[0]) if bad.any() else 0
    reason = shapely.is_valid_reason(polygons.take([n]).to_shapely()[0])
    return ValueError(
        f"polygon {number[n]}: {reason}: rings that do not cross expected: "
        "split the polygon at the crossing"
    )
