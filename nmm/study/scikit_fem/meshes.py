"""Meshes of triangles that fit a polygon and its cracks, for the finite elements of a yardstick."""

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import shapely
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from integration.arrays import Bools, Floats, Ints
from nmm.errors import NmmError

if TYPE_CHECKING:
    from skfem import MeshTri

# Degrees; Triangle ends for angles up to about 33.
LEAST_ANGLE = 30
# Number of the edges of cracks; 0 and 1 are Triangle's own.
CRACKED = 3


@dataclass(frozen=True)
class Outline:
    """What a mesh has to fit: nodes (n, 2) on outline and cracks, and edges (m, 2) between them.

    ``cracked`` (m,) says which edges lie on cracks.
    """

    nodes: Floats
    edges: Ints
    cracked: Bools


def fitted_mesh(polygon: Any, cracks: Sequence[Floats], marks: Floats, size: float) -> "MeshTri":
    """Return triangles of about a size that fit a polygon.

    They are Shewchuk's (1996): Delaunay triangles without angles below 30 degrees or areas above
    that of equal-sided ones, so that they grow away from short edges and corners. Nodes on a crack
    are doubled, so that its faces part.

    Parameters
    ----------
    polygon
        Of shapely; it may have holes.
    cracks
        Polylines (k, 2); they may end inside.
    marks
        (q, 2) points that become nodes where they lie on the outline.
    size
        Length of edges (m).

    Raises
    ------
    NmmError
        When the package that makes them is not installed.
    """
    return _triangulated(polygon, _outline(polygon, cracks, marks, size), size)


def _outline(polygon: Any, cracks: Sequence[Floats], marks: Floats, size: float) -> Outline:
    """Divide rings and cracks into edges no longer than the size, with nodes at the marks."""
    rings = [np.asarray(one.coords) for one in (polygon.exterior, *polygon.interiors)]
    nodes, cracked = [], []
    for line in [*rings, *cracks]:
        inside = any(line is one for one in cracks)
        for start, end in itertools.pairwise(line):
            points = _divided(start, end, np.concatenate([marks, *cracks]), size)
            nodes.append(np.stack([points[:-1], points[1:]], axis=1))
            cracked.append(np.full(len(points) - 1, inside))
    ends = np.concatenate(nodes)
    unit = 1e-10 * max(np.ptp(ends[..., 0]), np.ptp(ends[..., 1]))
    _, first, index = np.unique(
        np.round(ends.reshape(-1, 2) / unit), axis=0, return_index=True, return_inverse=True
    )
    return Outline(
        ends.reshape(-1, 2)[first], index.reshape(-1, 2).astype(np.int64), np.concatenate(cracked)
    )


def _divided(start: Floats, end: Floats, marks: Floats, size: float) -> Floats:
    """Points from start to end, at the marks between them and no further apart than the size."""
    way = end - start
    length = float(np.hypot(*way))
    along = (marks - start) @ way / length**2
    off = np.hypot(*(marks - start - along[:, None] * way).T)
    between = (off < 1e-9 * length) & (along > 1e-9) & (along < 1 - 1e-9)
    stops = np.unique(np.round(np.concatenate([[0, 1], along[between]]), 12))
    parts = [
        np.linspace(a, b, int(np.ceil((b - a) * length / size - 1e-6)), endpoint=False)
        for a, b in itertools.pairwise(stops)
    ]
    return np.asarray(start + np.append(np.concatenate(parts), 1.0)[:, None] * way)


def _triangulated(polygon: Any, outline: Outline, size: float) -> "MeshTri":
    """Divide the inside; the outline keeps its edges, or halves of them."""
    try:
        import triangle
    except ImportError as fault:
        raise NmmError(
            'cover "skfem": the meshes of the yardstick are made by the package triangle, which is '
            "not installed: expected it: pip install triangle"
        ) from fault
    given: dict[str, Any] = {
        "vertices": outline.nodes,
        "segments": outline.edges,
        "segment_markers": np.where(outline.cracked, CRACKED, CRACKED - 1)[:, None],
    }
    if polygon.interiors:
        inside = [shapely.Polygon(ring).representative_point() for ring in polygon.interiors]
        given["holes"] = shapely.get_coordinates(inside)
    # A planar graph, of angles and areas: p, q, a.
    options = f"pq{LEAST_ANGLE}a{np.sqrt(3) / 4 * size**2:.17f}"
    made = triangle.triangulate(given, options)
    cracked = made["segments"][made["segment_markers"].ravel() == CRACKED]
    return _opened(made["vertices"], made["triangles"].astype(np.int64), cracked.astype(np.int64))


def _opened(nodes: Floats, triangles: Ints, crack: Ints) -> "MeshTri":
    """Give triangles that hang together about a node only through a crack a node each."""
    from skfem import MeshTri

    count = len(nodes)
    corner = np.arange(triangles.size).reshape(triangles.shape)
    ends = np.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)])
    corners = np.concatenate([corner[:, [i, (i + 1) % 3]] for i in range(3)])
    turned = ends[:, 0] > ends[:, 1]
    ends[turned], corners[turned] = ends[turned, ::-1], corners[turned, ::-1]
    key = ends[:, 0] * count + ends[:, 1]
    order = np.argsort(key, kind="stable")
    shared = np.flatnonzero(key[order][1:] == key[order][:-1])
    lying = np.sort(crack, axis=1)
    shared = shared[~np.isin(key[order][shared], lying[:, 0] * count + lying[:, 1])]
    first, second = corners[order[shared]], corners[order[shared + 1]]
    pairs = np.concatenate([np.stack([first[:, i], second[:, i]], 1) for i in (0, 1)])
    joined = coo_array((np.ones(len(pairs)), tuple(pairs.T)), shape=(triangles.size,) * 2)
    groups, group = connected_components(joined, directed=False)
    place = np.zeros(groups, dtype=np.int64)
    place[group] = triangles.ravel()
    return MeshTri(
        np.ascontiguousarray(nodes[place].T),
        np.ascontiguousarray(group.reshape(triangles.shape).T.astype(np.int64)),
    )
