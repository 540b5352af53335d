"""Bodies judged by their elements split where the bending stress of a beam is largest."""

from types import SimpleNamespace

import numpy as np
import pytest

import nmm
from nmm.assembly.momenta import momenta_about, rigid_momenta
from nmm.assembly.state import initial_state
from nmm.stepping.prepare import prepare
from nmm.verification.problems.splitting.pieces import moving

LENGTH, HEIGHT, STRENGTH = 1.0, 0.1, 2e6
BEAM = """
title = "beam"
plane = "stress"
duration = 1e-3
[inertia]
[materials.rock]
young_modulus = "10 GPa"
poisson_ratio = 0
density = 2400
[contact]
[interfaces.any]
between = "any"
friction_angle = "20 deg"
[splitting.rock]
tensile_strength = 2e6
smallest_block = "5 mm"
judged_at = "elements"
[[blocks]]
name = "beam"
material = "rock"
vertices = {corners}
[formulation.integrator]
type = "newmark"
step = 1e-5
[formulation.cover]
type = "{kind}"
degree = 0
size = {size}
"""


def stress_of(moment, points):
    """Axial stress M(x) (y - h/2) / I at points (m) of a beam of unit thickness (Pa)."""
    found = np.zeros((len(points), 3))
    x, y = points.T
    found[:, 0] = -moment(x) * (y - HEIGHT / 2) * 12 / HEIGHT**3
    return found


def three_points(x):
    return np.minimum(x, LENGTH - x)


def cantilever(x):
    return x - LENGTH  # tension at the top


def beam(moment, share, kind, size, turn):
    """A turned beam whose cells of most tension use a share of the strength.

    Stepper, middles of the cells along and across it, and their stresses.
    """
    c, s = np.cos(turn), np.sin(turn)
    rotate = np.array([[c, -s], [s, c]])
    corners = np.array([[0, 0], [LENGTH, 0], [LENGTH, HEIGHT], [0, HEIGHT]]) @ rotate.T
    text = BEAM.format(corners=corners.tolist(), kind=kind, size=size)
    scene = nmm.parse_scene(text, "scene")
    stepper = prepare(scene, scene.formulation).stepper
    cells = stepper.model.manifold.elements.centroids @ rotate
    own = stress_of(moment, cells)
    own *= share * STRENGTH / own[:, 0].max()
    full = own[:, [0, 2, 2, 1]].reshape(-1, 2, 2)
    full = rotate @ full @ rotate.T
    return stepper, cells, full[:, [0, 1, 0], [0, 1, 1]]


def pieces_of(moment, share, kind="quads", size=0.02, turn=0.0):
    """Areas of the pieces in order along the beam, where it is cut, and the middles of cells."""
    stepper, cells, stress = beam(moment, share, kind, size, turn)
    c, s = np.cos(turn), np.sin(turn)
    rotate = np.array([[c, -s], [s, c]])
    view = SimpleNamespace(stress=stress, state=initial_state(stepper.model.manifold))
    event = stepper.plan.effects["splitting"].event(view)
    if event is None:
        return None, None, cells
    shapes = event.geometry.regions.polygons.to_shapely()
    places = [np.array(one.centroid.coords)[0] @ rotate for one in shapes]
    areas = np.array([one.area for one in shapes])
    order = np.argsort([place[0] for place in places])
    return areas[order], areas[order][0] / HEIGHT, cells


@pytest.mark.parametrize(("kind", "turn"), [("quads", 0.0), ("triangles", 0.0), ("quads", 0.6)])
def test_a_beam_under_three_points_splits_at_midspan(kind, turn):
    areas, cut, cells = pieces_of(three_points, 1.001, kind, turn=turn)
    outer = cells[np.argmax(stress_of(three_points, cells)[:, 0])]
    # Straight through that cell, or its mirror image.
    assert abs(cut - LENGTH / 2) == pytest.approx(abs(outer[0] - LENGTH / 2), abs=1e-9)
    assert abs(cut - LENGTH / 2) < 0.02  # a cell
    assert areas.sum() == pytest.approx(LENGTH * HEIGHT, rel=1e-12)


def test_a_cantilever_splits_at_the_built_in_end():
    areas, cut, _ = pieces_of(cantilever, 1.001)
    assert 0 < cut < 0.02  # the first cell
    assert areas.sum() == pytest.approx(LENGTH * HEIGHT, rel=1e-12)


def test_a_beam_below_its_strength_stays_whole():
    assert pieces_of(three_points, 0.999)[0] is None


def test_as_much_stress_everywhere_splits_at_the_middle():
    *_, cells = found = pieces_of(lambda x: np.ones_like(x), 1.001)
    nearest = np.abs(cells[:, 0] - LENGTH / 2).min()
    assert abs(found[1] - LENGTH / 2) == pytest.approx(nearest, abs=1e-9)


def test_pieces_of_a_beam_in_flight_keep_its_momentum():
    stepper, _, stress = beam(cantilever, 1.001, "quads", 0.05, 0.6)
    state = moving(stepper.model, [3.0, 1.0], [[0.3, -2.0], [2.0, -0.1]])
    event = stepper.plan.effects["splitting"].event(SimpleNamespace(stress=stress, state=state))
    about = state.frames.centre[0]
    push, spin = momenta_about(state, rigid_momenta(stepper.model, state), about)
    change = stepper.reshape(event.geometry, state)
    pushes, spins = momenta_about(change.state, rigid_momenta(change.new, change.state), about)
    assert len(pushes) == 2
    np.testing.assert_allclose(pushes.sum(axis=0), push[0], rtol=1e-12)
    assert spins.sum() == pytest.approx(spin.sum(), rel=1e-11)
