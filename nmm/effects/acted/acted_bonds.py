"""Bonds on whose faces a scene lets something else act."""

import numpy as np

from integration.arrays import Bools
from nmm.contact.points.contact_points import ContactPoints
from nmm.effects.acted.acted_faces import (
    ActedFaces,
    mean_taken,
    shared_edge_parts,
    wet_faces,
)
from nmm.effects.base import Setup


def acted_on(setup: Setup, joints: ContactPoints) -> tuple[Bools, Bools] | None:
    """Return on which faces (m,) beside joint points something acts; None where nothing does."""
    sides = shared_edge_parts(setup.model, joints.edge_a, joints.edge_b)
    return ActedFaces.of(setup).beside(sides)


def loaded_twice(setup: Setup, joints: ContactPoints) -> str:
    """Tell loads on both faces of bonds that Nitsche's terms hold; empty without any."""
    tied = joints.take(joints.tied)
    if not len(tied):
        return ""
    edges = np.unique(np.stack([tied.edge_a, tied.edge_b]), axis=1)
    found = ActedFaces.of(setup).twice(shared_edge_parts(setup.model, *edges))
    found = found or wet_faces(setup)
    if not found:
        return ""
    remedy = '[contact] bonds = "spring" with bond_stiffness = 100'
    harm = "faces part, and bonds fail early,"
    return mean_taken(found, "bonds by Nitsche's terms", remedy, harm)
