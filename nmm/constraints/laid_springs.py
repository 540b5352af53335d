"""Springs in prestressed ground: they carry the initial stress in the drawn geometry."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from integration.arrays import Bools, Floats
from integration.contraction import contract
from nmm.assembly.tractions.donors import across
from nmm.constraints.imposition import Imposition
from nmm.constraints.interface import Interface
from nmm.constraints.springs import Springs
from nmm.effects.base import Setup

# Of the length of an edge: points lie within a joint up to rounding.
WITHIN = 1e-9


def laid_under_stress(setup: Setup, ties: Sequence[Imposition]) -> list[Imposition]:
    """Return ties whose springs along edges carry the traction of the initial stress at first.

    Between bodies it is the mean of both sides. Against the ground it is held back where another
    body takes it. Springs at points carry none, and other methods know of the stress themselves.
    """
    return [
        _laid(setup, tie)
        if isinstance(tie, Springs) and tie.interface.first.normal is not None
        else tie
        for tie in ties
    ]


def stretch_of(tie: Imposition) -> Floats:
    """Stretch (m, 2) with which a tie was laid (m); zero of what has no springs."""
    laid = tie.stretch if isinstance(tie, Springs) else None
    return np.zeros((len(tie.interface), 2)) if laid is None else laid


def free_where(tie: Imposition, chosen: Bools) -> Imposition:
    """Return a tie whose springs are laid free in chosen components (m, 2)."""
    if not isinstance(tie, Springs) or tie.stretch is None:
        return tie
    return replace(tie, stretch=np.where(chosen, 0.0, tie.stretch))


def _laid(setup: Setup, tie: Springs) -> Springs:
    from nmm.effects.initial.stress_at_start import StressAtStart

    ground, interface = StressAtStart.declared(setup).within(setup.model), tie.interface
    sides = interface.sides
    stress = np.mean([ground(side.elements, side.position) for side in sides], axis=0)
    assert interface.first.normal is not None
    traction = interface.held * across(stress, interface.first.normal)
    if interface.second is None:
        traction = np.where(_taken(setup, interface)[:, None], 0.0, traction)
    return replace(tie, stretch=_stretch(tie.stiffness, interface.area[:, None] * traction))


def _stretch(stiffness: Floats, force: Floats) -> Floats:
    """Return the way (m, 2) of springs at forces (m, 2); none of springs that are not there."""
    if stiffness.ndim > 1:
        return np.asarray(np.linalg.solve(stiffness, force[:, :, None])[:, :, 0], dtype=float)
    there = stiffness > 0
    return np.where(there[:, None], force / np.where(there, stiffness, 1.0)[:, None], 0.0)


def _taken(setup: Setup, interface: Interface) -> Bools:
    """Points (m,) of a support that face another body, whose contact or bond has the traction."""
    from nmm.constraints.shared_edges import bonded_stiffness, shared_edges  # finds contacts

    joints, place = shared_edges(setup.model), interface.first
    if setup.scene.contact is None:
        _, sprung, glued = bonded_stiffness(setup, joints)
        joints = joints.take(sprung | glued)
    found = np.zeros(len(interface), dtype=bool)
    assert place.edge is not None
    for edges in (joints.edge_a, joints.edge_b):  # two sides
        pair, point = np.nonzero(edges[:, None] == place.edge)
        way = joints.end[pair] - joints.start[pair]
        along = contract("ij,ij->i", place.position[point] - joints.start[pair], way)
        along /= contract("ij,ij->i", way, way)
        found[point[(along > -WITHIN) & (along < 1 + WITHIN)]] = True
    return found
