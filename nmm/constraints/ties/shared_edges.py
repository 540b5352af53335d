"""Interfaces between bodies: the edges that they share, and which of these are bonded for good."""

from dataclasses import replace

import numpy as np

from covers.cutting.components import components
from integration.arrays import Bools, Floats, Ints
from integration.segments import segment_rule
from nmm.assembly.material_points import material_points
from nmm.assembly.model import Model
from nmm.assembly.places import Place
from nmm.assembly.state import State, initial_state
from nmm.constraints.interface import Interface
from nmm.contact.detection.joints import Joints, find_joints, joint_points
from nmm.contact.points.boundary_points import sides
from nmm.effects.base import Setup
from nmm.errors import SceneError

# Least degree of the work along shared edges that is integrated exactly.
EDGE_ORDER = 8


def shared_edges(model: Model) -> Joints:
    """Return the edges that bodies share in the reference place."""
    start = initial_state(model.manifold)
    return find_joints(sides(model.manifold).surface(start.frames, start.deformation))


def gauss_interface(
    model: Model,
    joints: Joints,
    order: int = EDGE_ORDER,
    acted: tuple[Bools, Bools] | None = None,
) -> Interface:
    """Interface of Gauss points of shared edges; its pieces are the joints.

    On joints (j,) that are ``acted`` on, for each side, something else acts.
    """
    points, weight = segment_rule(joints.start, joints.end, order)
    joint = np.repeat(np.arange(len(joints)), weight.shape[1])
    found = _interface(model, joints, joint, points.reshape(-1, 2), weight.ravel())
    return found if acted is None else replace(found, acted=(acted[0][joint], acted[1][joint]))


def corner_interface(model: Model, joints: Joints, start: State) -> Interface:
    """Interface of the two corners of each joint."""
    surface = sides(model.manifold).surface(start.frames, start.deformation)
    found = joint_points(surface, joints)
    return _interface(model, joints, found.joint, found.position, found.length)


def _interface(
    model: Model, joints: Joints, joint: Ints, points: Floats, length: Floats
) -> Interface:
    places = []
    for sign, edge in ((-1.0, joints.edge_a), (1.0, joints.edge_b)):
        elements = model.manifold.boundary.element[edge[joint]]
        material = material_points(model.manifold, elements, points)
        normal = sign * joints.normal[joint]
        places.append(Place(material, elements, length, points, normal, joint))
    return Interface(places[0], places[1], length * model.thickness)


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
