"""Dead loads do on bodies that turn in a step the work of their forces."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from nmm.assembly.moving.motion import rigid_rates
from nmm.formulation import parse_formulation
from nmm.scene import parse_scene
from nmm.stepping.run import run
from nmm.verification import text

MASS, INERTIA, TIME = 1000.0, 1000.0 / 6, 0.2
STIFF, SOFT = 1e12, 1e7
RULES = ["newmark", "shi", "generalized_alpha"]
COVERS = {"block": 'type = "block"', "quads": 'type = "quads"\nsize = 0.5\ndegree = 0'}
SIDE = np.array([(0.5, -0.5), (0.5, 0.5)])


def pushed(name, point, force):
    """A dead force at a point."""
    acts = f"point = {point}\nforce = [0, {force!r}]"
    return f'[[loads]]\nname = "{name}"\nkind = "point"\n{acts}\n'


def couple(force):
    """Two of them at opposite corners, of moment ``F 2^(1/2) cos(theta + pi / 4)``."""
    return pushed("up", [0.5, 0.5], force) + pushed("down", [-0.5, -0.5], -force)


def sheared(force):
    """The same of opposite edges, of moment ``F cos(theta)``."""
    right, left = ((0.0, sign * force) for sign in (1, -1))
    return text.pulled_edge("right", SIDE, right) + text.pulled_edge("left", -SIDE, left)


def turned(loads, modulus=STIFF, rule="newmark", step=2e-3, cover="block"):
    """A free square of 1 m under loads for 0.2 s."""
    tables = [
        text.material("rock", modulus=modulus, density=MASS, poisson=0.0),
        text.block("square", "rock", text.rectangle((-0.5, -0.5), (0.5, 0.5))),
        loads,
        text.monitor("corner", (0.5, 0.5), "square"),
    ]
    scene = text.scene(f'plane = "stress"\nduration = {TIME!r}\n[inertia]\n', tables)
    form = f'[integrator]\ntype = "{rule}"\nstep = {step!r}\n'
    return run(parse_scene(scene), parse_formulation(f"[cover]\n{COVERS[cover]}\n{form}"))


def swung(amplitude, phase):
    """Angle at the end of ``J theta'' = amplitude cos(theta + phase)`` from rest."""

    def rates(time, now):
        return now[1], amplitude * np.cos(now[0] + phase) / INERTIA

    found = solve_ivp(rates, (0.0, TIME), (0.0, 0.0), method="DOP853", rtol=1e-12, atol=1e-14)
    return found.y[0, -1]


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("cover", COVERS)
@pytest.mark.parametrize(
    ("loads", "amplitude", "phase"),
    [(couple(2e4), 2e4 * np.sqrt(2), np.pi / 4), (sheared(2e4), 2e4, 0.0)],
    ids=["points", "edges"],
)
def test_a_rigid_square_swings_under_a_dead_couple_to_second_order(
    loads, amplitude, phase, cover, rule
):
    right = swung(amplitude, phase)
    wrong = [
        abs(turned(loads, rule=rule, cover=cover, step=step).state.frames.angle[0] - right)
        for step in (4e-3, 2e-3)
    ]
    # 2.4e-2 and 1.2e-2 with forces at the start of a step; strains of rock are 1e-8.
    assert wrong[0] < 2e-4
    assert wrong[1] < 0.3 * wrong[0] + 1e-7


@pytest.mark.parametrize("rule", RULES)
def test_a_soft_square_spun_up_by_dead_loads_keeps_its_energy(rule):
    """Strained by a tenth, at 40 rad/s in steps of 2 ms: 25 % of the turnover came from nowhere."""
    found = turned(couple(2e5), SOFT, rule)
    made = found.summary.audits["energy_made_in_run"]
    # Of second order in the step, 1.5e-3 and 2e-4 in 0.5 ms: the spin changes by 3 rad/s in one.
    assert made < 2e-3, made


@pytest.mark.parametrize("cover", COVERS)
def test_a_soft_square_gains_the_moment_about_its_strained_arms(cover):
    """``dL / dt`` is twice that of one force, of which monitors know the arm."""
    found = turned(couple(2e5), SOFT, step=5e-4, cover=cover)
    arms = 0.5 + np.append(0.0, found.history["monitor:corner:ux"])
    gained = 2 * 2e5 * np.sum(arms[1:] + arms[:-1]) / 2 * 5e-4
    momentum = INERTIA * rigid_rates(found.stepper.model, found.state)[0, 2]
    # Strains of a twentieth change arms by as much; of second order in the step, 1.4e-3 in 2 ms.
    assert momentum == pytest.approx(gained, rel=2e-4)


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("cover", COVERS)
def test_a_dead_load_beside_the_centroid_gives_its_impulse_along_itself(cover, rule):
    """``m v = F T``, however the square turns meanwhile: by 1.4 rad, up to 0.05 rad a step."""
    found = turned(pushed("up", [0.5, 0.5], 2e4), rule=rule, step=4e-3, cover=cover)
    rates = rigid_rates(found.stepper.model, found.state)[0]
    assert abs(found.state.frames.angle[0]) > 0.5
    # Rounding, of a stiffness that is 1e8 of the inertia.
    np.testing.assert_allclose(rates[:2], [0.0, 2e4 * TIME / MASS], atol=1e-7)
