"""Joints of which a part has come apart: corners at their other end meet what they turn into."""

from dataclasses import replace

import numpy as np
import pytest

import nmm
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


# Where the last bond of the joint is (m), and how far the other one is from it.
HINGE, APART = (1 + 1 / np.sqrt(3)) / 2, 1 / np.sqrt(3)


def hinged():
    """Return contact and start of two blocks, and a book in which one of two bonds is broken."""
    made = prepare(parse_scene(HINGED), parse_formulation(GAUSS))
    contact = made.stepper.plan.contact
    points = contact.record.book.points
    far = np.abs(points.parameter_b - HINGE) > 0.1
    broken = with_parts(points, history=points.history | {"bonded": ~far})
    return contact, made.start, replace(contact.record.book, points=broken)


def turned(start, angle: float):
    """Return a state in which the upper block has turned about the last bond."""
    frames = start.frames
    c, s = np.cos(angle), np.sin(angle)
    arm = np.array([HINGE, 0.0]) - frames.centre[1]
    centre = frames.centre.copy()
    centre[1] += arm - np.array([c * arm[0] - s * arm[1], s * arm[0] + c * arm[1]])
    return with_parts(start, frames=replace(frames, centre=centre, angle=np.array([0.0, angle])))


def kept(contact, book, state):
    """Return the book after a step that ends in a state."""
    return book.keep(book.points, contact.geometry.faces(state, contact.partners.surface(state)))


def found(angle: float) -> np.ndarray:
    """Depths (m) of contacts of a block that has turned about the last bond of its joint."""
    contact, start, book = hinged()
    state = turned(start, angle)
    contact.record = with_parts(contact.record, book=kept(contact, book, state))
    points = contact.candidates(state, 0.01)
    return -(points.gap + points.reference)[~points.is_joint]


def test_a_corner_beyond_the_last_bond_is_a_contact_with_its_whole_depth() -> None:
    angle = -0.2
    depth = (1 - HINGE) * np.sin(-angle)
    # Its vertex in the edge below; rounding of a rotation.
    assert np.abs(found(angle) - depth).min() < 1e-12


def test_a_joint_that_has_opened_little_hides_the_corners_at_its_ends() -> None:
    assert not len(found(-0.01))


def test_a_point_that_was_given_up_goes_on_telling_how_far_its_faces_are_apart() -> None:
    contact, start, book = hinged()
    for angle in (-0.2, -0.3):
        book = kept(contact, book, turned(start, angle))
    # Across the line between the faces, which halves their angle: the chord of the arc.
    assert book.lost.gap == pytest.approx(2 * APART * np.sin(0.15), rel=1e-12)
    assert book.broken == 1


PUSHED = """
plane = "strain"
[materials.rock]
young_modulus = "10 GPa"
poisson_ratio = 0.2
density = 2500
[interfaces.joint]
friction_angle = "60 deg"
bonded = true
cohesion = "10 kPa"
tensile_strength = "10 kPa"
[[blocks]]
name = "ground"
material = "rock"
vertices = [[-2, -1], [3, -1], [3, 0], [-2, 0]]
[[blocks]]
name = "block"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 2], [0, 2]]
[[supports]]
name = "ground"
block = "ground"
fix = ["x", "y"]
[[loads]]
name = "push"
kind = "point"
point = [0, 2]
force = [%g, 0]
[gravity]
[contact]
"""


@pytest.mark.parametrize(("share", "status"), [(0.97, "converged"), (1.03, "collapsed")])
def test_a_block_on_a_broken_joint_turns_over_about_its_corner(share: float, status: str) -> None:
    """Its bond breaks at 0.6 of that load; its points are 0.577 of half of its width out."""
    weight, width, height = 2500 * 9.81 * 2.0, 1.0, 2.0
    push = weight * (width / 2) / height
    assert nmm.run(nmm.parse_scene(PUSHED % (share * push))).summary.status == status


SOFTENING = """law = "linear_softening"
fracture_energy = "100 J/m^2"
"""


GROUND = "[[-2, -1], [3, -1], [3, 0], [-2, 0]]"


@pytest.mark.slow
@pytest.mark.parametrize("ground", [GROUND, "[[0, -1], [1, -1], [1, 0], [0, 0]]"])
def test_a_block_on_a_softening_joint_turns_over_about_its_corner_against_both_bonds(
    ground: str,
) -> None:
    """They open by 20 mm before all is lost, and pull with their strength in the joint's middle.

    On ground as wide as the block its corner is on a corner.
    """
    weight, width, height, strength = 2500 * 9.81 * 2.0, 1.0, 2.0, 10e3
    push = (weight + strength * width) * (width / 2) / height
    scene = PUSHED.replace("[[blocks]]", SOFTENING + "[[blocks]]", 1)
    scene = scene.replace(GROUND, ground) % (2 * push)
    given = nmm.Formulation.model_validate({"loading": {"increment": 0.1}})
    found = nmm.run(parse_scene(scene + '[loading]\nscaled = ["push"]\n'), given).summary
    # The joint's points lie in its plane, blocks shear by 1e-5; the search stops at 0.3 %.
    assert found.failure_load == pytest.approx(push, rel=0.01)
