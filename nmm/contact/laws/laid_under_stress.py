"""Joints in prestressed ground: their springs carry the initial stress in the drawn geometry."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from integration.arrays import Floats, Ints
from integration.contraction import contract
from nmm.assembly.model import Model
from nmm.assembly.tractions.donors import across
from nmm.contact.laws.contact_laws import ContactLaws
from nmm.contact.points.boundary_points import tangents
from nmm.contact.points.joint_book import JointBook
from nmm.contact.problem.step_problem import STICK

StressIn = Callable[[Ints, Floats], Floats]
"""Stress (m, 3) in Pa at reference points (m, 2) in elements (m,)."""


def laid_under_stress(
    book: JointBook, model: Model, laws: ContactLaws, stress: StressIn
) -> JointBook:
    """Return joints whose springs are stretched by the traction of a stress on their faces.

    The gap of each counts from where its spring would be free, its slip from there too. Bonds that
    consistent terms hold take the stress for themselves, and faces that hold no pull carry none.
    """
    points = book.points
    normal, shear, _ = laws.springs(points)
    pull, along = _traction(book, model, stress)
    force = points.length * model.thickness
    pull = np.where(points.bonded, pull, np.minimum(pull, 0.0))
    acts = ~points.tied & (points.bonded | (pull < 0))
    stretch = np.where(acts, force * pull / normal, 0.0)
    slip = np.where(acts, force * along / shear, 0.0)
    plastic = points.history["plastic_slip"] - np.where(points.bonded, slip, 0.0)
    return replace(
        book,
        points=replace(
            points,
            gap=points.gap + stretch,
            reference=points.reference - stretch,
            slip=points.slip + slip,
            state=np.where(acts & ~points.bonded, int(STICK), points.state),
            normal_force=np.where(acts, force * pull, 0.0),
            shear_force=np.where(acts, force * along, 0.0),
            history={**points.history, "plastic_slip": plastic},
        ),
    )


def _traction(book: JointBook, model: Model, stress: StressIn) -> tuple[Floats, Floats]:
    """Pull and shear (m,) at points (Pa), the mean of both sides, with their moment about joints.

    Points at the ends of a joint have more of a moment than what is spread along it: they take the
    part of its slope that gives the same.
    """
    points, boundary = book.points, model.manifold.boundary
    normal, way = points.normal, tangents(points.normal)
    places = [boundary.at(edge, parameter) for edge, parameter in points.sides]
    a, b = (
        stress(boundary.element[edge], place)
        for (edge, _), place in zip(points.sides, places, strict=True)
    )
    traction = across((a + b) / 2, normal)
    line = contract("ij,ij->i", places[0], way)
    pull, along = (contract("ij,ij->i", traction, axis) for axis in (normal, way))
    return _with_moment(book, line, pull), _with_moment(book, line, along)


def _with_moment(book: JointBook, line: Floats, stress: Floats) -> Floats:
    """Return stresses (m,) at places (m,) along joints (m) whose moment is that of a line."""
    joint, length = book.joint, book.points.length

    def whole(part: Floats) -> Floats:
        return np.asarray(np.bincount(joint, length * part)[joint], dtype=np.float64)

    total = whole(np.ones_like(line))
    offset, mean = line - whole(line) / total, whole(stress) / total
    spread = np.maximum(whole(offset**2), np.finfo(float).tiny)
    slope = np.minimum(total**3 / 12 / spread, 1.0)
    return np.asarray(mean + slope * (stress - mean))
