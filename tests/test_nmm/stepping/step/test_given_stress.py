"""Stress of the start and of heat in bodies that bend by any angle, beside closed forms."""

import numpy as np
import pytest

import nmm
from nmm.assembly.moving.momenta import momenta
from nmm.effects.base import Instant
from nmm.formulation import parse_formulation
from nmm.scene.read import parse_scene
from nmm.stepping.prepare import prepare

COVERS = {
    "block": 'type = "block"\ndegree = 1',
    "quads": 'type = "quads"\nsize = 0.7\nangle = 0.2\ndegree = 0',
    "triangles": 'type = "triangles"\nsize = 0.6\ndegree = 1',
}
POISSON = 0.3
BODY = """
plane = "strain"
[materials.m]
law = "{law}"
young_modulus = 1.0
poisson_ratio = 0.3
density = 1.0
{more}
[[blocks]]
name = "bar"
material = "m"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
"""
STRESSED = '[[initial_stresses]]\nblock = "bar"\nstress = {stress}\n'
HEATED = """
[heat]
[[temperatures]]
name = "t"
block = "bar"
temperature = {rise}
"""
EXPANDING = "thermal_expansion = 1e-3\nconductivity = 1.0\n"


def rollers(*sides):
    ends = {
        "left": ([[0, 0], [0, 1]], "x"),
        "right": ([[1, 0], [1, 1]], "x"),
        "low": ([[0, 0], [1, 0]], "y"),
        "top": ([[0, 1], [1, 1]], "y"),
    }
    return "".join(
        f'[[supports]]\nname = "{side}"\nsegment = {ends[side][0]}\nfix = ["{ends[side][1]}"]\n'
        for side in sides
    )


def run(scene, cover):
    text = f'[cover]\n{COVERS[cover]}\n[rotation]\nupdate = "finite"\n'
    found = nmm.run(parse_scene(scene), formulation=parse_formulation(text))
    assert found.summary.status == "converged", found.summary.sentence
    return found


def stretches(found):
    """How much longer than the unit square a body is along x and y."""
    elements = found.manifold.elements
    vertices = elements.points + found.displacement
    return np.ptp(vertices, axis=0)


@pytest.mark.parametrize("cover", COVERS)
@pytest.mark.parametrize("stress", [0.3, -0.2])
def test_a_stress_of_the_start_is_let_go_as_strain(cover, stress):
    # S + S0 = 0 of a free body, in plane strain: E_x = -s (1 - nu^2) / E, E_y = s nu (1 + nu) / E.
    scene = BODY.format(law="elastic", more="") + rollers("left", "low")
    found = run(scene + STRESSED.format(stress=[stress, 0.0, 0.0]), cover)
    green = -stress * (1 - POISSON**2), stress * POISSON * (1 + POISSON)
    # supports are springs, which carry nothing at the end
    np.testing.assert_allclose(stretches(found), np.sqrt(1 + 2 * np.array(green)), rtol=1e-8)


@pytest.mark.parametrize("cover", COVERS)
def test_what_is_heated_and_free_expands_without_stress(cover):
    scene = BODY.format(law="elastic", more=EXPANDING) + rollers("left", "low")
    found = run(scene + HEATED.format(rise=150.0), cover)
    wanted = np.sqrt(1 + 2 * (1 + POISSON) * 1e-3 * 150.0)
    np.testing.assert_allclose(stretches(found), wanted, rtol=1e-8)
    stress = found.stepper.model.stress(found.state)
    stress = stress + found.stepper.plan.effects["heat"].mean_stress(found.state)
    np.testing.assert_allclose(stress, 0.0, atol=1e-8)


def test_what_is_heated_and_held_bears_the_stress_of_heat():
    scene = BODY.format(law="elastic", more=EXPANDING)
    found = run(scene + rollers("left", "right", "low", "top") + HEATED.format(rise=150.0), "quads")
    stress = found.stepper.model.stress(found.state)
    stress = stress + found.stepper.plan.effects["heat"].mean_stress(found.state)
    wanted = -0.15 / (1 - 2 * POISSON)
    # springs of supports give way by a share of E over theirs
    np.testing.assert_allclose(stress[:, :2], wanted, rtol=3e-2)


@pytest.mark.parametrize("cover", ["block", "quads"])
def test_a_stressed_body_that_spins_keeps_energy_and_angular_momentum(cover):
    scene = BODY.format(law="elastic", more="") + STRESSED.format(stress=[0.2, -0.1, 0.05])
    spin = '[[initial_velocities]]\nblock = "bar"\nvelocity = [0, 0]\nangular_velocity = 1.0\n'
    text = (
        f'[cover]\n{COVERS[cover]}\n[rotation]\nupdate = "finite"\n'
        '[integrator]\ntype = "energy_momentum"\nstep = 0.1\n'
    )
    made = prepare(
        parse_scene("duration = 4.0\n" + scene + spin + "[inertia]\n"),
        parse_formulation(text),
    )
    stepper, state = made.stepper, made.start
    model, plan, energies, spins = stepper.model, stepper.plan, [], []
    for _ in range(40):
        kinds = [plan.energy(name, state) for name in ("inertia", "initial stress")]
        energies.append(sum(kinds) + model.strain_energy(state))
        spins.append((momenta(model, state.deformation) @ state.velocity)[2])
        attempt = stepper.attempt(state, Instant(state.time + 0.1, 1.0), 0.1)
        assert attempt.converged, attempt.sentence
        state, _ = stepper.accept(attempt)
    assert np.ptp(energies) < 1e-11 * energies[0]
    assert np.ptp(spins) < 1e-11 * abs(spins[0])


def test_a_body_that_is_heated_as_it_spins_gains_the_work_of_heat_and_no_spin():
    scene = "duration = 4.0\n" + BODY.format(law="elastic", more=EXPANDING)
    scene += HEATED.format(rise=100.0) + "history = [[0, 0], [2, 1], [4, 0.5]]\n[inertia]\n"
    scene += '[[initial_velocities]]\nblock = "bar"\nvelocity = [0, 0]\nangular_velocity = 1.0\n'
    rule = 'type = "energy_momentum"\nstep = 0.1\n'
    text = f'[cover]\n{COVERS["quads"]}\n[rotation]\nupdate = "finite"\n[integrator]\n{rule}'
    found = nmm.run(parse_scene(scene), formulation=parse_formulation(text))
    audits = found.summary.audits
    assert found.summary.status == "converged", found.summary.sentence
    # what the work of heat misses of energy, of which a step is found to 1e-13
    assert audits["energy_made_in_run"] < 1e-10
    spin = (momenta(found.stepper.model, found.state.deformation) @ found.state.velocity)[2]
    assert spin == pytest.approx(1 / 6, rel=1e-10)
