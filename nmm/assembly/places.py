"""Points of the material at the places that a scene names: a point, a segment, a block."""

from dataclasses import dataclass

import numpy as np
import shapely

from covers.approximation.manifold import Manifold
from covers.approximation.sides import sides_at
from integration.arrays import Bools, Floats, Ints
from integration.plane_vectors import clockwise
from integration.segments import segment_rule
from nmm.assembly.material_points import MaterialPoints, material_points

# A place is found when it is this close, in sizes of the whole domain: 1e-9 is far above the
# rounding of coordinates read from text and far below any block.
NEAR = 1e-9


@dataclass(frozen=True)
class Place:
    """Points of the material, and the weight of each.

    Attributes
    ----------
    points
        m points that move with the material.
    elements
        (m,) the elements they lie in.
    weight
        (m,) 1 / number of points for a point; length (m) for a segment.
    position
        (m, 2) where they lie in the reference place.
    normal
        (m, 2) outward normals of the boundary in the reference place; None at a point.
    piece
        (m,) the piece of boundary each lies on, counted from zero; None at a point.
    edge
        (m,) the edge of the boundary that holds it; None where it was not kept.
    part
        (m, 2, 2) start and end of the part of its edge that its weight stands for; None as above.
    """

    points: MaterialPoints
    elements: Ints
    weight: Floats
    position: Floats
    normal: Floats | None = None
    piece: Ints | None = None
    edge: Ints | None = None
    part: Floats | None = None

    def __len__(self) -> int:
        return len(self.weight)

    @property
    def piece_lengths(self) -> Floats:
        """Lengths of the pieces of boundary (m)."""
        assert self.piece is not None
        return np.asarray(np.bincount(self.piece, self.weight), dtype=float)


def at_point(manifold: Manifold, point: Floats, regions: Bools | None = None) -> Place:
    """Return the material at a point: one element for each body that touches it, in equal shares.

    On a crack each of its faces has a share.

    Parameters
    ----------
    point
        (2,) m.
    regions
        (N,) which input regions count; None is all.
    """
    polygons = manifold.elements.to_shapely()
    near = NEAR * manifold.elements.extent
    found = np.flatnonzero(shapely.dwithin(polygons, shapely.points(point), near))
    if regions is not None:
        found = found[regions[manifold.element_region[found]]]
    elements = sides_at(manifold, found, point) if len(found) > 1 else found
    points = np.tile(point, (len(elements), 1))
    weight = np.full(len(elements), 1 / max(len(elements), 1))
    return Place(material_points(manifold, elements, points), elements, weight, points)


def on_segment(
    manifold: Manifold, segment: Floats, regions: Bools | None = None, order: int = 4
) -> Place:
    """Return Gauss points on the parts of the bodies' edges that lie on a segment (2, 2).

    ``order`` is the degree of the polynomials that the points integrate exactly; ``regions`` (N,)
    says which input regions count, None is all.
    """
    return on_parts(manifold, *along_segment(manifold, segment, regions), order)


def along_segment(
    manifold: Manifold, segment: Floats, regions: Bools | None = None
) -> tuple[Ints, Floats, Floats]:
    """Return boundary edges on a segment (2, 2), and starts and ends (k, 2) of their parts."""
    edges = manifold.boundary
    a, b = segment
    length = float(np.hypot(*(b - a)))
    t = (b - a) / (length or 1.0)  # no edge lies on a segment without length
    n = np.array([-t[1], t[0]])
    near = NEAR * manifold.elements.extent
    on_line = (np.abs((edges.start - a) @ n) < near) & (np.abs((edges.end - a) @ n) < near)
    ends = np.sort(np.stack([(edges.start - a) @ t, (edges.end - a) @ t], axis=1), axis=1)
    low, high = np.maximum(ends[:, 0], 0), np.minimum(ends[:, 1], length)
    touching = on_line & (high - low > near)
    if regions is not None:
        touching &= regions[manifold.element_region[edges.element]]
    index = np.flatnonzero(touching)
    start, end = a + low[index, None] * t, a + high[index, None] * t
    return index, start, end


def on_block(manifold: Manifold, regions: Bools, order: int = 4) -> Place:
    """Return Gauss points on all boundary edges of the chosen regions."""
    edges = manifold.boundary
    return on_edges(manifold, regions[manifold.element_region[edges.element]], order)


def on_edges(manifold: Manifold, chosen: Bools, order: int = 4) -> Place:
    """Return Gauss points on chosen edges (n,) of the boundary."""
    edges, index = manifold.boundary, np.flatnonzero(chosen)
    return on_parts(manifold, index, edges.start[index], edges.end[index], order)


def on_parts(manifold: Manifold, edge: Ints, start: Floats, end: Floats, order: int) -> Place:
    """Return Gauss points on parts of boundary edges, from ``start`` to ``end`` (k, 2) of each."""
    edges = manifold.boundary
    points, weight = segment_rule(start, end, order)
    q = weight.shape[1]
    elements = np.repeat(edges.element[edge], q)
    along = edges.end[edge] - edges.start[edge]
    normal = clockwise(along) / np.hypot(*along.T)[:, None]
    flat = points.reshape(-1, 2)
    return Place(
        material_points(manifold, elements, flat),
        elements,
        weight.ravel(),
        flat,
        np.repeat(normal, q, axis=0),
        np.repeat(np.arange(len(edge)), q),
        np.repeat(edge, q),
        _parts(start, end, weight),
    )


def _parts(start: Floats, end: Floats, weight: Floats) -> Floats:
    """Parts (k q, 2, 2) of segments (k, 2), in the ratios of the weights (k, q) of their points."""
    last = np.cumsum(weight, axis=1)
    share = np.stack([last - weight, last], axis=-1) / last[:, -1:, None]
    parts = start[:, None, None] + share[..., None] * (end - start)[:, None, None]
    return np.asarray(parts.reshape(-1, 2, 2))
