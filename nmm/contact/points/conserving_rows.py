"""Contact rows of a step whose forces do the work that gaps say, and make no moment.

The gap of a point before an edge is ``g = A / L``, with the vectors ``t`` along the edge, or along
the line between the faces of a joint (`between_faces`), and ``r`` from it to the point,
``A = r x t`` and ``L^2 = t . t``. Both are of second degree in places and stay as they are in a
rigid motion, so that their slopes half way between two states give their change exactly and make
neither force nor moment in sum. So does what is put together of them,

    D g = (1/L0 + 1/L1) / 2  D A  -  (A0 + A1) / (2 L0 L1 (L0 + L1))  D L^2,

whose product with the step is ``g1 - g0`` however far bodies turn and stretch in it: a spring along
it gives what it has stored (Simo and Tarnow 1992; Laursen and Chawla 1997; Gonzalez 2000). The same
holds of the place ``r . t / L^2`` along the edge, whose change is slip, and of ``r . t / L``, which
is the slip of a joint.
"""

from collections.abc import Callable

import numpy as np
from scipy.sparse import csr_array

from covers.approximation.rows import Rows, row_matrix
from integration.arrays import Bools, Floats
from integration.plane_vectors import clockwise, cross, dot
from nmm.assembly.material_points import MaterialPoints
from nmm.assembly.state import State
from nmm.contact.points.bent_faces import Line, face_lines
from nmm.contact.points.between_faces import EdgeShares, across
from nmm.contact.points.boundary_points import Sides
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.contact_rows import ContactRows
from nmm.contact.points.joint_points import JointSites, padded

Pair = tuple[Floats, Floats]
"""What vectors are at the start and at the end of a step, or slopes by ``t`` and by ``r``."""


def conserving_rows(
    contacts: ContactPoints,
    sides: Sides,
    states: tuple[State, State],
    sites: JointSites | None = None,
) -> ContactRows:
    """Return the rows of contacts between two states of bodies whose axes do not turn.

    Contacts act on chords, or at all their ``sites``: there ``t`` is along the face as it bends.
    """
    joint, edges = contacts.is_joint, (contacts.edge_a, contacts.edge_b)
    point = sides.at(contacts.edge_a, contacts.parameter_a)
    foot = sides.at(contacts.edge_b, np.where(joint, contacts.parameter_b, 0.0))
    vectors = [(sides.end.take(edge), sides.start.take(edge)) for edge in edges]
    if sites is not None:
        point, foot = sites.a, sites.b
        bent = face_lines(sides, contacts.edge_b, contacts.parameter_b)
        vectors[1] = _but_for(joint, vectors[1], bent)
    shares = EdgeShares.of(contacts, sides.length)
    along_a, along_b = (between(*vector, states) for vector in vectors)
    along = _each(lambda a, b: shares.a * a + shares.b * b, along_a, along_b)
    apart = between(point, foot, states)
    count, found = len(states[0].deformation), []
    for by_along, by_apart in slopes(along, apart, joint[:, None]):
        by = shares.a * by_along, shares.b * by_along, by_apart
        found.append(_rows(by, (*vectors, (point, foot)), count))
    return ContactRows(found[0], found[1], across(mean(along)))


def _but_for(chosen: Bools, chord: Line, bent: Line) -> Line:
    """Return the lines of faces that bend, and the chords of those that are chosen (m,)."""
    if not chosen.any():
        return bent
    if chosen.all():
        return chord
    one, other = (_of_both(chosen, *pair) for pair in zip(chord, bent, strict=True))
    return one, other


def _of_both(chosen: Bools, one: MaterialPoints, other: MaterialPoints) -> MaterialPoints:
    """Return points of ``one`` where they are chosen (m,), else of the other."""
    width = max(part.rows.unknowns.shape[1] for part in (one, other))
    rows = [
        (padded(part.rows.unknowns, width), padded(part.rows.values, width))
        for part in (one, other)
    ]
    unknowns, values = (
        np.where(chosen.reshape(-1, *[1] * (a.ndim - 1)), a, b) for a, b in zip(*rows, strict=True)
    )
    arm = np.where(chosen[:, None], one.arm, other.arm)
    return MaterialPoints(one.body, arm, Rows(unknowns, values))


def slopes(along: Pair, apart: Pair, joint: Bools) -> tuple[Pair, Pair]:
    """Discrete slopes of gap and slip by the vectors along the edge and from it to the point."""
    half, way = mean(along), mean(apart)
    one, other = (_norm(t) for t in along)
    inverse, over = (1 / one + 1 / other) / 2, one * other * (one + other)
    stretched = mean(_each(cross, apart, along))[:, None] / over
    gap = -inverse * clockwise(way) - 2 * stretched * half, inverse * clockwise(half)
    # A joint slips as it opens; along an edge that stretches, places stretch.
    length, place = (one + other) / 2, mean(_each(dot, apart, along))[:, None]
    inverse = np.where(joint, inverse, length * (one**-2 + other**-2) / 2)
    stretched = np.where(joint, place / over, length * place / (one * other) ** 2)
    slip = -inverse * way + 2 * stretched * half, -inverse * half
    return gap, slip


def _rows(
    slopes: tuple[Floats, ...], vectors: tuple[tuple[MaterialPoints, ...], ...], count: int
) -> csr_array:
    """Rows (m, n) of slopes by vectors, each from its second point to its first."""
    parts = [
        (point.rows.unknowns, sign * point.rows.along(slope))
        for slope, ends in zip(slopes, vectors, strict=True)
        for sign, point in zip((1.0, -1.0), ends, strict=True)
    ]
    columns, values = (np.hstack(one) for one in zip(*parts, strict=True))
    return row_matrix(columns, values, count, merged=True)


def between(head: MaterialPoints, tail: MaterialPoints, states: tuple[State, State]) -> Pair:
    """Vectors (m, 2) from one point to another at both states."""
    first, last = (
        head.place(state.frames, state.deformation) - tail.place(state.frames, state.deformation)
        for state in states
    )
    return first, last


def mean(ends: Pair) -> Floats:
    """Return the mean of both ends."""
    return np.asarray((ends[0] + ends[1]) / 2)


def _each(product: Callable[[Floats, Floats], Floats], one: Pair, other: Pair) -> Pair:
    """What two vectors at both ends give."""
    return product(one[0], other[0]), product(one[1], other[1])


def _norm(vector: Floats) -> Floats:
    return np.asarray(np.hypot(*vector.T))[:, None]
