"""Energies of a run against closed forms: what is stored, done, lost, and by whom."""

import numpy as np
import pytest

import nmm
from nmm.verification import text

MODULUS, DENSITY, HEIGHT, G = 1e7, 2000.0, 2.0, 9.81
# Sums of some hundred numbers of like size: rounding.
ROUNDED = 1e-9

COLUMN = """
plane = "stress"
[materials.a]
young_modulus = 1e7
poisson_ratio = 0.0
density = 2000.0
[[blocks]]
name = "b"
material = "a"
vertices = [[0, 0], [1, 0], [1, 2], [0, 2]]
"""
FOOT = '[[supports]]\nname = "s"\nsegment = [[0, 0], [1, 0]]\nfix = ["x", "y"]\n'
HEAD = '[[supports]]\nname = "h"\nsegment = [[0, 2], [1, 2]]\nfix = ["y"]\n'
BODY_LOAD = '[[loads]]\nname = "w"\nkind = "body"\ndensity = [0, -19620.0]\n'
QUADS = {"type": "quads", "size": 0.7, "degree": 2}
MESHES = ["nitsche", "lagrange", "penalty"]


def run(scene, step=1e-3, integrator="shi", supports="auto", cover=None, update="auto", **more):
    table = {
        "cover": cover or {},
        "supports": {"method": supports},
        "integrator": {"type": integrator, "step": step, **more},
        "rotation": {"update": update},
    }
    return nmm.run(nmm.parse_scene(scene), nmm.Formulation.model_validate(table))


def stored(history):
    names = ("kinetic", "strain", "contact", "support")
    return sum(history[f"{name}_energy"] for name in names)


@pytest.mark.parametrize("method", MESHES)
@pytest.mark.parametrize("load", ["[gravity]\n", BODY_LOAD])
def test_a_column_under_its_weight_stores_the_work_of_the_weight(load, method):
    found = run(COLUMN + FOOT + load, cover=QUADS, supports=method).history
    # int_0^h (rho g (h - y))^2 / 2E dy, on an area of one.
    right = (DENSITY * G) ** 2 * HEIGHT**3 / (6 * MODULUS)
    # Springs of supports give by 1e-6 of the height.
    assert found["strain_energy"][-1] == pytest.approx(right, rel=1e-5)
    assert found["external_work"][-1] == pytest.approx(stored(found)[-1], rel=ROUNDED)


@pytest.mark.parametrize("loading", ["[loading]\n", ""])
@pytest.mark.parametrize("method", MESHES)
def test_a_driven_support_does_the_work_that_the_bar_stores(method, loading):
    # Without [loading] the displacement stands at the start, and the first step drives it there.
    drive = HEAD + "displacement = [0, 0.01]\n" + loading
    found = run(COLUMN + FOOT + drive, cover=QUADS, supports=method)
    right = MODULUS * 0.01**2 / (2 * HEIGHT)
    # Springs at both ends, some hundred E over the size of a cell, give a little.
    tolerance = 5e-3 if method == "penalty" else 1e-8
    assert found.history["external_work"][-1] == pytest.approx(right, rel=tolerance)
    assert found.summary.energy_balance == pytest.approx(0.0, abs=ROUNDED)
    assert found.summary.status == "converged"


@pytest.mark.parametrize("method", MESHES)
def test_a_block_that_a_support_moves_without_strain_is_not_out_of_balance(method):
    drive = FOOT + "displacement = [0.003, 0.01]\n"
    found = run(COLUMN + drive, cover=QUADS, supports=method)
    assert (found.summary.status, list(found.summary.warnings)) == ("converged", [])
    # Rounding of E t u^2 = 1e3 J, and nothing else, by springs of 1e2 to 1e3 E as well.
    assert abs(found.history["strain_energy"][-1]) < 1e-9
    assert abs(found.history["external_work"][-1]) < 1e-9


def test_work_of_a_driven_support_that_is_not_booked_is_told(monkeypatch):
    monkeypatch.setattr("nmm.constraints.supports.Supports.first_work", lambda *_: 0.0)
    found = run(COLUMN + FOOT + HEAD + "displacement = [0, 0.01]\n", cover=QUADS)
    assert found.summary.status == "unbalanced"


