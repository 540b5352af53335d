"""Edges of elements that are drawn as lines: outlines of regions, and cracks that have opened."""

from typing import Any

import numpy as np

from integration.arrays import Bools, Floats, Ints
from integration.polygons import Polygons
from nmm.results.frame import Frame, Topology

SAME = 1e-9  # of the size: points closer are one
JUMP = 1e-6  # of the largest displacement: faces that moved apart by more are a crack
# The same of a face that meets several, of which a bent one is no straight line.
JUMP_OF_SEVERAL = 1e-2


def outlines(topology: Topology) -> Ints:
    """(n,) points at which an edge starts that two elements of one region do not share.

    What is left is the outline of each region. An edge that a point of its neighbours divides, as
    at the tip of a crack, is shared by those neighbours together.
    """
    alone, region = _alone(topology)
    return alone[~_covered(segments(topology.elements, alone), region)]


def opened_on_several(topology: Topology, frame: Frame) -> Ints:
    """(n,) points at which an edge starts that lay on several of its region, and moved apart.

    So do faces of blocks that have split more than once.
    """
    largest = float(np.abs(frame.displacement).max(initial=0.0))
    alone, region = _alone(topology)
    edges = segments(topology.elements, alone)
    if not largest > 0 or not len(edges):
        return alone[:0]
    size = float(np.ptp(edges.reshape(-1, 2), axis=0).max())
    moved = topology.elements.points + frame.displacement * size / largest
    now = segments(topology.elements.with_points(moved), alone)
    return alone[_covered(edges, region) & ~_covered(now, region, JUMP_OF_SEVERAL)]


def _alone(topology: Topology) -> tuple[Ints, Ints]:
    """(n,) points at which edges start that are no other's, and their regions."""
    keys, _ = _keys(topology)
    _, index, count = np.unique(keys, axis=0, return_inverse=True, return_counts=True)
    alone = np.flatnonzero(count[index.ravel()] == 1)
    return alone, topology.element_region[topology.elements.polygon_of_point[alone]]


def cracks(topology: Topology, frame: Frame) -> Ints:
    """(n,) points at which an edge starts that an element shares, and from which it moved apart.

    Before the run both faces of a crack are one line; it is told by the jump of the displacement.
    """
    keys, swapped = _keys(topology)
    _, index, count = np.unique(keys, axis=0, return_inverse=True, return_counts=True)
    index = index.ravel()
    paired = np.flatnonzero(count[index] == 2)
    order = paired[np.argsort(index[paired], kind="stable")].reshape(-1, 2)
    move = np.stack([frame.displacement, frame.displacement[topology.elements.next_point]], axis=1)
    move[swapped] = move[swapped, ::-1]
    apart = np.abs(move[order[:, 0]] - move[order[:, 1]]).max(axis=(1, 2))
    largest = float(np.abs(frame.displacement).max(initial=0.0))
    return np.sort(order[apart > JUMP * largest].ravel())


def segments(polygons: Polygons, start: Ints) -> Floats:
    """(n, 2, 2) edges that start at the given points."""
    return np.stack([polygons.points[start], polygons.points[polygons.next_point[start]]], axis=1)


def _keys(topology: Topology) -> tuple[Ints, Bools]:
    """Region and rounded ends of each edge, the lesser end first; and which had to be swapped."""
    elements = topology.elements
    points = elements.points
    size = float(np.ptp(points, axis=0).max())
    rounded = np.round((points - points.min(axis=0)) / (SAME * size)).astype(np.int64)
    ends = np.stack([rounded, rounded[elements.next_point]], axis=1)
    first_is_less = (ends[:, 0, 0] < ends[:, 1, 0]) | (
        (ends[:, 0, 0] == ends[:, 1, 0]) & (ends[:, 0, 1] < ends[:, 1, 1])
    )
    ends[~first_is_less] = ends[~first_is_less, ::-1]
    region = topology.element_region[elements.polygon_of_point]
    return np.column_stack([region, ends.reshape(-1, 4)]), ~first_is_less


def _covered(edges: Floats, region: Ints, same: float = SAME) -> Bools:
    """(n,) whether an edge lies on others of its region over its whole length.

    Points are one that are nearer than ``same`` of the size.
    """
    import shapely

    if not len(edges):
        return np.zeros(0, dtype=bool)
    size = float(np.ptp(edges.reshape(-1, 2), axis=0).max())
    lines: Any = shapely.linestrings(edges)
    mine, other = shapely.STRtree(lines).query(lines, predicate="dwithin", distance=same * size)
    kept = (mine != other) & (region[mine] == region[other])
    mine, other = mine[kept], other[kept]
    start, along = edges[mine, 0], edges[mine, 1] - edges[mine, 0]
    length = np.maximum(np.hypot(*along.T), 1e-300)
    way = along / length[:, None]
    to_ends = edges[other] - start[:, None]
    off = np.abs(to_ends[..., 0] * way[:, None, 1] - to_ends[..., 1] * way[:, None, 0]).max(axis=1)
    foot = np.sort(np.einsum("nij,nj->ni", to_ends, way), axis=1)
    shared = np.clip(foot[:, 1], 0.0, length) - np.clip(foot[:, 0], 0.0, length)
    shared[off > 2 * same * size] = 0.0
    whole = np.hypot(*(edges[:, 1] - edges[:, 0]).T)
    total = np.bincount(mine, weights=shared, minlength=len(edges))
    return np.asarray(total > whole - 4 * same * size)
