"""Bodies judged by their elements split where the bending stress of a beam is largest."""

from types import SimpleNamespace

import numpy as np
import pytest

import nmm
from nmm.assembly.moving.momenta import momenta_about, rigid_momenta
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
smallest_block = {smallest}
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


def beam(moment, share, kind, size, turn, smallest=0.005):
    """A turned beam whose cells of most tension use a share of the strength.

    Stepper, middles of the cells along and across it, and their stresses.
    """
    c, s = np.cos(turn), np.sin(turn)
    rotate = np.array([[c, -s], [s, c]])
    corners = np.array([[0, 0], [LENGTH, 0], [LENGTH, HEIGHT], [0, HEIGHT]]) @ rotate.T
    text = BEAM.format(corners=corners.tolist(), kind=kind, size=size, smallest=smallest)
    scene = nmm.parse_scene(text, "scene")
    stepper = prepare(scene, scene.formulation).stepper
    cells = stepper.model.manifold.elements.centroids @ rotate
    own = stress_of(moment, cells)
    own *= share * STRENGTH / own[:, 0].max()
    full = own[:, [0, 2, 2, 1]].reshape(-1, 2, 2)
    full = rotate @ full @ rotate.T
    return stepper, cells, full[:, [0, 1, 0], [0, 1, 1]]


def pieces_of(moment, share, kind="quads", size=0.02, turn=0.0, smallest=0.005):
    """Areas of the pieces in order along the beam, where it is cut, and the middles of cells."""
    stepper, cells, stress = beam(moment, share, kind, size, turn, smallest)
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


@pytest.mark.parametrize("turn", [0.0, np.pi / 2, np.pi])
@pytest.mark.parametrize("wall", [0, LENGTH])
def test_where_a_piece_would_be_too_small_the_next_stressed_cell_is_cut(turn, wall):
    """Strips of 0.05 m are 33 mm wide: cells at 0.05 m, which bear 0.95 / 0.99 of the first."""

    def moment(x):
        return -np.abs(LENGTH - wall - x)

    first = 0.99 / 0.95
    assert pieces_of(moment, 0.999 * first, turn=turn, smallest=0.05)[0] is None
    areas, *_ = pieces_of(moment, 1.001 * first, turn=turn, smallest=0.05)
    np.testing.assert_allclose(np.sort(areas), [0.05 * HEIGHT, 0.95 * HEIGHT], rtol=1e-9)


LINE = """
title = "cantilever"
plane = "stress"
[materials.rock]
young_modulus = "10 GPa"
poisson_ratio = 0
[contact]
[interfaces.any]
between = "any"
friction_angle = "20 deg"
[splitting.rock]
tensile_strength = "2 MPa"
smallest_block = {smallest}
judged_at = "elements"
[[blocks]]
name = "beam"
material = "rock"
vertices = {corners}
[[supports]]
name = "wall"
segment = [[0, 0], [0, 0.5]]
fix = ["x", "y"]
[[loads]]
name = "line"
kind = "edge"
segment = [[0, 0.5], [{end}, 0.5]]
traction = [0, -1e4]
[loading]
until = {until}
[formulation.loading]
increment = 2.0
tolerance = 1e-3
[formulation.cover]
type = "quads"
degree = 0
size = 0.05
"""


def cantilever_of(end, smallest=0.05, until='"failure"'):
    """A run of a beam 0.5 m deep from a wall to ``end`` (m) under 10 kN/m."""
    corners = [[0, 0], [end, 0], [end, 0.5], [0, 0.5]]
    text = LINE.format(corners=corners, end=end, smallest=smallest, until=until)
    return nmm.run(nmm.parse_scene(text, "scene"))


@pytest.mark.parametrize("end", [2.0, -2.0])
def test_a_cantilever_fails_where_bending_parts_the_first_piece_that_is_large_enough(end):
    """In the second cell from the wall, which has the mean stress of depths 0.2 to 0.25 m."""
    arm, lever, inertia = 2.0 - 0.075, 0.225, 0.5**3 / 12
    expected = 2e6 * inertia / lever / (1e4 * arm**2 / 2)
    found = cantilever_of(end)
    assert found.summary.status == "failure_load", found.summary.sentence
    # The wall keeps its section plane, which shear would warp.
    assert found.summary.failure_factor == pytest.approx(expected, rel=0.03)


def test_a_beam_that_no_piece_may_leave_is_told_with_how_far_it_is_beyond_its_strength():
    """Pieces of a beam 0.5 m deep have a size of 0.8 m if they are 2 m long, as all of it is."""
    found = cantilever_of(2.0, smallest=0.8, until=10.0)
    arm, lever, inertia = 2.0 - 0.025, 0.225, 0.5**3 / 12
    expected = 1e5 * arm**2 / 2 * lever / inertia / 2e6
    assert found.summary.audits["kept_whole"] == pytest.approx(expected, rel=0.1)
    assert found.history["splitting:kept_use"][-1] == found.summary.audits["kept_whole"]
    assert any("keeps whole 1 block beyond" in one for one in found.summary.warnings)


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