@pytest.mark.parametrize("method", MESHES)
def test_work_of_a_driven_support_does_not_depend_on_the_increments(method):
    drive = HEAD + "displacement = [0, 0.01]\n[loading]\n"
    scene = nmm.parse_scene(COLUMN + FOOT + drive)
    table = {"cover": QUADS, "supports": {"method": method}}
    works = [
        nmm.run(
            scene, nmm.Formulation.model_validate({**table, "loading": {"increment": size}})
        ).history["external_work"][-1]
        for size in (1.0, 0.3)
    ]
    assert works[1] == pytest.approx(works[0], rel=1e-8)  # residuals of single solutions


@pytest.mark.parametrize("update", ["small", "exact"])
@pytest.mark.parametrize("load", ["[gravity]\n", BODY_LOAD])
@pytest.mark.parametrize("cover", [{}, QUADS])
def test_the_work_of_a_free_fall_is_its_kinetic_energy(load, update, cover):
    scene = "duration = 0.1\n" + COLUMN + load + "[inertia]\n"
    found = run(scene, integrator="newmark", update=update, cover=cover).history
    # The first step is Shi's and moves twice as far: v = g t all the same.
    right = DENSITY * HEIGHT * (G * found["time"]) ** 2 / 2
    assert found["kinetic_energy"] == pytest.approx(right, rel=1e-8)
    assert found["external_work"] == pytest.approx(right, rel=0.01, abs=0.02 * right[-1])
    late = slice(1, None)
    gained = np.diff(found["external_work"])[late]
    assert gained == pytest.approx(np.diff(right)[late], rel=1e-6)


@pytest.mark.parametrize("update", ["small", "exact"])
def test_the_work_of_a_body_load_with_a_history_is_the_kinetic_energy(update):
    load = BODY_LOAD + "history = [[0, 0], [0.1, 1]]\n[inertia]\n"
    found = run("duration = 0.1\n" + COLUMN + load, integrator="newmark", update=update)
    # v = g t^2 / (2 T) at the end; the rule is exact for forces linear in time.
    right = DENSITY * HEIGHT * (G * 0.1 / 2) ** 2 / 2
    # The first step, one of a hundred, is Shi's, of order 1.
    assert found.history["kinetic_energy"][-1] == pytest.approx(right, rel=1e-3)
    lost = found.history["integration_loss"][-1] / right
    assert found.summary.energy_balance == pytest.approx(lost, abs=ROUNDED)


INITIAL = '[[initial_stresses]]\nblock = "b"\nstress = [0, 1e5, 0]\n'


@pytest.mark.parametrize("update", ["small", "exact"])
@pytest.mark.parametrize("cover", [{}, QUADS])
def test_a_block_under_initial_stress_keeps_the_energy_of_that_stress(update, cover):
    scene = "duration = 0.01\n" + COLUMN + INITIAL + "[inertia]\n"
    found = run(scene, step=5e-5, integrator="newmark", update=update, cover=cover).history
    right = 1e5**2 / (2 * MODULUS) * HEIGHT
    # What the first step, Shi's, takes of it.
    assert stored(found)[0] == pytest.approx(right, rel=2e-2)
    assert stored(found) == pytest.approx(stored(found)[0], rel=1e-6)


def test_a_block_that_relaxes_its_initial_stress_gives_that_energy_away():
    pins = FOOT.replace('fix = ["x", "y"]', 'fix = ["y"]')
    pin = '[[supports]]\nname = "p"\npoint = [0, 0]\nfix = ["x"]\n'
    found = run(COLUMN + INITIAL + pins + pin, cover=QUADS, supports="lagrange")
    right = 1e5**2 / (2 * MODULUS) * HEIGHT
    assert found.history["external_work"][-1] == pytest.approx(-right, rel=1e-6)
    assert found.history["strain_energy"][-1] == pytest.approx(0.0, abs=1e-6 * right)
    assert found.summary.energy_balance == pytest.approx(0.0, abs=1e-8)


WAVE = "duration = 0.02\n" + COLUMN + FOOT + "[gravity]\n[inertia]\n"
RULES = [
    ("shi", {}),
    ("shi", {"kinetic_factor": 0.9}),
    ("newmark", {}),
    ("newmark", {"options": {"beta": 0.36, "gamma": 0.7}}),
    ("newmark", {"options": {"beta": 0.35, "gamma": 0.7}}),
    ("generalized_alpha", {}),
    ("generalized_alpha", {"options": {"rho_inf": 0.0}}),
]


