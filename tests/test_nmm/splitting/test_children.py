"""What pieces take over from the block that split: area, mass, motion, stress, energy, contacts."""

from dataclasses import replace

import numpy as np
import pytest

import nmm
from nmm.assembly.material_points import vertex_points
from nmm.assembly.moving.momenta import whole_momentum
from nmm.effects.inertia import Inertia
from nmm.stepping.prepare import prepare
from nmm.verification.problems.splitting.pieces import flying_block, moving, split

BLOCK = flying_block()
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


@pytest.mark.parametrize("cover", COVERS)
def test_a_stretched_block_that_spins_keeps_its_angular_momentum_and_energy_as_it_splits(cover):
    """Spin ``L / J0``, energy ``L^2 / (2 J)`` with ``J`` of the strained place, before and after.

    Pieces have the momenta of the material: strained arms, and a spin of ``L / J``.
    """
    stepper = stepper_of(COVERS[cover]).stepper
    model, spin = stepper.model, 20.0
    strain = np.array([4e-5, -1e-5])
    stretched = moving(model, [0, 0], np.diag(strain)).velocity
    state = replace(moving(model, [3, 1], [[0, -spin], [spin, 0]]), deformation=stretched)
    middle, laid = state.frames.centre[0], 4000 * (2**2 + 1**2) / 12
    change = split(stepper, state, 0.6)
    *push, angular = whole_momentum(change.new, change.state, middle)
    np.testing.assert_allclose(push, [12000, 4000], rtol=1e-12)
    assert angular == pytest.approx(laid * spin, rel=1e-12)
    strained = 4000 * np.sum((1 + strain) ** 2 * np.array([2**2, 1**2])) / 12
    moved = 4000 * (3**2 + 1**2) / 2
    energy = (laid * spin) ** 2 / (2 * strained) + moved
    # To first order in the strain, as the energy of rotation is.
    found = Inertia(change.new).energy(change.state)
    assert found == pytest.approx(energy, abs=laid * spin**2 * 10 * strain.max() ** 2)
