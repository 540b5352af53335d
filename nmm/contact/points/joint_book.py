"""Joints that are followed: their contact points keep their place until they come apart."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from integration.arrays import Bools, Floats, Ints
from integration.contraction import contract
from integration.plane_vectors import clockwise
from nmm.contact.detection.contacts import FACE, Contacts
from nmm.contact.detection.surface import Surface, unordered_key
from nmm.contact.detection.tolerances import JOINT_LEFT, WHOLLY_HELD
from nmm.contact.points.between_faces import JointFaces
from nmm.contact.points.contact_points import TIED, ContactPoints, concatenate
from nmm.contact.problem.step_problem import BROKEN


@dataclass(frozen=True)
class JointBook:
    """Joints that are still followed.

    Attributes
    ----------
    points
        Their contact points, keys -1, -2, ...
    joint
        (m,) joint of each point.
    pairs
        (k,) keys of the vertex-edge pairs at the ends of whole joints, which the search reports
        too. Where a part has come apart the rest lets bodies turn about it, until corners meet.
    pair_joint
        (k,) joint of each such pair.
    pair_kink
        (k,) whether it is of a corner and the other edge of a kink that the joint ends in, which
        bounds the corner's way unless bonds hold it.
    pair_beyond
        (k,) whether consistent terms hold the joint at points within it: its ends lie beyond them,
        and bear as soon as one of its bonds gives way where it opens. On its points alone it would
        turn over before. Where all points are pressed they carry the whole of the pressure.
    pair_bears
        (k,) whether it does.
    lost
        Points of joints that came apart; the search finds what touches there.
    left
        Those of them that the last step gave up, as it left them: what the search finds between
        their bodies is pressed as they were.
    """

    points: ContactPoints
    joint: Ints
    pairs: Ints
    pair_joint: Ints
    pair_kink: Bools
    pair_beyond: Bools
    pair_bears: Bools
    lost: ContactPoints
    left: ContactPoints

    def only(self, chosen: Bools) -> "JointBook":
        """Return the book with some of its points (m,)."""
        return replace(self, points=self.points.take(chosen), joint=self.joint[chosen])

    def hides(self, found: Contacts, n: int) -> Bools:
        """Which contacts found among ``n`` edges followed joints carry already.

        They are those at the ends of joints, but for ends that bear and the other edges of kinks
        beside joints that do not hold, and those of corners that bonds hold on both sides: what
        such a corner may enter only beside its neighbours, as a kink, it does not.
        """
        if not len(self.pairs):
            return np.zeros(len(found), dtype=bool)
        whole = ~np.isin(self.pair_joint, self.joint[~self.points.bonded])
        carried = self.pairs[(whole | ~self.pair_kink) & ~self.pair_bears]
        corner, hidden = found.kind != FACE, np.isin(found.key, carried)
        between = self._between_joints(whole & ~self.pair_bears, n)
        hidden[corner] |= between[found.vertex[corner]]
        return hidden

    def _between_joints(self, chosen: Bools, n: int) -> Bools:
        """Which of ``n`` corners have chosen pairs (k,) of two joints or more.

        Where both faces of a joint are one edge long a corner has two pairs of that joint alone.
        """
        sides = np.unique(self.pair_joint[chosen] * n + self.pairs[chosen] // n)
        return np.bincount(sides % n, minlength=n) > 1

    def opened_at(self, points: Ints) -> "JointBook":
        """Return the book with ends that bear where bonds of these keys gave way as they opened."""
        waiting = self.pair_beyond & ~self.pair_bears
        if not len(points) or not waiting.any():
            return self
        now = waiting & np.isin(self.pair_joint, self.joint[np.isin(self.points.key, points)])
        return replace(self, pair_bears=self.pair_bears | now)

    @property
    def opened(self) -> "JointBook":
        """The book with every end that would bear once bonds give way."""
        return replace(self, pair_bears=self.pair_beyond)

    def without(self, contacts: ContactPoints) -> "JointBook":
        """Return the book without the bonds and the terms that are gone among the contacts."""
        points = self.points
        still = points.bonded & ~self._among(contacts, ~contacts.bonded)
        history = {**points.history, "bonded": still}
        if TIED in history:
            history[TIED] = np.where(self._among(contacts, ~contacts.tied), 0.0, history[TIED])
        return replace(self, points=replace(points, history=history))

    def _among(self, contacts: ContactPoints, chosen: Bools) -> Bools:
        """Which points (m,) are among the chosen contacts (k,) of a step."""
        return np.isin(self.points.key, contacts.key[contacts.is_joint & chosen])

    def edges(self, n: int) -> Ints:
        """Pairs of edges that followed joints carry, ``a * n + b`` with ``a < b``, sorted."""
        return np.unique(unordered_key(self.points.edge_a, self.points.edge_b, n))

    def carried(self, surface: Surface, length: Floats) -> Ints:
        """Pairs of edges as in `edges` on which nothing presses but joints.

        An edge that joints hold along its whole ``length`` (n,), as bodies were laid (m), slides on
        to the next one of a face with all of it held: what lies over there is in the joint.
        """
        n, points = len(surface), self.points
        both = np.concatenate([points.edge_a, points.edge_b])
        facing = np.concatenate([points.edge_b, points.edge_a])
        share = np.bincount(both, np.tile(points.length, 2), n) / length
        whole = share[both] > WHOLLY_HELD
        both, facing = both[whole], facing[whole]
        slid = [unordered_key(both, way[facing], n) for way in (surface.next, surface.previous)]
        return np.unique(np.concatenate([self.edges(n), *slid]))

    def holds(self, surface: Surface, vertex: Ints, edge: Ints) -> Bools:
        """Which pairs (m,) are of an edge that ends at the vertex and one held to it by a joint."""
        n = len(surface)
        ends = vertex, surface.previous[vertex]
        beside = np.stack([unordered_key(own, edge, n) for own in ends])
        whole = self.only(np.isin(self.joint, self.pair_joint))
        return np.asarray(np.isin(beside, whole.edges(n)).any(axis=0))

    def now(self, faces: JointFaces) -> ContactPoints:
        """Return the points with gap, slip and normal of moved faces."""
        p = self.points
        if not len(p):
            return p
        normal, apart = faces.normal(p), faces.apart(p)
        stretch = contract("ij,ij->i", apart, clockwise(normal))
        return replace(
            p,
            normal=normal,
            gap=contract("ij,ij->i", apart, normal) - p.reference,
            slip=np.where(p.bonded, stretch - p.history["plastic_slip"], p.slip),
        )

    def keep(self, points: ContactPoints, faces: JointFaces) -> "JointBook":
        """Return the book with the answer's points; joints that came apart are given up.

        Faces that are pressed into one another, however far, lie on one another still.
        """
        if not len(points) and not len(self.lost):
            return self
        normal, apart = faces.normal(points), faces.apart(points)
        opened = np.maximum(contract("ij,ij->i", apart, normal), 0.0)
        far = np.hypot(opened, contract("ij,ij->i", apart, clockwise(normal)))
        lost = (far > JOINT_LEFT * points.length) & ~points.bonded
        parted = self.joint[lost]
        gone = np.isin(self.joint, parted) & ~points.bonded
        before = _turned(self.lost, faces)
        book = self.opened_at(standing_open(points))
        left = points.take(gone) if gone.any() or len(self.left) else self.left
        if not gone.any():
            return replace(book, points=points, lost=before, left=left)
        whole = ~np.isin(self.pair_joint, parted)
        return replace(
            book,
            points=points.take(~gone),
            joint=self.joint[~gone],
            pairs=self.pairs[whole],
            pair_joint=self.pair_joint[whole],
            pair_kink=self.pair_kink[whole],
            pair_beyond=self.pair_beyond[whole],
            pair_bears=book.pair_bears[whole],
            lost=concatenate([before, given_up(left)]),
            left=left,
        )

    @cached_property
    def broken(self) -> int:
        """Number of points whose bond is broken, lost ones included."""
        return int((~self.points.bonded).sum()) + len(self.lost)


def standing_open(points: ContactPoints) -> Ints:
    """Return the keys of points without a bond of consistent terms that nothing presses."""
    return not_pressed(points, ~points.tied, points.normal_force)


def not_pressed(points: ContactPoints, chosen: Bools, normal_force: Floats) -> Ints:
    """Return the keys of the chosen points (m,) that nothing presses under normal forces (m,)."""
    return points.key[chosen & (normal_force >= 0)]


def given_up(points: ContactPoints) -> ContactPoints:
    """Return points of joints that came apart, which carry nothing from now on."""
    zero = np.zeros(len(points))
    broken = np.full(len(points), int(BROKEN))
    return replace(points, state=broken, normal_force=zero, shear_force=zero)


def _turned(points: ContactPoints, faces: JointFaces) -> ContactPoints:
    """Return points with the normal and gap of moved faces."""
    normal, apart = faces.normal(points), faces.apart(points)
    return replace(points, normal=normal, gap=contract("ij,ij->i", apart, normal))
