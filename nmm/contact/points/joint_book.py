"""Joints that are followed from the start: their contact points keep their place."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Protocol

import numpy as np

from integration.arrays import Bools, Floats, Ints
from integration.contraction import contract
from nmm.assembly.model import Model
from nmm.contact.detection.contacts import Contacts
from nmm.contact.detection.joints import Joints, find_joints, joint_ends, joint_points
from nmm.contact.detection.surface import Surface, pair_key, unordered_key
from nmm.contact.detection.tolerances import JOINT_LEFT, WHOLLY_HELD
from nmm.contact.points.between_faces import JointFaces
from nmm.contact.points.bonded_cracks import BondedCracks, refuse_unbonded
from nmm.contact.points.boundary_points import tangents
from nmm.contact.points.contact_points import ContactPoints, concatenate
from nmm.contact.problem.step_problem import BONDED, BROKEN, OPEN
from nmm.interfaces.history import History

# What contact points have of those of joints.
OF_JOINTS = ("edge_a", "parameter_a", "edge_b", "parameter_b", "normal", "gap", "length")


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
    lost: ContactPoints
    left: ContactPoints

    def only(self, chosen: Bools) -> "JointBook":
        """Return the book with some of its points (m,)."""
        return replace(self, points=self.points.take(chosen), joint=self.joint[chosen])

    def hides(self, found: Contacts) -> Bools:
        """Which found contacts a followed joint carries already."""
        return np.isin(found.key, self.pairs)

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
        stretch = contract("ij,ij->i", apart, tangents(normal))
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
        far = np.hypot(opened, contract("ij,ij->i", apart, tangents(normal)))
        lost = (far > JOINT_LEFT * points.length) & ~points.bonded
        parted = self.joint[lost]
        gone = np.isin(self.joint, parted) & ~points.bonded
        before = _turned(self.lost, faces)
        left = points.take(gone) if gone.any() or len(self.left) else self.left
        if not gone.any():
            return replace(self, points=points, lost=before, left=left)
        whole = ~np.isin(self.pair_joint, parted)
        return replace(
            self,
            points=points.take(~gone),
            joint=self.joint[~gone],
            pairs=self.pairs[whole],
            pair_joint=self.pair_joint[whole],
            lost=concatenate([before, given_up(left)]),
            left=left,
        )

    @cached_property
    def broken(self) -> int:
        """Number of points whose bond is broken, lost ones included."""
        return int((~self.points.bonded).sum()) + len(self.lost)


class JointLaws(Protocol):
    """What joints ask of the laws of a scene's n interfaces."""

    @property
    def makes_joints(self) -> Bools:
        """(n,) whether shared edges are followed as joints."""

    @property
    def bonded(self) -> Bools:
        """(n,) whether they hold together at the start."""

    def initial(self, interface: Ints, bonded: Bools) -> History:
        """Return what the laws of points (m,) remember at first, of bonds that hold or not."""


def follow_joints(
    surface: Surface,
    model: Model,
    interface_of: Callable[[Ints, Ints], Ints],
    laws: JointLaws,
    joint_rule: tuple[str, int],
    cracks: BondedCracks,
) -> JointBook:
    """Follow the stretches of edges that two bodies share, or two faces of a bonded crack.

    Parameters
    ----------
    surface, model
        Where the edges are at the start, and the materials behind them.
    interface_of
        From two edges to the index of their interface, negative without.
    laws
        Of the interfaces.
    joint_rule
        "corners" or "gauss", where joints act along their edge, and at how many Gauss points.
    cracks
        Those within bodies whose faces hold together.
    """
    joints, interface = _followed(surface, interface_of, laws, cracks)
    distance = _distance(model, joints)
    points = joint_points(surface, joints, *joint_rule)
    vertex, edge, joint = joint_ends(surface, joints)
    held = laws.bonded[interface[points.joint]]
    found = ContactPoints.unloaded(
        **{name: getattr(points, name) for name in OF_JOINTS},
        spring_factor=points.length / distance[points.joint],
        interface=interface[points.joint],
        key=-1 - np.arange(len(points)),
        state=np.where(held, int(BONDED), int(OPEN)),
        history=laws.initial(interface[points.joint], held),
    )
    pairs = pair_key(surface, vertex, edge)
    none = found.take(np.zeros(0, dtype=np.int64))
    return JointBook(found, points.joint, pairs, joint, lost=none, left=none)


def _followed(
    surface: Surface,
    interface_of: Callable[[Ints, Ints], Ints],
    laws: JointLaws,
    cracks: BondedCracks,
) -> tuple[Joints, Ints]:
    """Return the stretches that are followed, and the interface (j,) of each."""
    joints = find_joints(surface, within_bodies=bool(cracks))
    middle = (joints.start + joints.end) / 2
    seam, apart = cracks.hold(middle), surface.body[joints.edge_a] != surface.body[joints.edge_b]
    kept = seam | (apart & ~cracks.part(middle))
    joints, seam = joints.take(kept), seam[kept]
    interface = interface_of(joints.edge_a, joints.edge_b)
    firm = (interface >= 0) & laws.bonded[np.maximum(interface, 0)]
    refuse_unbonded(joints.start[seam & ~firm])
    wanted = (interface >= 0) & laws.makes_joints[np.maximum(interface, 0)]
    return joints.take(wanted), interface[wanted]


def given_up(points: ContactPoints) -> ContactPoints:
    """Return points of joints that came apart, which carry nothing from now on."""
    zero = np.zeros(len(points))
    broken = np.full(len(points), int(BROKEN))
    return replace(points, state=broken, normal_force=zero, shear_force=zero)


def _distance(model: Model, joints: Joints) -> Floats:
    """Return lengths (j,) of the stiffest material as soft as what lies across joints (m).

    ``h = E_max (h_a / E_a + h_b / E_b)`` with the distances of both elements' middles from the
    joint; where moduli are equal to the largest, the distance of the middles.
    """
    manifold, modulus = model.manifold, model.modulus
    middle = manifold.elements.centroids
    a, b = (manifold.boundary.element[edge] for edge in (joints.edge_a, joints.edge_b))
    far_a, far_b, apart = (
        np.abs(contract("ij,ij->i", offset, joints.normal))
        for offset in (middle[a] - joints.start, middle[b] - joints.start, middle[a] - middle[b])
    )
    # About a tip both faces are of one element, which has no middle on either side.
    far_a, far_b, apart = (
        np.where(a == b, share * joints.length, far)
        for far, share in ((far_a, 0.5), (far_b, 0.5), (apart, 1.0))
    )
    softness = modulus.max() / modulus
    share = far_a / (far_a + far_b)
    mixed = share * softness[a] + (1 - share) * softness[b]
    return np.asarray(apart * np.where(softness[a] == softness[b], softness[a], mixed))


def _turned(points: ContactPoints, faces: JointFaces) -> ContactPoints:
    """Return points with the normal and gap of moved faces."""
    normal, apart = faces.normal(points), faces.apart(points)
    return replace(points, normal=normal, gap=contract("ij,ij->i", apart, normal))
