"""Forces of contacts on faces of cracks, spread over the parts of edges that they stand for."""

import numpy as np

from integration.arrays import Floats, Ints
from integration.plane_vectors import clockwise
from nmm.assembly.applied_forces import AppliedForces
from nmm.assembly.model import Model
from nmm.contact.points.contact_points import ContactPoints


def on_faces(model: Model, contacts: ContactPoints) -> AppliedForces:
    """Return the forces that contacts left on either face of each crack."""
    n, p = contacts.normal, contacts
    force = p.normal_force[:, None] * n + p.shear_force[:, None] * clockwise(n)
    edge, parameter = (np.concatenate(both) for both in zip(*p.sides, strict=True))
    force, length = np.concatenate([-force, force]), np.tile(p.length, 2)
    kept = np.flatnonzero((model.cut.boundary.crack[edge] >= 0) & force.any(axis=1))
    edge = edge[kept]
    edges = model.cut.boundary
    start, along = edges.start[edge], edges.end[edge] - edges.start[edge]
    low, high = _shares(edge, parameter[kept], length[kept] / np.hypot(*along.T))
    begin, end = (start + share[:, None] * along for share in (low, high))
    return AppliedForces(edges.element[edge], begin, end, force[kept])


def _shares(edge: Ints, parameter: Floats, length: Floats) -> tuple[Floats, Floats]:
    """Begin and end (m,) of what points of edges stand for: half way to the next ones.

    All in shares of the edge; no further than their own length to either side.
    """
    order = np.lexsort((parameter, edge))
    at, s = edge[order], parameter[order]
    middle, same = (s[1:] + s[:-1]) / 2, at[1:] == at[:-1]
    low, high = np.zeros_like(s), np.ones_like(s)
    low[order[1:][same]] = high[order[:-1][same]] = middle[same]
    return np.maximum(low, parameter - length), np.minimum(high, parameter + length)
