"""Rows of contacts between two states: their product with a step is what gaps and slips change."""

import numpy as np
import pytest

from nmm.assembly.material_points import material_points
from nmm.contact.points.joint_points import JointSites
from nmm.formulation import parse_formulation
from nmm.frozen import with_parts
from nmm.scene.read import parse_scene
from nmm.stepping.prepare import prepare

SCENE = """
plane = "strain"
duration = 1.0
[materials.m]
young_modulus = 1000.0
poisson_ratio = 0.3
density = 1.0
[interfaces.s]
friction_angle = 0.3
[[blocks]]
name = "a"
material = "m"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[blocks]]
name = "b"
material = "m"
vertices = [[1.02, 0.3], [2, 0.3], [2, 1.3], [1.02, 1.3]]
[inertia]
[contact]
"""
FORMULATION = """
[cover]
type = "quads"
size = 0.5
degree = {degree}
[rotation]
update = "finite"
[contact]
points = "{points}"
"""


def two_states(degree, points, seed, scene=SCENE):
    """Contact, its points, and two states that are bent and turned by a third of their size."""
    made = prepare(
        parse_scene(scene), parse_formulation(FORMULATION.format(degree=degree, points=points))
    )
    contact, draws = made.stepper.plan.contact, np.random.default_rng(seed)
    start = made.start

    def bent():
        more = 0.1 * draws.normal(size=len(start.deformation))
        return with_parts(start, deformation=start.deformation + more)

    return contact, contact.candidates(start, 0.2, None), bent(), bent()


@pytest.mark.parametrize("seed", [1, 2])
@pytest.mark.parametrize("points", ["vertices", "faces"])
def test_a_step_changes_gaps_by_what_rows_say_however_far_it_goes(seed, points):
    contact, found, before, after = two_states(0, points, seed)
    rows = contact.geometry.conserving(found, before, after)
    gaps, places, lengths = [], [], []
    for state in (before, after):
        surface = contact.partners.surface(state)
        low, high = surface.start[found.edge_b], surface.end[found.edge_b]
        apart = surface.at(found.edge_a, found.parameter_a) - low
        way = high - low
        length = np.hypot(*way.T)
        gaps.append((apart[:, 0] * way[:, 1] - apart[:, 1] * way[:, 0]) / length)
        places.append((apart * way).sum(axis=1) / length**2)
        lengths.append(length)
    step = after.deformation - before.deformation
    assert len(found) > 2
    # rounding of lengths of about one, in some ten sums and products
    np.testing.assert_allclose(rows.normal @ step, gaps[1] - gaps[0], rtol=0, atol=1e-14)
    slip = -(lengths[0] + lengths[1]) / 2 * (places[1] - places[0])
    np.testing.assert_allclose(rows.tangent @ step, slip, rtol=0, atol=1e-14)


def test_where_faces_bend_the_gap_is_across_the_material():
    contact, found, before, after = two_states(1, "faces", 3)
    rows = contact.geometry.conserving(found, before, after)
    manifold = contact.geometry.sides.manifold
    boundary, edge, gaps = manifold.boundary, found.edge_b, []

    def places(state, ahead):
        at = boundary.at(edge, found.parameter_b + ahead)
        points = material_points(manifold, boundary.element[edge], at)
        return points.place(state.frames, state.deformation)

    for state in (before, after):
        here = JointSites.at(contact.geometry.sides, found)
        apart = here.apart(found, state.frames, state.deformation)
        way = places(state, 1e-5) - places(state, -1e-5)
        across = (apart[:, 0] * way[:, 1] - apart[:, 1] * way[:, 0]) / np.hypot(*way.T)
        gaps.append(across)
    step = after.deformation - before.deformation
    # central differences along the face: 1e-10 of its curvature, rounding of 1e-16 / 1e-5
    np.testing.assert_allclose(rows.normal @ step, gaps[1] - gaps[0], rtol=0, atol=1e-9)


def test_joints_change_by_what_rows_say_along_the_line_between_both_faces():
    joined = SCENE.replace("1.02", "1.0").replace(
        "0.3\n[[blocks]]", "0.3\nnormal_stiffness = 1.0\n[[blocks]]", 1
    )
    contact, found, before, after = two_states(0, "vertices", 5, joined)
    found = found.take(found.is_joint)
    rows, book = contact.geometry.conserving(found, before, after), contact.record.book
    assert len(found) > 2
    gaps, slips = [], []
    for state in (before, after):
        surface = contact.partners.surface(state)
        places = [
            surface.at(edge, share)
            for edge, share in (
                (found.edge_a, found.parameter_a),
                (found.edge_b, found.parameter_b),
            )
        ]
        lengths = contact.partners.sides.length[:, None]
        unit = (surface.end - surface.start) / lengths
        line = unit[found.edge_b] - unit[found.edge_a]
        line /= np.hypot(*line.T)[:, None]
        apart = places[0] - places[1]
        gaps.append(apart[:, 0] * line[:, 1] - apart[:, 1] * line[:, 0])
        slips.append(-(apart * line).sum(axis=1))
        now = book.now(contact.geometry.faces(state, surface))
        np.testing.assert_allclose(now.gap, gaps[-1], rtol=0, atol=1e-14)
    step = after.deformation - before.deformation
    # rounding of lengths of about one, in some ten sums and products
    np.testing.assert_allclose(rows.normal @ step, gaps[1] - gaps[0], rtol=0, atol=1e-14)
    np.testing.assert_allclose(rows.tangent @ step, slips[1] - slips[0], rtol=0, atol=1e-14)


def test_forces_cancel_in_sum():
    contact, found, before, after = two_states(0, "vertices", 4)
    rows = contact.geometry.conserving(found, before, after)
    modes = contact.geometry.model.manifold.rigid_modes.tocsc()
    for part in (rows.normal, rows.tangent):
        for axis in (0, 1):
            shift = sum(modes[:, [3 * body + axis]] for body in (0, 1)).toarray().ravel()
            np.testing.assert_allclose(part @ shift, 0.0, rtol=0, atol=1e-14)
