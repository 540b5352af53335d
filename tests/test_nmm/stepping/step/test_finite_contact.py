"""Bodies of finite strain that meet: energy, angular momentum, and what friction takes."""

import numpy as np
import pytest

from nmm.assembly.moving.momenta import momenta
from nmm.effects.base import Instant
from nmm.errors import FormulationError
from nmm.formulation import parse_formulation
from nmm.scene.read import parse_scene
from nmm.stepping.prepare import prepare

MATTER = """
plane = "strain"
duration = 1.0
[inertia]
[contact]
[materials.m]
young_modulus = {modulus}
poisson_ratio = 0.3
density = 1.0
[interfaces.s]
friction_angle = {angle}
"""
# A spinning square aslant that flies into another at rest.
COLLISION = (
    MATTER
    + """
[[blocks]]
name = "a"
material = "m"
vertices = [[-0.6552, -0.2658], [0.2658, -0.6552], [0.6552, 0.2658], [-0.2658, 0.6552]]
[[blocks]]
name = "b"
material = "m"
vertices = [[0.75, -0.2], [1.75, -0.2], [1.75, 0.8], [0.75, 0.8]]
[[initial_velocities]]
block = "a"
velocity = [1.0, 0.0]
angular_velocity = 0.5
"""
)
ASLANT = 2 * (0.6552**2 + 0.2658**2)  # kg, its mass and the square of its side
# A square that flies into another one face on, a third of a face beside it.
FACE_ON = (
    MATTER
    + """
[[blocks]]
name = "a"
material = "m"
vertices = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]]
[[blocks]]
name = "b"
material = "m"
vertices = [[0.52, -0.2], [1.52, -0.2], [1.52, 0.8], [0.52, 0.8]]
[[initial_velocities]]
block = "a"
velocity = [1.0, 0.0]
"""
)
# A block that rattles and spins in a frame, one cover each.
RATTLE = (
    MATTER
    + """
[[blocks]]
name = "frame"
material = "m"
vertices = [[-1.5, -1.5], [1.5, -1.5], [1.5, 1.5], [-1.5, 1.5]]
holes = [[[-1, -1], [1, -1], [1, 1], [-1, 1]]]
[[blocks]]
name = "block"
material = "m"
vertices = [[-0.4, -0.3], [0.4, -0.3], [0.4, 0.3], [-0.4, 0.3]]
[[initial_velocities]]
block = "block"
velocity = [2.0, 0.7]
angular_velocity = 3.0
"""
)
QUADS, BLOCKS = 'type = "quads"\nsize = 0.7\ndegree = 0', 'type = "block"\ndegree = 1'


def flight(scene, cover, steps, step=0.01, enforcement="penalty"):
    """Energies (J), angular momenta about the origin, and in how many steps bodies pressed."""
    text = (
        f'[cover]\n{cover}\n[rotation]\nupdate = "finite"\n'
        f'[contact]\nenforcement = "{enforcement}"\n'
        f'[integrator]\ntype = "energy_momentum"\nstep = {step}\n'
    )
    made = prepare(parse_scene(scene), parse_formulation(text))
    stepper, state = made.stepper, made.start
    model, plan = stepper.model, stepper.plan
    energies, spins, pressed = [], [], 0
    for _ in range(steps):
        attempt = stepper.attempt(state, Instant(state.time + step, 1.0), step)
        assert attempt.converged, attempt.sentence
        pressed += len(attempt.solved.pushing) > 0
        state, _ = stepper.accept(attempt)
        kinetic, stored = plan.energy("inertia", state), model.strain_energy(state)
        energies.append(kinetic + stored + plan.contact.energy(state))
        moved = (momenta(model, state.deformation) @ state.velocity).reshape(-1, 3)
        x, y = state.frames.centre.T
        spins.append(float((moved[:, 2] + x * moved[:, 1] - y * moved[:, 0]).sum()))
    return np.array(energies), np.array(spins), pressed


@pytest.mark.parametrize("step", [0.01, 0.03])
def test_a_collision_of_spinning_bodies_keeps_energy_and_angular_momentum(step):
    scene = COLLISION.format(modulus=100.0, angle=0.0)
    energies, spins, pressed = flight(scene, QUADS, round(0.7 / step), step)
    assert pressed > 3
    # each step is found to 1e-13 of its forces
    assert np.ptp(energies) < 1e-11 * energies[0]
    assert np.ptp(spins) < 1e-11 * abs(spins[0])


