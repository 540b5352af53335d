"""What pieces take over from the block that split: area, mass, motion, stress, energy, contacts."""

from dataclasses import replace

import numpy as np
import pytest

import nmm
from covers.approximation.own_rule import own_rule
from nmm.assembly.motion import initial_state, vertex_points
from nmm.splitting.cuts import pieces
from nmm.splitting.division import replaced
from nmm.stepping.prepare import prepare

BLOCK = """
title = "block"
plane = "stress"
thickness = 0.25
duration = "1 s"
[materials.rock]
young_modulus = "1 GPa"
poisson_ratio = 0.2
density = 8000
[[blocks]]
name = "block"
material = "rock"
vertices = [[0, 0], [2, 0], [2, 1], [0, 1]]
[inertia]
[contact]
[interfaces.any]
between = "any"
friction_angle = "30 deg"
[formulation]
"""
COVERS = {
    "block": {},
    "block of degree 2": {"functions": "monomials", "degree": 2},
    "triangles": {"type": "triangles", "size": 0.4, "degree": 1},
    "quads": {"type": "quads", "size": 0.3, "degree": 0},
}


def stepper_of(cover, scene=BLOCK, step=None):
    table = {"cover": cover, "integrator": {"type": "newmark", "step": step or 1e-3}}
    formulation = nmm.Formulation.model_validate(table)
    return prepare(nmm.parse_scene(scene, "scene"), formulation)


def moving(model, velocity, gradient):
    """A state whose velocity is linear in the place from the centroid on."""
    state = initial_state(model.manifold)
    manifold = model.manifold
    rule = own_rule(manifold)
    points = rule.points
    rows = manifold.rows(rule.owner, points)
    wanted = velocity + (points - manifold.body_centroid[0]) @ np.asarray(gradient).T
    matrix = rows.matrix(manifold.n_unknowns)
    found = np.linalg.lstsq(matrix.toarray(), wanted.ravel(), rcond=None)[0]
    return replace(state, velocity=found)


def split(stepper, state, angle, number=0):
    """Cut body ``number`` through its centroid at an angle (rad)."""
    setup = stepper.discretisation.setup
    regions = setup.geometry.regions
    polygon = regions.polygons.to_shapely()[number]
    middle = np.array(polygon.centroid.coords[0])
    found, parent = replaced(regions.polygons, {number: pieces(polygon, middle, [angle])})
    geometry = replace(setup.geometry, regions=regions.divided(found, parent))
    return stepper.reshape(geometry, state)


def motion_of(model, state):
    """Mass, centroid, velocity of it, spin and energy of each body: by moments of the mass."""
    modes, mass = model.manifold.rigid_modes, model.mass
    inertia = (modes.T @ (mass @ modes)).toarray()
    momentum = np.asarray(modes.T @ (mass @ state.velocity)).reshape(-1, 3)
    own = np.array(
        [inertia[3 * b : 3 * b + 3, 3 * b : 3 * b + 3].diagonal() for b in range(len(momentum))]
    )
    return own[:, 0], state.frames.centre, momentum / own, momentum


@pytest.mark.parametrize("cover", COVERS)
def test_pieces_of_a_spinning_block_go_on_as_its_points_did(cover):
    """2 x 1 m at (3, 1) m/s and 2 rad/s, cut at 50 degrees: rigid-body mechanics."""
    stepper = stepper_of(COVERS[cover]).stepper
    state = moving(stepper.model, [3, 1], [[0, -2], [2, 0]])
    change = split(stepper, state, np.radians(50))
    mass, centre, velocity, _ = motion_of(change.new, change.state)
    order = np.argsort(centre[:, 0])
    np.testing.assert_allclose(mass, 2000, rtol=1e-12)
    places = [[0.529337008, 0.5699249693], [1.470662992, 0.4300750307]]
    np.testing.assert_allclose(centre[order], places, atol=1e-9)
    fast = [[2.860150061, 0.05867401592, 2], [3.139849939, 1.941325984, 2]]
    np.testing.assert_allclose(velocity[order], fast, atol=1e-8)
    energy = change.state.velocity @ (change.new.mass @ change.state.velocity) / 2
    assert energy == pytest.approx(23333.33333333, rel=1e-10)


