"""Polygons cut through by straight lines: shared vertices are one number in all pieces."""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
import shapely

from integration.arrays import Floats

Shapes = npt.NDArray[np.object_]
"""Polygons of shapely."""

# Vertices nearer to a line than this share of the polygon's extent lie on it: far above rounding,
# far below any piece.
ON = 1e-9


def pieces(polygon: shapely.Polygon, through: Floats, angles: Sequence[float]) -> Shapes:
    """Return the parts of a polygon between lines through a point (2,), each at an angle (rad).

    They come by the angle at which their middles are seen from the point, whatever the order of
    the polygon's vertices.
    """
    lines = [_line(polygon, through, angle) for angle in angles]
    net = shapely.union_all([polygon.boundary, *lines])
    faces = shapely.get_parts(shapely.polygonize([net]))
    found = faces[shapely.contains(polygon, shapely.point_on_surface(faces))]
    middle = shapely.get_coordinates(shapely.centroid(found)) - through
    order = np.argsort(np.arctan2(middle[:, 1], middle[:, 0]), kind="stable")
    return np.asarray(found[order], dtype=np.object_)


def face_length(polygon: shapely.Polygon, through: Floats, angle: float) -> float:
    """Return the length (m) of a line through a point (2,) that lies in a polygon."""
    return float(shapely.length(shapely.intersection(polygon, _line(polygon, through, angle))))


def _line(polygon: shapely.Polygon, through: Floats, angle: float) -> shapely.LineString:
    """Return the line through all of the polygon, by way of the vertices that are on it."""
    corners = shapely.get_coordinates(polygon)
    size = float(np.hypot(*np.ptp(corners, axis=0)))
    along = np.array([np.cos(angle), np.sin(angle)])
    away = corners - through
    off = away[:, 0] * along[1] - away[:, 1] * along[0]
    own = np.unique(corners[np.abs(off) <= ON * size], axis=0)
    ends = through + np.outer([-2 * size, 2 * size], along)
    points = np.concatenate([ends, own])
    return shapely.LineString(points[np.argsort((points - through) @ along)])
