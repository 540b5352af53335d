"""Interfaces between bodies: the edges that they share."""

import numpy as np

from integration.arrays import Floats, Ints
from integration.segments import segment_rule
from nmm.assembly.material_points import material_points
from nmm.assembly.model import Model
from nmm.assembly.places import Place
from nmm.assembly.state import State, initial_state
from nmm.constraints.interface import Interface
from nmm.contact.detection.joints import Joints, find_joints, joint_points
from nmm.contact.points.boundary_points import sides

# Least degree of the work along shared edges that is integrated exactly.
EDGE_ORDER = 8


def shared_edges(model: Model) -> Joints:
    """Return the edges that bodies share in the reference place."""
    start = initial_state(model.manifold)
    return find_joints(sides(model.manifold).surface(start.frames, start.deformation))


def gauss_interface(model: Model, joints: Joints, order: int = EDGE_ORDER) -> Interface:
    """Interface of Gauss points of shared edges; its pieces are the joints."""
    points, weight = segment_rule(joints.start, joints.end, order)
    joint = np.repeat(np.arange(len(joints)), weight.shape[1])
    return _interface(model, joints, joint, points.reshape(-1, 2), weight.ravel())


def joint_interface(model: Model, joints: Joints, joint_rule: str, start: State) -> Interface:
    """Interface of two points for each joint, at its corners or its Gauss points."""
    surface = sides(model.manifold).surface(start.frames, start.deformation)
    found = joint_points(surface, joints, joint_rule)
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