@pytest.mark.parametrize("cover", COVERS)
def test_momenta_and_energy_of_a_linear_velocity_stay_to_rounding(cover):
    """Gradient [[.3, -.2], [.5, -.1]]: energy 20235 J, of which no part is lost by the cut."""
    stepper = stepper_of(COVERS[cover]).stepper
    state = moving(stepper.model, [3, 1], [[0.3, -0.2], [0.5, -0.1]])
    old = stepper.model
    change = split(stepper, state, np.radians(50))
    mass, centre, velocity, momentum = motion_of(change.new, change.state)
    order = np.argsort(centre[:, 0])
    fast = [[2.844816109, 0.7576760071], [3.155183891, 1.242323993]]
    np.testing.assert_allclose(velocity[order, :2], fast, atol=1e-8)
    np.testing.assert_allclose(momentum[:, :2].sum(axis=0), [12000, 4000], rtol=1e-12)
    _, middle, _, whole = motion_of(old, state)
    arm = centre - middle
    spin = momentum[:, 2] + arm[:, 0] * momentum[:, 1] - arm[:, 1] * momentum[:, 0]
    assert spin.sum() == pytest.approx(whole[0, 2], rel=1e-11)
    assert spin.sum() == pytest.approx(733.3333333333, rel=1e-9)
    energy = change.state.velocity @ (change.new.mass @ change.state.velocity) / 2
    assert energy == pytest.approx(20235, rel=1e-10)
    assert mass.sum() == pytest.approx(4000, rel=1e-12)
    assert change.new.manifold.body_area.sum() == pytest.approx(2, rel=1e-12)


@pytest.mark.parametrize("cover", COVERS)
@pytest.mark.parametrize("turn", [0.0, 0.7])
def test_stress_and_strain_energy_of_a_turned_block_are_those_of_its_pieces(cover, turn):
    stepper = stepper_of(COVERS[cover]).stepper
    model = stepper.model
    stretched = moving(model, [0, 0], [[1e-4, 2e-5], [2e-5, -3e-5]])
    state = replace(
        stretched,
        deformation=stretched.velocity,
        velocity=np.zeros_like(stretched.velocity),
        frames=replace(stretched.frames, angle=np.array([turn])),
    )
    stress, energy = model.stress(state), model.strain_energy(state)
    change = split(stepper, state, 0.3)
    found = change.new.stress(change.state)
    np.testing.assert_allclose(found, np.broadcast_to(stress[0], found.shape), rtol=1e-8)
    assert change.new.strain_energy(change.state) == pytest.approx(energy, rel=1e-10)
    np.testing.assert_allclose(change.state.frames.angle, turn)
    # No point has moved: the pieces' outlines lie where the block's corners were.
    before = {tuple(np.round(p, 9)) for p in _places(model, state)}
    after = {tuple(np.round(p, 9)) for p in _places(change.new, change.state)}
    corners = [p for p in before if p in after]
    assert len(corners) >= 4


def _places(model, state):
    return vertex_points(model.manifold).place(state.frames, state.deformation)


FALL = BLOCK.replace('duration = "1 s"', 'duration = "0.1 s"').replace(
    "[inertia]", "[inertia]\n[gravity]"
)


def test_a_block_that_splits_in_flight_falls_as_one_that_does_not():
    """Middle of all at v t - g t^2 / 2, whatever became of the block."""
    strong = FALL + '[formulation.integrator]\ntype = "newmark"\nstep = "1 ms"\n'
    start = '[[initial_velocities]]\nblock = "all"\nvelocity = [3, 1]\nangular_velocity = 4\n'
    weak = "[splitting.rock]\ntensile_strength = 1.0\nsmallest_block = 0.2\nmost_blocks = 8\n"
    text = strong.replace("[inertia]", start + weak + "[inertia]")
    found = nmm.run(nmm.parse_scene(text, "scene"))
    assert found.manifold.n_bodies > 2
    area = found.manifold.body_area
    centre = area @ found.state.frames.centre / area.sum()
    assert area.sum() == pytest.approx(2, rel=1e-12)
    expected = [1 + 0.3, 0.5 + 0.1 - 9.81 * 0.1**2 / 2]
    np.testing.assert_allclose(centre, expected, atol=1e-10)
    model, v = found.stepper.model, found.state.velocity
    momentum = np.asarray(model.manifold.rigid_modes.T @ (model.mass @ v)).reshape(-1, 3)
    push = found.state.frames.to_global(np.arange(len(momentum)), momentum[:, :2]).sum(axis=0)
    np.testing.assert_allclose(push, [12000, 4000 - 4000 * 0.981], rtol=1e-11)
