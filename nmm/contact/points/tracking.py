"""Contact points from step to step: joints keep their place, the others are found anew."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.contact.detection.face_contacts import FaceContacts
from nmm.contact.detection.joints import Joints, joint_ends, joint_points
from nmm.contact.detection.narrow_phase import Contacts, pair_key
from nmm.contact.detection.surface import Surface
from nmm.contact.points.boundary_points import tangents
from nmm.contact.points.contact_points import ContactPoints, concatenate
from nmm.contact.problem.step_problem import BONDED, BROKEN, OPEN, StepAnswer

# From points to where their sides a are from their sides b (m, 2).
Apart = Callable[[ContactPoints], Floats]

# What a contact that goes on keeps.
CARRIED = ("slip", "state", "normal_force", "shear_force", "worn")

# A broken joint whose faces have slid by this share of its length is left to the search.
SLID = 0.05


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
        (k,) keys of the vertex-edge pairs at the joints' ends, which the search reports too.
    pair_joint
        (k,) joint of each such pair.
    lost
        Points of joints that came apart; the search finds what touches there.
    """

    points: ContactPoints
    joint: Ints
    pairs: Ints
    pair_joint: Ints
    lost: ContactPoints

    def hides(self, found: Contacts) -> Bools:
        """Which found contacts a followed joint carries already."""
        if not len(self.joint):
            return np.zeros(len(found), dtype=bool)
        alive = np.isin(self.pair_joint, self.joint)
        return np.isin(found.key, self.pairs[alive])

    def edges(self, n: int) -> Ints:
        """Pairs of edges that followed joints carry, ``a * n + b`` with ``a < b``, sorted."""
        return np.unique(_edge_pair(self.points.edge_a, self.points.edge_b, n))

    def holds(self, surface: Surface, vertex: Ints, edge: Ints) -> Bools:
        """Which pairs (m,) are of an edge that ends at the vertex and one held to it by a joint."""
        n = len(surface)
        ends = vertex, surface.previous[vertex]
        beside = np.stack([_edge_pair(own, edge, n) for own in ends])
        return np.asarray(np.isin(beside, self.edges(n)).any(axis=0))

    def now(self, surface: Surface, apart_of: Apart) -> ContactPoints:
        """Return the points with gap, slip and normal of the moved surface."""
        p = self.points
        if not len(p):
            return p
        normal, apart = surface.normal[p.edge_b], apart_of(p)
        stretch = np.einsum("ij,ij->i", apart, tangents(normal))
        held = p.damage < 1
        return replace(
            p,
            normal=normal,
            gap=np.einsum("ij,ij->i", apart, normal),
            slip=np.where(held, stretch - p.slid, p.slip),
        )

    def keep(self, points: ContactPoints, surface: Surface, apart_of: Apart) -> "JointBook":
        """Return the book with the answer's points; joints that came apart are given up."""
        if not len(points) and not len(self.lost):
            return self
        apart = apart_of(points)
        far = np.hypot(apart[:, 0], apart[:, 1]) > SLID * points.length
        lost = far & (points.damage >= 1)
        gone = np.isin(self.joint, self.joint[lost]) & (points.damage >= 1)
        before = _turned(self.lost, surface, apart_of)
        if not gone.any():
            return replace(self, points=points, lost=before)
        zero = np.zeros(int(gone.sum()))
        apart_now = replace(
            points.take(gone),
            state=np.full(len(zero), int(BROKEN)),
            normal_force=zero,
            shear_force=zero,
        )
        return replace(
            self,
            points=points.take(~gone),
            joint=self.joint[~gone],
            lost=concatenate([before, apart_now]),
        )

    @property
    def broken(self) -> int:
        """Number of points whose bond is broken, lost ones included."""
        return int((self.points.damage >= 1).sum()) + len(self.lost)