@pytest.mark.parametrize("step", [pytest.param(0.002, marks=pytest.mark.slow), 0.01])
@pytest.mark.parametrize(
    ("scene", "energy", "spin"),
    # m v^2 / 2, and the turn about an own centre that flies through the origin, m^2 omega / 6.
    [(FACE_ON, 0.5, 0.0), (COLLISION, ASLANT / 2 + ASLANT**2 / 48, ASLANT**2 / 12)],
)
def test_corners_that_leave_edges_or_become_one_take_no_energy(scene, energy, spin, step):
    net, steps = QUADS.replace("0.7", "0.35"), round(0.6 / step)
    energies, spins, pressed = flight(scene.format(modulus=100.0, angle=0.0), net, steps, step)
    assert pressed > 15
    parted = 113 if (scene, step) == (FACE_ON, 0.002) else steps
    # Each step is found to 1e-13 of its forces, up to 300 of them.
    np.testing.assert_allclose(energies[:parted], energy, rtol=1e-11)
    np.testing.assert_allclose(spins, spin, atol=1e-11)
    # Where the last corner of two bodies leaves its edge nothing is left to take up its spring.
    np.testing.assert_allclose(energies, energy, rtol=2e-5)


def test_friction_takes_energy_in_every_step_and_no_angular_momentum():
    scene = COLLISION.format(modulus=100.0, angle=0.4)
    energies, spins, pressed = flight(scene, QUADS, 55)
    assert pressed > 5
    assert np.diff(energies).max() < 1e-12 * energies[0]
    assert energies[-1] < (1 - 1e-3) * energies[0]
    assert np.ptp(spins) < 1e-11 * abs(spins[0])


def test_exact_contact_makes_no_energy_and_keeps_angular_momentum():
    scene = COLLISION.format(modulus=100.0, angle=0.0)
    energies, spins, pressed = flight(scene, QUADS, 45, enforcement="lagrange")
    assert pressed > 5
    assert np.diff(energies).max() < 1e-12 * energies[0]
    # what closes without a spring loses the speed at which it does
    assert energies[-1] > 0.97 * energies[0]
    assert np.ptp(spins) < 1e-11 * abs(spins[0])


def test_bodies_of_functions_that_depend_on_one_another_keep_them_to_their_tolerance():
    scene = COLLISION.format(modulus=100.0, angle=0.0)
    energies, spins, pressed = flight(scene, QUADS.replace("degree = 0", "degree = 1"), 50)
    assert pressed > 3
    # contact of such functions is solved to 1e-9 of its forces
    assert np.ptp(energies) < 1e-7 * energies[0]
    assert np.ptp(spins) < 1e-7 * abs(spins[0])


def test_impacts_one_after_another_keep_energy_and_angular_momentum():
    energies, spins, pressed = flight(RATTLE.format(modulus=1000.0, angle=0.0), BLOCKS, 60)
    assert pressed > 3
    assert np.ptp(energies) < 1e-10 * energies[0]
    assert np.ptp(spins) < 1e-10 * abs(spins[0])


@pytest.mark.slow
def test_thousands_of_steps_of_impacts_keep_energy_and_angular_momentum():
    energies, spins, pressed = flight(RATTLE.format(modulus=1000.0, angle=0.0), BLOCKS, 3000)
    assert pressed > 100
    assert np.ptp(energies) < 1e-8 * energies[0]
    assert np.ptp(spins) < 1e-10 * abs(spins[0])


@pytest.mark.parametrize(("enforcement", "refused"), [("penalty", True), ("lagrange", False)])
def test_springs_over_faces_under_a_rule_that_keeps_energy_are_refused(enforcement, refused):
    scene = parse_scene(COLLISION.format(modulus=1e3, angle=0.0).replace("1.0\n[in", "0.002\n[in"))
    formulation = parse_formulation(
        f'[contact]\nenforcement = "{enforcement}"\npoints = "faces"\n'
        '[cover]\ntype = "quads"\nsize = 0.6\ndegree = 0\n'
        '[rotation]\nupdate = "finite"\n[integrator]\ntype = "energy_momentum"\nstep = 0.002\n'
    )
    if not refused:
        prepare(scene, formulation)
        return
    with pytest.raises(FormulationError, match=':3: contact.points: "faces".*"vertices" or "auto"'):
        prepare(scene, formulation)
