"""Pairs of elements that share an edge off the boundary."""

import numpy as np

from covers.cutting.boundary import BoundaryEdges
from integration.arrays import Ints
from integration.polygons import Polygons


def shared_edges(elements: Polygons, body: Ints, boundary: BoundaryEdges) -> tuple[Ints, Ints]:
    """Return the two elements (p,) of each edge inside a body, the lower number first.

    Shared vertices of the elements of a cut have identical coordinates.
    """
    points, owner = elements.points, elements.polygon_of_point
    every = np.concatenate([points, boundary.start, boundary.end]) + 0.0
    _, vertex = np.unique(every[:, 0] + 1j * every[:, 1], return_inverse=True)
    n, m = len(points), len(boundary)
    start, end = vertex[:n], vertex[:n][elements.next_point]
    size = int(vertex.max(initial=0)) + 1
    forward, backward = start * size + end, end * size + start
    order = np.argsort(forward)
    place = np.minimum(np.searchsorted(forward[order], backward), max(n - 1, 0))
    other = order[place]
    parted = np.isin(forward, vertex[n : n + m] * size + vertex[n + m :])
    first, second = owner, owner[other]
    kept = (forward[other] == backward) & ~parted & (first < second)
    kept &= body[first] == body[second]
    return first[kept], second[kept]
