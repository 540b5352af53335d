"""Contacts in prestressed ground: their springs carry the initial stress in the drawn geometry.

Joints do, and what bodies that touch without one are found to press at.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from integration.arrays import Bools, Floats, Ints
from integration.contraction import contract
from integration.plane_vectors import clockwise
from nmm.assembly.model import Model
from nmm.assembly.tractions.donors import across
from nmm.assembly.tractions.moments import with_moment
from nmm.contact.detection.joints import Joints, find_joints, joint_ends, joint_points
from nmm.contact.detection.surface import Surface, pair_key
from nmm.contact.detection.tolerances import ANGLE, JOINT
from nmm.contact.laws.contact_laws import ContactLaws
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.joint_book import JointBook
from nmm.contact.problem.step_problem import STICK

StressIn = Callable[[Ints, Floats], Floats]
"""Stress (m, 3) in Pa at reference points (m, 2) in elements (m,)."""

Sides = tuple[tuple[Ints, Floats], tuple[Ints, Floats]]


def laid_under_stress(
    book: JointBook, model: Model, laws: ContactLaws, stress: StressIn
) -> JointBook:
    """Return joints whose springs are stretched by the traction of a stress on their faces.

    The gap of each counts from where its spring would be free, its slip from there too. Bonds that
    consistent terms hold take the stress for themselves, and faces that hold no pull carry none.
    """
    points, joint = book.points, book.joint
    pull, along, line = _traction(points.sides, points.normal, model, stress)
    area = points.length * model.thickness
    pull, along = (area * with_moment(joint, points.length, line, part) for part in (pull, along))
    acts = ~points.tied & (points.bonded | (pull < 0))
    return replace(book, points=_stretched(points, laws, (pull, along), acts))


def found_under_stress(
    points: ContactPoints,
    surface: Surface,
    model: Model,
    laws: ContactLaws,
    stress: StressIn,
    exact: bool,
) -> ContactPoints:
    """Return found contacts whose springs are stretched as those of joints would be.

    A segment of a face carries the traction along its length, a corner what it has of the edges
    that two bodies share from there on. Where contact is ``exact`` nothing has to give for it.
    """
    corners = _at_corners(points, surface, model, stress)
    pull, along, _ = _traction(points.sides, points.normal, model, stress)
    touches = np.abs(points.gap) <= JOINT * surface.length.mean()
    area = np.where(touches, points.length * model.thickness, 0.0)
    mere = points.length == 0
    force = tuple(
        np.where(mere, corner, area * part)
        for corner, part in zip(corners, (pull, along), strict=True)
    )
    acts = (force[0] < 0) & (laws.springs(points)[2] | (not exact))
    return _stretched(points, laws, (force[0], force[1]), acts)


def taken_on_way(points: ContactPoints, before: Surface, after: Surface) -> float:
    """Return the work (J) that forces of points, as they are, take on the way of their sides."""
    starts, ends = (
        [surface.at(edge, parameter) for edge, parameter in points.sides]
        for surface in (before, after)
    )
    way = ends[0] - starts[0] - (ends[1] - starts[1])
    pull, shear = points.normal_force[:, None], points.shear_force[:, None]
    return float(np.sum((pull * points.normal + shear * clockwise(points.normal)) * way))


def _stretched(
    points: ContactPoints, laws: ContactLaws, force: tuple[Floats, Floats], acts: Bools
) -> ContactPoints:
    """Return points whose springs hold forces (m,), pull and shear (N), where they act."""
    normal, shear, _ = laws.springs(points)
    pull, along = (np.where(acts, part, 0.0) for part in force)
    stretch, slip = pull / normal, along / shear
    plastic = points.history["plastic_slip"] - np.where(points.bonded, slip, 0.0)
    return replace(
        points,
        gap=points.gap + stretch,
        reference=points.reference - stretch,
        slip=points.slip + slip,
        state=np.where(acts & ~points.bonded, int(STICK), points.state),
        normal_force=pull,
        shear_force=along,
        history={**points.history, "plastic_slip": plastic},
    )


def _at_corners(
    points: ContactPoints, surface: Surface, model: Model, stress: StressIn
) -> tuple[Floats, Floats]:
    """Pull and shear (N) that corners (m,) have of the edges that bodies share.

    The contacts at an end of such an edge divide its force evenly; where search sees none, such as
    at seams of flush blocks, those at its other end have all of it.
    """
    joints = find_joints(surface, within_bodies=True)
    ends = joint_points(surface, joints)
    sides = (ends.edge_a, ends.parameter_a), (ends.edge_b, ends.parameter_b)
    pull, along, line = _traction(sides, ends.normal, model, stress)
    contact, end = _of_ends(points, surface, joints)
    count = np.bincount(end, minlength=len(ends))
    other = np.arange(len(ends)) ^ 1
    found = []
    for part in (pull, along):  # two directions
        force = ends.length * model.thickness * with_moment(ends.joint, ends.length, line, part)
        force = force + np.where(count[other] == 0, force[other], 0.0)
        found.append(np.bincount(contact, force[end] / count[end], len(points)).astype(float))
    return found[0], found[1]


def _of_ends(points: ContactPoints, surface: Surface, joints: Joints) -> tuple[Ints, Ints]:
    """Contacts (k,) at ends of joints, and at which: twice the joint, or one more."""
    vertex, edge, joint = joint_ends(surface, joints)
    place = surface.start[vertex]
    far, near = (np.hypot(*(place - at[joint]).T) for at in (joints.start, joints.end))
    end = 2 * joint + (near < far)
    key = pair_key(surface, vertex, edge)
    order = np.argsort(points.key)
    at = order[np.searchsorted(points.key, key, sorter=order).clip(max=len(order) - 1)]
    facing = np.abs(contract("ij,ij->i", points.normal[at], joints.normal[joint]))
    there = (points.key[at] == key) & (facing >= np.cos(ANGLE))
    return at[there], end[there]


def _traction(
    sides: Sides, normal: Floats, model: Model, stress: StressIn
) -> tuple[Floats, Floats, Floats]:
    """Pull and shear (m,) at points (Pa), the mean of both sides, and where these lie along (m)."""
    boundary, way = model.manifold.boundary, clockwise(normal)
    places = [boundary.at(edge, parameter) for edge, parameter in sides]
    a, b = (
        stress(boundary.element[edge], place)
        for (edge, _), place in zip(sides, places, strict=True)
    )
    traction = across((a + b) / 2, normal)
    pull, along, line = (
        contract("ij,ij->i", *pair)
        for pair in ((traction, normal), (traction, way), (places[0], way))
    )
    return pull, along, line
