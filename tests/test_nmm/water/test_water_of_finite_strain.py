"""Water in and on bodies that bend by any angle: closed forms of free and of confined ground."""

import numpy as np
import pytest
from scipy.optimize import brentq

import nmm
from nmm.assembly.moving.momenta import momenta
from nmm.effects.base import Instant
from nmm.errors import FormulationError
from nmm.formulation import parse_formulation
from nmm.scene.read import parse_scene
from nmm.stepping.prepare import prepare

COVERS = {
    "block": 'type = "block"\ndegree = 1',
    "quads": 'type = "quads"\nsize = 0.7\nangle = 0.2\ndegree = 0',
    "triangles": 'type = "triangles"\nsize = 0.6\ndegree = 1',
}
MODULUS, POISSON, PRESSURE = 1.0, 0.3, 0.1
SHEAR = MODULUS / 2 / (1 + POISSON)
LAME = MODULUS * POISSON / (1 + POISSON) / (1 - 2 * POISSON)
BODY = """
plane = "{plane}"
[materials.m]
young_modulus = 1.0
poisson_ratio = 0.3
density = 1.0
hydraulic_conductivity = 1.0
biot = {biot}
[[blocks]]
name = "soil"
material = "m"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
"""
# p = w (h - y), even to 1e-9 of it by the weight of this water.
PORES = f"""
[seepage]
unit_weight = 1e-10
{{coupled}}
[[heads]]
name = "pores"
block = "soil"
head = {PRESSURE * 1e10}
"""
AROUND = f'[[water_pressures]]\nname = "around"\nblock = "soil"\npressure = {PRESSURE}\n'
SIDES = {
    "left": ([[0, 0], [0, 1]], "x"),
    "right": ([[1, 0], [1, 1]], "x"),
    "low": ([[0, 0], [1, 0]], "y"),
}


def ground(biot=1.0, plane="strain", coupled=""):
    return BODY.format(biot=biot, plane=plane) + PORES.format(coupled=coupled)


def rollers(*sides):
    return "".join(
        f'[[supports]]\nname = "{side}"\nsegment = {SIDES[side][0]}\nfix = ["{SIDES[side][1]}"]\n'
        for side in sides
    )


def finite(cover, more=""):
    return parse_formulation(f'[cover]\n{COVERS[cover]}\n[rotation]\nupdate = "finite"\n{more}')


def run(scene, cover):
    found = nmm.run(parse_scene(scene), formulation=finite(cover))
    assert found.summary.status == "converged", found.summary.sentence
    return found


def sides(found):
    """How long the unit square has become along x and y."""
    return np.ptp(found.manifold.elements.points + found.displacement, axis=0)


@pytest.mark.parametrize("cover", COVERS)
@pytest.mark.parametrize("biot", [1.0, 0.4])
def test_pores_swell_a_free_block_until_its_law_bears_their_pressure(cover, biot):
    # S = 2 (lambda + mu) E = b p J / l^2 = b p, as J = l^2 in plane strain.
    found = run(ground(biot) + rollers("left", "low"), cover)
    wanted = np.sqrt(1 + biot * PRESSURE / (LAME + SHEAR))
    # heads are even to 1e-9, and steps end at 1e-10 of the forces
    np.testing.assert_allclose(sides(found), wanted, rtol=1e-8)
    # the effective stress bears b p: nothing is left in all
    stress = found.stepper.model.stress(found.state)
    stress = stress + found.stepper.plan.effects["seepage"].mean_stress(found.state)
    np.testing.assert_allclose(stress, 0.0, atol=1e-8)


