"""Which of the edges that bodies share are bonded for good, and which bodies hang together so."""

import numpy as np

from covers.cutting.components import components
from integration.arrays import Bools, Floats
from nmm.constraints.shared_edges import shared_edges
from nmm.contact.detection.joints import Joints
from nmm.effects.base import Setup
from nmm.errors import SceneError


def bonded_stiffness(setup: Setup, joints: Joints) -> tuple[Floats, Bools, Bools]:
    """Stiffness (j, 2) in Pa/m of joints, NaN where none is named; which are sprung, and glued."""
    edges, region = setup.model.manifold.boundary, setup.model.manifold.element_region
    one, two = edges.element[joints.edge_a], edges.element[joints.edge_b]
    materials, found = list(setup.scene.materials), np.full((len(one), 2), np.nan)
    bonded = np.zeros(len(one), dtype=bool)
    first, second = setup.region_material[region[one]], setup.region_material[region[two]]
    for a, b in np.unique(np.stack([first, second], axis=1), axis=0):  # pairs of materials
        try:
            item = setup.scene.interface(materials[a], materials[b])
        except SceneError:
            continue
        # Sub-blocks of one block are the formulation's to tie.
        chosen = (first == a) & (second == b) & (region[one] != region[two]) & item.bonded
        bonded |= chosen
        for axis, own in enumerate((item.normal_stiffness, item.shear_stiffness)):
            found[chosen, axis] = np.nan if own is None else own
    named = ~np.isnan(found).all(axis=1)
    return found, bonded & named, bonded & ~named


def bonded_groups(setup: Setup) -> int:
    """Return how many groups of bodies nothing that is bonded holds together."""
    model = setup.model
    joints = shared_edges(model)
    _, sprung, glued = bonded_stiffness(setup, joints)
    held = joints.take(sprung | glued)
    edges, body = model.manifold.boundary, model.manifold.element_body
    pairs = (body[edges.element[edge]] for edge in (held.edge_a, held.edge_b))
    return int(components(model.manifold.n_bodies, *pairs).max(initial=-1)) + 1
