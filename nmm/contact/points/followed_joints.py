"""Stretches of shared edges that are followed as joints from the start, and their points."""

from collections.abc import Callable
from typing import Protocol

import numpy as np

from integration.arrays import Bools, Floats, Ints
from integration.contraction import contract
from integration.plane_vectors import cross
from nmm.assembly.model import Model
from nmm.contact.detection.joints import Joints, find_joints, joint_ends, joint_points
from nmm.contact.detection.measures import SINE
from nmm.contact.detection.surface import Surface, pair_key
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.cracks.bonded_cracks import BondedCracks, refuse_unbonded
from nmm.contact.points.joint_book import JointBook
from nmm.contact.problem.step_problem import BONDED, OPEN
from nmm.interfaces.history import History

# What contact points have of those of joints.
OF_JOINTS = ("edge_a", "parameter_a", "edge_b", "parameter_b", "normal", "gap", "length")


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
    kink = _in_kink(surface, joints.take(joint), edge)
    no = np.zeros(len(pairs), dtype=bool)
    return JointBook(found, points.joint, pairs, joint, kink, no, no, lost=none, left=none)


def _in_kink(surface: Surface, ending: Joints, edge: Ints) -> Bools:
    """Return which edges (k,) turn towards the joint that ends beside them, from its own edge."""
    direction, kink = surface.direction, np.zeros(len(edge), dtype=bool)
    for own in (ending.edge_a, ending.edge_b):
        after, before = edge == surface.next[own], edge == surface.previous[own]
        turn = cross(direction[own], direction[edge])
        kink |= (after & (turn < -SINE)) | (before & (turn > SINE))
    return kink


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


def _distance(model: Model, joints: Joints) -> Floats:
    """Return lengths (j,) of the stiffest material as soft as what lies across joints (m).

    ``h = E_max (h_a / E_a + h_b / E_b)`` with the distances of both elements' middles from the
    joint; where moduli are equal to the largest, the distance of the middles, or the sum of these
    where both lie on one side.
    """
    manifold, modulus = model.manifold, model.modulus
    middle = manifold.elements.centroids
    a, b = (manifold.boundary.element[edge] for edge in (joints.edge_a, joints.edge_b))
    beside_a, beside_b, across = (
        contract("ij,ij->i", offset, joints.normal)
        for offset in (middle[a] - joints.start, middle[b] - joints.start, middle[a] - middle[b])
    )
    far_a, far_b = np.abs(beside_a), np.abs(beside_b)
    # The middle of a hollow block lies behind its joints, that of a ring in what it encloses.
    apart = np.where(beside_a * beside_b >= 0, far_a + far_b, np.abs(across))
    # About a tip both faces are of one element, which has no middle on either side.
    far_a, far_b, apart = (
        np.where(a == b, share * joints.length, far)
        for far, share in ((far_a, 0.5), (far_b, 0.5), (apart, 1.0))
    )
    softness = modulus.max() / modulus
    share = far_a / (far_a + far_b)
    mixed = share * softness[a] + (1 - share) * softness[b]
    return np.asarray(apart * np.where(softness[a] == softness[b], softness[a], mixed))