@pytest.mark.parametrize(("integrator", "options"), RULES)
@pytest.mark.parametrize("method", ["nitsche", "lagrange", "penalty"])
def test_what_an_integrator_takes_of_a_wave_is_told_to_rounding(integrator, options, method):
    found = run(WAVE, 5e-4, integrator, method, QUADS, "small", **options)
    history = found.history
    lack = history["external_work"] - stored(history)
    size = np.abs(history["external_work"]).max()
    # Multipliers hold to 1e-8 of the motion.
    assert history["integration_loss"] == pytest.approx(lack, abs=1e-7 * size)


def test_the_loss_of_shis_integrator_is_that_of_its_recursion():
    # A block of one element, held all round by springs, that moves without deforming.
    scene = "duration = 0.01\n" + COLUMN.replace("1e7", "1e14") + "[inertia]\n"
    scene += '[[initial_velocities]]\nblock = "b"\nvelocity = [0, 1.0]\n'
    scene += '[[supports]]\nname = "s"\nblock = "b"\nfix = ["y"]\n'
    found = run(scene, step=1e-5)
    mass, place, speed, energies = DENSITY * HEIGHT, 0.0, 1.0, []
    vertical = np.zeros(found.manifold.n_unknowns)
    vertical[1] = 1.0
    stiffness = vertical @ (found.stepper.plan.supports.matrix(found.state) @ vertical)
    for _ in found.history["time"]:  # M (2 d / dt^2 - 2 v / dt) + K (u + d) = 0
        moved = (2 * mass * speed / 1e-5 - stiffness * place) / (2 * mass / 1e-10 + stiffness)
        place, speed = place + moved, 2 * moved / 1e-5 - speed
        energies.append(mass * speed**2 / 2 + stiffness * place**2 / 2)
    assert found.history["integration_loss"][-1] == pytest.approx(mass / 2 - energies[-1], rel=1e-6)


HISTORY = [[0, 0], [0.04, 1.0], [0.1, 0.2]]
FACTOR = "history = [[0, 0], [0.04, 1.0], [0.1, 0.2]]\n"
SHAKEN = "duration = 0.1\n" + COLUMN + FOOT + "displacement = [0, 0.01]\n" + FACTOR
LOADED = (
    "duration = 0.1\n" + COLUMN + FOOT + '[[loads]]\nname = "p"\nkind = "edge"\n'
    "segment = [[0, 2], [1, 2]]\ntraction = [0, 1e5]\n" + FACTOR
)
LOADED += "".join(f'[[monitors]]\nname = "{x}"\npoint = [{x}, 2]\n' for x in (0, 1))


def share(times):
    return np.interp([0.0, *times], *np.transpose(HISTORY))


def taken_late(history, force, way):
    """Work of a force, 0 at the start, that acts all through a step as at its end."""
    made = np.diff(stored(history) - history["external_work"])
    # Rounding of a hundred sums.
    assert made.max() <= ROUNDED * np.abs(history["external_work"]).max()
    return np.sum(force * np.diff(way))


def test_the_ground_does_the_work_of_the_reactions_that_acted():
    history = run(SHAKEN + "[inertia]\n", update="small").history
    work = taken_late(history, history["reaction:s:y"], 0.01 * share(history["time"]))
    assert history["external_work"][-1] == pytest.approx(work, rel=ROUNDED)


def test_a_load_with_a_history_does_the_work_of_the_force_that_acted():
    history = run(LOADED + "[inertia]\n", update="small").history
    way = (history["monitor:0:uy"] + history["monitor:1:uy"]) / 2  # the edge stays straight
    work = taken_late(history, 1e5 * share(history["time"])[1:], np.array([0.0, *way]))
    assert history["external_work"][-1] == pytest.approx(work, rel=ROUNDED)


DROP = text.scene(
    'plane = "stress"\nduration = 0.4\n[contact]\n[inertia]\n[gravity]\n',
    [
        text.material("a", 1e7, 0.0, 2000.0),
        text.interface("any", 0.0),
        text.box("floor", (-1, -1), (3, 1), "a"),
        text.box("b", (0, 0.2), (1, 1), "a"),
        text.fixed_block("floor"),
    ],
)


@pytest.mark.parametrize("integrator", ["shi", "newmark", "generalized_alpha"])
def test_what_is_missing_after_an_impact_is_told_apart(integrator):
    found = run(DROP, 1e-3, integrator)
    history = found.history
    lack = (history["external_work"] - stored(history) - history["friction_loss"])[-1]
    told = history["integration_loss"][-1] + history["contact_loss"][-1]
    # A straight fall turns nothing: all is told.
    assert told == pytest.approx(lack, abs=1e-7 * history["external_work"].max())
    assert lack > 0.01 * history["external_work"].max()
