"""Contact rows half way through a step, of bodies of any number of elements.

With the mean motion ``u``, ``r`` of a body, its rotation ``R0`` at the start and ``Rm`` half way,
``a = X + T q`` the place of a point in it half way and ``b`` by how much that changes in the step,
the point goes by exactly

    x1 - x0 = R0 u + r (s J Rm a - r s / 4 Rm b) + k Rm b,    k = cos(r / 2) + r^2 s / 4,

``s = sin(r / 2) / (r / 2)`` and ``J`` a quarter turn; as ``b = T d - u - r J X`` that is

    k Rm T d + (R0 - k Rm) u + r (s J Rm a - r s / 4 Rm b - k J Rm X).

Of the same terms in other orders, forces along this one have the moment on a body that they have
about its centre, both where they are in the mean of both ends, to the third power of ``r``. The
first is what rows of the points near a contact say; the others are those of `MeanMotion`. Gaps and
slips change with the ways as in `conserving_rows`: forces make no moment in sum, and do the work
that springs store.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
from scipy.sparse import csr_array

from covers.approximation.rows import row_matrix
from integration.arrays import Floats
from integration.contraction import contract
from integration.plane_vectors import cross
from nmm.assembly.material_points import MaterialPoints
from nmm.assembly.state import Frames, State
from nmm.contact.points.bent_faces import Line, face_lines
from nmm.contact.points.between_faces import EdgeShares, across
from nmm.contact.points.boundary_points import Sides
from nmm.contact.points.conserving_rows import between, mean, slopes
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.contact_rows import ContactRows
from nmm.contact.points.half_way.mean_motion import Forces, MeanMotion
from nmm.contact.points.joint_points import JointSites
from nmm.frozen import with_parts

Parts = Sequence[tuple[MaterialPoints, Floats]]
"""Points (m,) and the slopes (m, 2) of something by their places."""


def turning_rows(
    contacts: ContactPoints,
    sides: Sides,
    projection: csr_array,
    states: tuple[State, State],
    forces: Forces,
    bends: bool,
) -> ContactRows:
    """Return the rows of contacts, without joints, between a start and a place half way.

    Parameters
    ----------
    projection
        (3 B, n) mean motions of the bodies.
    states
        The start of the step, and half way.
    forces
        (m,) normal and shear, that the contacts were last known to have.
    bends
        Whether contacts act on faces as they bend, instead of on chords.
    """
    ends, turning = (states[0], beyond(*states)), _Turning.of(*states)
    point, foot, faces = _acting(contacts, sides, bends)
    # Between two faces neither side is the first.
    inside = (contacts.parameter_a > 0)[:, None]
    shares = EdgeShares.of(contacts, sides.length, inside)
    of_a, of_b = (between(head, tail, ends) for head, tail in faces)
    along = shares.a * of_a[0] + shares.b * of_b[0], shares.a * of_a[1] + shares.b * of_b[1]
    near, whole, moments = [], [], []
    for by_along, by_apart in slopes(along, between(point, foot, ends), inside):
        parts = [(point, by_apart), (foot, -by_apart)]
        for (head, tail), share in zip(faces, (shares.a, shares.b), strict=True):
            parts += [(head, share * by_along), (tail, -share * by_along)]
        near.append(turning.near(parts))
        whole.append(turning.whole(parts))
        moments.append(turning.moments(parts))
    mean_motion = MeanMotion(
        (whole[0], whole[1]),
        (moments[0], moments[1]),
        projection,
        turning.motion.ravel(),
        forces,
    )
    return ContactRows(near[0], near[1], across(mean(along)), mean_motion)


def _acting(
    contacts: ContactPoints, sides: Sides, bends: bool
) -> tuple[MaterialPoints, MaterialPoints, list[Line]]:
    """Where contacts act on both sides, and the lines along their faces."""
    if bends:
        sites = JointSites.at(sides, contacts)
        return sites.a, sites.b, [face_lines(sides, *side) for side in contacts.sides]
    point, foot = (sides.at(*side) for side in contacts.sides)
    edges = contacts.edge_a, contacts.edge_b
    return point, foot, [(sides.end.take(edge), sides.start.take(edge)) for edge in edges]


def beyond(start: State, half: State) -> State:
    """Return where a step ends whose ``half`` is known."""
    one, other = start.frames, half.frames
    frames = Frames(2 * other.centre - one.centre, 2 * other.angle - one.angle)
    return with_parts(start, frames=frames, deformation=2 * half.deformation - start.deformation)


@dataclass(frozen=True)
class _Turning:
    """Bodies that turn from a ``start`` through a place ``half`` way.

    Attributes
    ----------
    motion
        (B, 3) their mean motions.
    chord, bent
        (B,) ``s`` and ``k``.
    """

    start: State
    half: State
    motion: Floats
    chord: Floats
    bent: Floats

    @classmethod
    def of(cls, start: State, half: State) -> Self:
        """Return what is known of the bodies."""
        one, other = start.frames, half.frames
        way = one.to_body(np.arange(len(one.angle)), 2 * (other.centre - one.centre))
        turn = 2 * (other.angle - one.angle)
        chord = np.sinc(turn / (2 * np.pi))
        motion = np.column_stack([way, turn])
        return cls(start, half, motion, chord, np.cos(turn / 2) + turn**2 * chord / 4)

    def near(self, parts: Parts) -> csr_array:
        """Rows (m, n) by the unknowns that the points of slopes name."""
        frames, columns, values = self.half.frames, [], []
        for point, slope in parts:
            columns.append(point.rows.unknowns)
            values.append(point.along(frames, self.bent[point.body, None] * slope))
        n = len(self.start.deformation)
        return row_matrix(np.hstack(columns), np.hstack(values), n, merged=True)

    def whole(self, parts: Parts) -> csr_array:
        """Rows (m, 3 B) by the mean motions of bodies."""
        found = [self._of_mean(*part) for part in parts]
        bodies = np.hstack([point.body[:, None] for point, _ in parts])
        columns = 3 * bodies[:, :, None] + np.arange(3)
        values = np.stack(found, axis=1)
        m = len(bodies)
        return row_matrix(columns.reshape(m, -1), values.reshape(m, -1), self.motion.size, True)

    def _of_mean(self, point: MaterialPoints, slope: Floats) -> Floats:
        """Entries (m, 3) of points by the mean motions of their bodies."""
        body, turn = point.body, self.motion[point.body, 2]
        chord, bent = self.chord[body], self.bent[body]
        back, now = (state.frames.to_body(body, slope) for state in (self.start, self.half))
        half = point.rows.apply(self.half.deformation)
        grown = 2 * (half - point.rows.apply(self.start.deformation))
        arm = chord[:, None] * (point.arm + half) - bent[:, None] * point.arm
        turned = cross(arm, now)
        turned -= turn * chord / 4 * contract("ij,ij->i", grown, now)
        return np.column_stack([back - bent[:, None] * now, turned])

    def moments(self, parts: Parts) -> csr_array:
        """Rows (m, B) of the moments of slopes about the centres of bodies, where points are."""
        centre, found = self.half.frames.centre, []
        ends = self.start, beyond(self.start, self.half)
        for point, slope in parts:
            places = (point.place(state.frames, state.deformation) for state in ends)
            arm = sum(places) / 2 - centre[point.body]
            found.append(cross(arm, slope))
        bodies = np.column_stack([point.body for point, _ in parts])
        return row_matrix(bodies, np.column_stack(found), len(centre), merged=True)