def test_confined_ground_swells_by_the_volume_that_it_gains():
    # S_yy = (lambda + 2 mu) (l^2 - 1) / 2 = p J / l^2 = p / l: not p, as of a stress that is given.
    scene = parse_scene(ground() + rollers("left", "right", "low"))
    found = nmm.run(scene, formulation=finite("quads", '[supports]\nmethod = "lagrange"\n'))
    assert found.summary.status == "converged", found.summary.sentence
    oedometer = LAME + 2 * SHEAR
    wanted = brentq(lambda h: oedometer * (h**2 - 1) / 2 - PRESSURE / h, 1, 2, xtol=1e-15)
    np.testing.assert_allclose(sides(found)[1], wanted, rtol=1e-8)
    assert abs(np.sqrt(1 + 2 * PRESSURE / oedometer) / wanted - 1) > 2e-3


@pytest.mark.parametrize("cover", ["block", "quads"])
def test_a_block_under_water_spins_as_if_there_were_none(cover):
    # Pressure p around and in the pores: no stress of grains, no force, no moment, at any angle.
    spin = '[[initial_velocities]]\nblock = "soil"\nvelocity = [0, 0]\nangular_velocity = 0.5\n'
    text = '[integrator]\ntype = "energy_momentum"\nstep = 0.1\n'
    places, kept = [], []
    for water in ("", PORES.format(coupled="") + AROUND):
        scene = "duration = 4.0\n" + BODY.format(biot=1.0, plane="strain") + water
        made = prepare(parse_scene(scene + spin + "[inertia]\n"), finite(cover, text))
        stepper, state, moments = made.stepper, made.start, []
        for _ in range(40):  # two radians
            attempt = stepper.attempt(state, Instant(state.time + 0.1, 1.0), 0.1)
            assert attempt.converged
            state = stepper.accept(attempt)[0]
            moments.append((momenta(stepper.model, state.deformation) @ state.velocity)[2])
        places.append(state.deformation)
        kept.append(np.ptp(moments))
    assert np.abs(places[0]).max() > 0.5
    # 40 steps that end at 1e-13 of forces of some 0.1, and heads even to 1e-9 of the pressure
    np.testing.assert_allclose(places[1], places[0], atol=1e-7)
    assert max(kept) < 1e-9


def test_water_presses_across_an_edge_where_it_has_bent_to():
    scene = parse_scene(
        BODY.format(biot=1.0, plane="strain").replace(
            "[[0, 0], [1, 0], [1, 1], [0, 1]]", "[[0, 0], [10, 0], [10, 1], [0, 1]]"
        )
        + '[[supports]]\nname = "root"\nsegment = [[0, 0], [0, 1]]\nfix = ["x", "y"]\n'
        + '[[water_pressures]]\nname = "top"\nsegment = [[0, 1], [10, 1]]\npressure = 3e-4\n'
    )
    found = nmm.run(scene, formulation=finite("triangles", "[loading]\nincrement = 0.25\n"))
    assert found.summary.status == "converged", found.summary.sentence
    points = found.manifold.elements.points
    place = points + found.displacement
    ends = [place[np.argmin(np.hypot(*(points - end).T))] for end in ([0, 1], [10, 1])]
    chord = ends[1] - ends[0]
    # A surface between two ends bears the even pressure times its chord, turned (divergence).
    force = [found.history[f"water pressures:top:{axis}"][-1] for axis in "xy"]
    assert chord[1] < -1.5
    np.testing.assert_allclose(force, 3e-4 * np.array([chord[1], -chord[0]]), atol=1e-12)


@pytest.mark.parametrize(
    "keys",
    [
        {"plane": "stress"},
        {"coupled": "coupled = true\ntransient = true\ninitial = 1.0\nduration = 1.0"},
    ],
)
def test_water_that_cannot_follow_is_refused_under_finite_strain(keys):
    scene = ground(**keys) + rollers("left", "low")
    scene = scene.replace("biot =", "specific_storage = 1.0\nbiot =")
    formulation = finite("quads", '[supports]\nmethod = "penalty"\n')
    with pytest.raises(FormulationError, match="finite"):
        nmm.run(parse_scene(scene), formulation=formulation)
