"""Lines along faces that bend, where contacts act on the material: along the face, not its chord.

What slides along a face rides up and down with it. A force across the chord between the ends of
an edge would do work there that no spring stores, in proportion to the way and however short steps
are.
"""

import numpy as np

from covers.approximation.rows import Rows
from integration.arrays import Floats, Ints
from integration.contraction import contract
from integration.plane_vectors import cross
from nmm.assembly.material_points import MaterialPoints
from nmm.assembly.state import State
from nmm.contact.points.boundary_points import Sides
from nmm.contact.points.contact_points import ContactPoints

Line = tuple[MaterialPoints, MaterialPoints]
"""Head and tail of vectors that move with the material."""


def face_lines(sides: Sides, edge: Ints, parameter: Floats) -> Line:
    """Return the lines (m,) along faces at points of edges; as long as their edges where drawn."""
    boundary = sides.manifold.boundary
    place, body = boundary.at(edge, parameter), sides.start.body[edge]
    along = boundary.end[edge] - boundary.start[edge]
    unknowns, slopes = sides.manifold.gradient_rows(boundary.element[edge], place)
    values = contract("mcjl,mj->mcl", slopes, along)
    head = MaterialPoints(body, along, Rows(unknowns, values))
    tail = MaterialPoints(body, np.zeros_like(along), Rows(unknowns, np.zeros_like(values)))
    return head, tail


def bent_normals(sides: Sides, points: ContactPoints, state: State) -> Floats:
    """Return the normals (m, 2) of points, turned by as much as side b is bent from its chord.

    Inside a segment of two faces by the mean of both sides': neither is the first. At the tip of
    a crack strain has no bound and no direction: where it would turn them by more than 45 degrees
    they stay across the chord.
    """
    normal = _bent(sides, points.normal, (points.edge_b, points.parameter_b), state)
    (inside,) = (points.parameter_a > 0).nonzero()
    if len(inside):
        at = points.edge_a[inside], points.parameter_a[inside]
        mean = normal[inside] + _bent(sides, points.normal[inside], at, state)
        normal[inside] = mean / np.hypot(*mean.T)[:, None]
    return normal


def _bent(sides: Sides, normal: Floats, side: tuple[Ints, Floats], state: State) -> Floats:
    """Normals (m, 2) turned by as much as faces are bent from their chords at points of edges."""
    place = state.frames, state.deformation
    lines = (sides.end.take(side[0]), sides.start.take(side[0])), face_lines(sides, *side)
    chord, line = (head.place(*place) - tail.place(*place) for head, tail in lines)
    return turned(normal, chord, line)


def turned(vectors: Floats, start: Floats, end: Floats) -> Floats:
    """Turn vectors (m, 2) by the angles from ``start`` to ``end`` (m, 2), up to 45 degrees."""
    cos = (start * end).sum(axis=1)
    sin = cross(start, end)
    known = np.abs(sin) < cos
    cos, sin = np.where(known, cos, 1.0), np.where(known, sin, 0.0)
    c, s = np.stack([cos, sin]) / np.hypot(cos, sin)
    x, y = vectors.T
    return np.stack([c * x - s * y, s * x + c * y], axis=1)
