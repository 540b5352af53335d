"""Contact rows of a step whose forces do the work that gaps say, and make no moment.

The gap of a point before an edge is ``g = A / L``, with the vectors ``t`` along the edge and ``r``
from it to the point, ``A = r x t`` and ``L^2 = t . t``. Both are of second degree in places and
stay as they are in a rigid motion, so that their slopes half way between two states give their
change exactly and make neither force nor moment in sum. So does what is put together of them,

    D g = (1/L0 + 1/L1) / 2  D A  -  (A0 + A1) / (2 L0 L1 (L0 + L1))  D L^2,

whose product with the step is ``g1 - g0`` however far bodies turn and stretch in it: a spring along
it gives what it has stored (Simo and Tarnow 1992; Laursen and Chawla 1997; Gonzalez 2000). The same
holds of the place ``r . t / L^2`` along the edge, whose change is slip.
"""

from collections.abc import Callable

import numpy as np
from scipy.sparse import csr_array

from integration.arrays import Floats
from nmm.assembly.motion import MaterialPoints, State
from nmm.contact.points.boundary_points import Sides, tangents
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.joint_points import JointSites
from nmm.contact.points.midpoint import ContactRows

Pair = tuple[Floats, Floats]
"""What vectors are at the start and at the end of a step, or slopes by ``t`` and by ``r``."""


def conserving_rows(
    contacts: ContactPoints,
    sides: Sides,
    states: tuple[State, State],
    stations: JointSites | None = None,
) -> ContactRows:
    """Return the rows of contacts between two states of bodies whose axes do not turn.

    Contacts act on chords, or at all their ``stations``.
    """
    edge = contacts.edge_b
    first, last = sides.start.take(edge), sides.end.take(edge)
    point, foot = sides.at(contacts.edge_a, contacts.parameter_a), first
    if stations is not None:
        point, foot = stations.a, stations.b
    along, apart = _between(last, first, states), _between(point, foot, states)
    count = len(states[0].deformation)
    found = [
        _rows(slopes, ((last, first), (point, foot)), count) for slopes in _slopes(along, apart)
    ]
    middle = _mean(along)
    return ContactRows(found[0], found[1], tangents(middle / _norm(middle)))


def _slopes(along: Pair, apart: Pair) -> tuple[Pair, Pair]:
    """Discrete slopes of gap and slip by the vectors along the edge and from it to the point."""
    half, way = _mean(along), _mean(apart)
    one, other = (_norm(t) for t in along)
    mean = (1 / one + 1 / other) / 2
    stretched = _mean(_each(_cross, apart, along)) / (one * other * (one + other))
    gap = -mean * tangents(way) - 2 * stretched * half, mean * tangents(half)
    mean = (one**-2 + other**-2) / 2
    stretched = _mean(_each(_dot, apart, along)) / (one * other) ** 2
    length = (one + other) / 2
    slip = -length * (mean * way - 2 * stretched * half), -length * mean * half
    return gap, slip


def _rows(slopes: Pair, vectors: tuple[tuple[MaterialPoints, ...], ...], count: int) -> csr_array:
    """Rows (m, n) of slopes by vectors, each from its second point to its first."""
    parts = [
        (point.rows.unknowns, sign * point.rows.along(slope))
        for slope, ends in zip(slopes, vectors, strict=True)
        for sign, point in zip((1.0, -1.0), ends, strict=True)
    ]
    columns, values = (np.hstack(one) for one in zip(*parts, strict=True))
    offsets = np.arange(len(columns) + 1) * columns.shape[1]
    found = csr_array((values.ravel(), columns.ravel(), offsets), shape=(len(columns), count))
    found.sum_duplicates()
    return found


def _between(head: MaterialPoints, tail: MaterialPoints, states: tuple[State, State]) -> Pair:
    """Vectors (m, 2) from one point to another at both states."""
    first, last = (
        head.place(state.frames, state.deformation) - tail.place(state.frames, state.deformation)
        for state in states
    )
    return first, last


def _mean(ends: Pair) -> Floats:
    return np.asarray((ends[0] + ends[1]) / 2)


def _each(product: Callable[[Floats, Floats], Floats], one: Pair, other: Pair) -> Pair:
    """Products (m, 1) of two vectors at both ends."""
    return product(one[0], other[0])[:, None], product(one[1], other[1])[:, None]


def _dot(one: Floats, other: Floats) -> Floats:
    return np.asarray(np.einsum("ij,ij->i", one, other))


def _cross(one: Floats, other: Floats) -> Floats:
    return np.asarray(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0])


def _norm(vector: Floats) -> Floats:
    return np.asarray(np.hypot(*vector.T))[:, None]
