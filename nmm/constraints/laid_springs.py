"""Springs in prestressed ground: they carry the initial stress in the drawn geometry."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Bools, Floats
from integration.contraction import contract
from integration.plane_vectors import clockwise
from nmm.assembly.places import Place
from nmm.assembly.tractions.donors import across
from nmm.assembly.tractions.moments import with_moment
from nmm.constraints.imposition import Imposition
from nmm.effects.base import Setup

if TYPE_CHECKING:
    from nmm.contact.detection.joints import Joints

# Of the length of an edge: points lie within a joint up to rounding.
WITHIN = 1e-9


def laid_under_stress(setup: Setup, ties: Sequence[Imposition]) -> list[Imposition]:
    """Return ties whose springs along edges carry the traction of the initial stress at first.

    Between bodies it is the mean of both sides. Against the ground it is held back where another
    body takes it. Springs at points are left as they are (`points_under_stress`), and other methods
    know of the stress themselves.
    """
    return [tie.laid(_stretches(setup, tie)) for tie in ties]


def stretch_of(tie: Imposition) -> Floats:
    """Stretch (m, 2) with which the springs of a tie were laid (m)."""
    return np.broadcast_to(tie.stretch, (len(tie.interface), 2))


def spring_rate(tie: Imposition) -> Floats:
    """Return springs (m, 1) for each length along edges (Pa/m); zero where there are none."""
    springs = tie.springs
    if springs is None or springs.ndim > 1 or tie.interface.first.normal is None:
        return np.zeros((len(tie.interface), 1))
    return np.asarray((springs / tie.interface.area)[:, None])


def exerting_the_same(anchor: Floats, jump: Floats, before: Floats, now: Floats) -> Floats:
    """Return the stress-free jump (m, 2) of springs that are stiffer or softer than before.

    They exert at a ``jump`` beyond the ``anchor`` (m, 2) what they did; rates are of `spring_rate`.
    """
    sprung = (before > 0) & (now > 0)
    share = np.where(sprung, 1 - before / np.where(sprung, now, 1.0), 0.0)
    return np.asarray(anchor + share * jump)


def free_where(tie: Imposition, chosen: Bools) -> Imposition:
    """Return a tie whose springs are laid free in chosen components (m, 2)."""
    return tie.laid(np.where(chosen, 0.0, tie.stretch))


def _stretches(setup: Setup, tie: Imposition) -> Floats:
    """Stretch (m, 2) of springs along an edge that carry the stress; zero of other ties."""
    normal, springs = tie.interface.first.normal, tie.springs
    if normal is None or springs is None:
        return np.zeros((len(tie.interface), 2))
    from nmm.effects.initial.stress_at_start import StressAtStart

    ground, interface = StressAtStart.declared(setup).within(setup.model), tie.interface
    sides = interface.sides
    stress = np.mean([ground(side.elements, side.position) for side in sides], axis=0)
    place, own = interface.first, across(stress, normal).T
    assert place.piece is not None
    line = contract("ij,ij->i", place.position, clockwise(normal))
    even = [with_moment(place.piece, place.weight, line, part) for part in own]
    traction = interface.held * np.stack(even, axis=1)
    if interface.second is None:
        traction = np.where(faces_another(setup, place)[:, None], 0.0, traction)
    return stretched(springs, interface.area[:, None] * traction)


def stretched(stiffness: Floats, force: Floats) -> Floats:
    """Return the way (m, 2) of springs at forces (m, 2); none of springs that are not there."""
    if stiffness.ndim > 1:
        return np.asarray(np.linalg.solve(stiffness, force[:, :, None])[:, :, 0], dtype=float)
    there = stiffness > 0
    return np.where(there[:, None], force / np.where(there, stiffness, 1.0)[:, None], 0.0)


def faces_another(setup: Setup, place: Place) -> Bools:
    """Points (m,) on edges that face another body, whose contact or bond has the traction."""
    return on_joints(facing_joints(setup), place)


def facing_joints(setup: Setup) -> "Joints":
    """Return the edges along which bodies touch or are bonded."""
    from nmm.constraints.ties.shared_edges import bonded_stiffness, shared_edges  # finds contacts

    joints = shared_edges(setup.model)
    if setup.scene.contact is None:
        _, sprung, glued = bonded_stiffness(setup, joints)
        joints = joints.take(sprung | glued)
    return joints


def on_joints(joints: "Joints", place: Place) -> Bools:
    """Return which points (m,) of edges lie on joints."""
    found = np.zeros(len(place), dtype=bool)
    assert place.edge is not None
    for edges in (joints.edge_a, joints.edge_b):  # two sides
        pair, point = np.nonzero(edges[:, None] == place.edge)
        way = joints.end[pair] - joints.start[pair]
        along = contract("ij,ij->i", place.position[point] - joints.start[pair], way)
        along /= contract("ij,ij->i", way, way)
        found[point[(along > -WITHIN) & (along < 1 + WITHIN)]] = True
    return found