def joint_book(
    surface: Surface,
    joints: Joints,
    interface: Ints,
    bonded: Bools,
    distance: Floats,
    stations: str,
) -> JointBook:
    """Follow joints.

    Parameters
    ----------
    surface, joints
        Where the edges are at the start, and the stretches they share.
    interface, bonded, distance
        (j,) index of the interface, whether it is bonded, and the distance (m) between the middles
        of the two elements across the joint, longer by as much as their materials are softer than
        the stiffest.
    stations
        "corners" or "gauss".
    """
    points = joint_points(surface, joints, stations)
    m = len(points)
    vertex, edge, joint = joint_ends(surface, joints)
    zeros = np.zeros(m)
    held = bonded[points.joint]
    found = ContactPoints(
        edge_a=points.edge_a,
        parameter_a=points.parameter_a,
        edge_b=points.edge_b,
        parameter_b=points.parameter_b,
        normal=points.normal,
        gap=points.gap,
        slip=zeros,
        length=points.length,
        slenderness=points.length / distance[points.joint],
        interface=interface[points.joint],
        key=-1 - np.arange(m),
        damage=np.where(held, 0.0, 1.0),
        state=np.where(held, int(BONDED), int(OPEN)),
        normal_force=zeros,
        shear_force=zeros,
        slid=zeros,
        worn=zeros,
        reference=zeros,
    )
    pairs = pair_key(surface, vertex, edge)
    return JointBook(
        found, points.joint, pairs, joint, lost=found.take(np.zeros(0, dtype=np.int64))
    )


def searched_points(
    found: Contacts, interface: Ints, surface: Surface | None = None
) -> ContactPoints:
    """Return found contacts as points without memory.

    Those that stand for a stretch of a face are as stiff as that is long: as stiff as a vertex of
    the body with the shorter edges on ``surface`` when it is half of such an edge.
    """
    m = len(found.gap)
    zeros = np.zeros(m)
    length, parameter_a, slenderness = zeros, zeros, np.ones(m)
    if isinstance(found, FaceContacts) and surface is not None:
        length, parameter_a = found.length, found.parameter_a
        grain = np.minimum(surface.grain[found.vertex], surface.grain[found.edge])
        slenderness = np.where(length > 0, length / grain, 1.0)
    return ContactPoints(
        edge_a=found.vertex,
        parameter_a=parameter_a,
        edge_b=found.edge,
        parameter_b=found.parameter,
        normal=found.normal,
        gap=found.gap,
        slip=zeros,
        length=length,
        slenderness=slenderness,
        interface=interface,
        key=found.key,
        damage=np.ones(m),
        state=np.full(m, int(OPEN)),
        normal_force=zeros,
        shear_force=zeros,
        slid=zeros,
        worn=zeros,
        reference=zeros,
    )


def remember(new: ContactPoints, old: ContactPoints, predecessor: Ints) -> ContactPoints:
    """Return the new points with state, forces and slip of the old points they continue."""
    if len(old) == len(new) and np.array_equal(predecessor, np.arange(len(new))):
        return replace(new, **{name: getattr(old, name) for name in CARRIED})
    known = predecessor >= 0
    source = np.where(known, predecessor, 0)

    def kept(name: str) -> Any:
        first = getattr(new, name)
        return np.where(known, getattr(old, name)[source], first) if len(old) else first

    return replace(new, **{name: kept(name) for name in CARRIED})


def answered(
    points: ContactPoints, answer: StepAnswer, bonded: Bools, sliding: Floats
) -> ContactPoints:
    """Return the points as an answer leaves them.

    ``bonded`` (m,) were held by a bond once; ``sliding`` (m,) is how far each slid under load (m).
    """
    parted = bonded & points.is_joint & (answer.state == OPEN)
    state = np.where(parted, int(BROKEN), answer.state)
    return replace(
        points,
        gap=answer.gap,
        slip=answer.slip,
        state=np.where(points.damage < 1, int(BONDED), state),
        normal_force=answer.normal_force,
        shear_force=answer.shear_force,
        slid=points.slid + np.where(points.is_joint, sliding, 0.0),
        worn=points.worn + np.abs(sliding),
    )


def _edge_pair(one: Ints, other: Ints, n: int) -> Ints:
    """Identity (m,) of pairs of edges, of ``n`` in all, in either order."""
    return np.minimum(one, other) * n + np.maximum(one, other)


def _turned(points: ContactPoints, surface: Surface, apart_of: Apart) -> ContactPoints:
    """Return points with the normal and gap of the moved surface."""
    normal, apart = surface.normal[points.edge_b], apart_of(points)
    return replace(points, normal=normal, gap=np.einsum("ij,ij->i", apart, normal))


def apart_on(surface: Surface, points: ContactPoints) -> Floats:
    """Where sides a of points are from sides b (m, 2), on the chords of the edges."""
    side_a = _on(surface, points.edge_a, points.parameter_a)
    return np.asarray(side_a - _on(surface, points.edge_b, points.parameter_b))


def _on(surface: Surface, edge: Ints, parameter: Floats) -> Floats:
    return surface.start[edge] + parameter[:, None] * (surface.end[edge] - surface.start[edge])
