"""Joints of which a part has come apart: corners at their other end meet what they turn into."""

from dataclasses import replace

import numpy as np

from nmm.formulation import parse_formulation
from nmm.frozen import with_parts
from nmm.scene.read import parse_scene
from nmm.stepping.prepare import prepare

HINGED = """
plane = "stress"
duration = "1 s"
[materials.m]
density = 2000
young_modulus = "1 GPa"
poisson_ratio = 0.2
[interfaces.i]
friction_angle = 0.5
bonded = true
cohesion = "1 GPa"
tensile_strength = "1 GPa"
normal_stiffness = "1 GPa/m"
shear_stiffness = "1 GPa/m"
[[blocks]]
name = "low"
material = "m"
vertices = [[-1, -1], [2, -1], [2, 0], [-1, 0]]
[[blocks]]
name = "high"
material = "m"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[inertia]
[contact]
"""

GAUSS = '[contact]\njoint_points = "gauss"\n'


def found(angle: float) -> np.ndarray:
    """Depths (m) of contacts of a block that has turned about the last bond of its joint."""
    made = prepare(parse_scene(HINGED), parse_formulation(GAUSS))
    contact, start = made.stepper.plan.contact, made.start
    book = contact.record.book
    hinge = (1 + 1 / np.sqrt(3)) / 2
    frames = start.frames
    c, s = np.cos(angle), np.sin(angle)
    arm = np.array([hinge, 0.0]) - frames.centre[1]
    centre = frames.centre.copy()
    centre[1] += arm - np.array([c * arm[0] - s * arm[1], s * arm[0] + c * arm[1]])
    turned = replace(frames, centre=centre, angle=np.array([0.0, angle]))
    state = with_parts(start, frames=turned)
    far = np.abs(book.points.parameter_b - hinge) > 0.1
    points = with_parts(book.points, history=book.points.history | {"bonded": ~far})
    surface = contact.partners.surface(state)
    book = book.keep(points, contact.geometry.faces(state, surface))
    contact.record = with_parts(contact.record, book=book)
    points = contact.candidates(state, 0.01)
    return -(points.gap + points.reference)[~points.is_joint]


def test_a_corner_beyond_the_last_bond_is_a_contact_with_its_whole_depth() -> None:
    angle = -0.2
    depth = (1 - (1 + 1 / np.sqrt(3)) / 2) * np.sin(-angle)
    # Its vertex in the edge below; rounding of a rotation.
    assert np.abs(found(angle) - depth).min() < 1e-12


def test_a_joint_that_has_opened_little_hides_the_corners_at_its_ends() -> None:
    assert not len(found(-0.01))
