"""Surfaces of polygons, and their near pairs by shapely: what the compiled search is held to."""

import numpy as np
import shapely

from integration.arrays import Bools, Floats, Ints
from integration.permutations import inverse
from integration.plane_vectors import cross
from integration.polygons import Polygons
from nmm.contact.detection.grid import pairs_by_grid
from nmm.contact.detection.surface import Surface


def polygon_surface(polygons: Polygons) -> Surface:
    """Surface of polygons, one body each; rings are turned to have the solid on the left."""
    polygons = polygons.oriented()
    follower = polygons.next_point
    return Surface(
        polygons.points,
        polygons.points[follower],
        polygons.polygon_of_point,
        follower,
        inverse(follower),
    )


def near_pairs(
    surface: Surface, distance: float | Floats, within_bodies: bool = False
) -> tuple[Ints, Ints]:
    """Vertex and edge (m,) of all near pairs, by the grid; ``distance`` (n,) or of all (m)."""
    distances = np.broadcast_to(np.asarray(distance, dtype=float), len(surface)).copy()
    return pairs_by_grid(surface, distances, within_bodies)


def near_pairs_by_tree(
    surface: Surface, distance: float, within_bodies: bool = False
) -> tuple[Ints, Ints]:
    """As `near_pairs`, by shapely's tree: the slower form that the grid is tested against."""
    lines = shapely.linestrings(np.stack([surface.start, surface.end], axis=1))
    tree = shapely.STRtree(np.atleast_1d(np.asarray(lines, dtype=object)))
    points = np.atleast_1d(np.asarray(shapely.points(surface.start), dtype=object))
    vertex, edge = tree.query(points, predicate="dwithin", distance=distance).astype(np.int64)
    keep = surface.body[vertex] != surface.body[edge]
    if within_bodies:
        keep |= _apart(surface, vertex, edge)
    order = np.lexsort((edge[keep], vertex[keep]))
    return vertex[keep][order], edge[keep][order]


def _apart(surface: Surface, vertex: Ints, edge: Ints) -> Bools:
    """Pairs of which vertex and edge can meet: across a reentrant corner at the nearest."""
    before, after = surface.previous, surface.next
    u = surface.direction[before]
    turn = cross(u, surface.direction)
    back = (u * surface.direction).sum(axis=1) < 0.0
    reentrant = (turn <= 1e-9) & ((turn < 0.0) | back)
    close = (edge == vertex) | (edge == before[vertex])
    close |= (edge == after[vertex]) & ~reentrant[after[vertex]]
    close |= (edge == before[before[vertex]]) & ~reentrant[before[vertex]]
    return np.asarray(~close)
