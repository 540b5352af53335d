"""Normals of faces that bend, where contacts act on the material: across the face, not the chord.

What slides along a face rides up and down with it. A force across the chord between the ends of
an edge would do work there that no spring stores, in proportion to the way and however short steps
are.
"""

import numpy as np

from integration.arrays import Floats
from integration.contraction import contract
from nmm.assembly.motion import State
from nmm.contact.points.boundary_points import Sides
from nmm.contact.points.contact_points import ContactPoints


def bent_normals(sides: Sides, points: ContactPoints, state: State) -> Floats:
    """Return the normals (m, 2) of points, turned by as much as side b is bent from its chord."""
    boundary, edge = sides.manifold.boundary, points.edge_b
    place = boundary.at(edge, points.parameter_b)
    index, rows = sides.manifold.gradient_rows(boundary.element[edge], place)
    along = boundary.end[edge] - boundary.start[edge]
    stretch = contract("mcjl,mj,ml->mc", rows, along, state.deformation[index])
    tilt, body = state.frames.tilt, sides.start.body[edge]
    chord = sides.turns(edge)
    unknowns = sides.start.rows.unknowns[edge]
    mean = contract("mcl,ml->mc", chord, state.deformation[unknowns])
    if tilt is not None:
        across = tilt[body, None] * np.stack([-along[:, 1], along[:, 0]], axis=1)
        stretch, mean = stretch + across, mean + across
    return turned(points.normal, along + mean, along + stretch)


def turned(vectors: Floats, start: Floats, end: Floats) -> Floats:
    """Turn vectors (m, 2) by the angles from ``start`` to ``end`` (m, 2)."""
    cos = (start * end).sum(axis=1)
    sin = start[:, 0] * end[:, 1] - start[:, 1] * end[:, 0]
    c, s = np.stack([cos, sin]) / np.hypot(cos, sin)
    x, y = vectors.T
    return np.stack([c * x - s * y, s * x + c * y], axis=1)
