"""Bodies of finite strain in steps: stretched, bent, pressed together, and free in flight."""

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest

import nmm
from covers.approximation.own_rule import own_rule
from nmm.assembly.moving.momenta import momenta
from nmm.effects.base import Instant, Span
from nmm.errors import NmmError
from nmm.formulation import parse_formulation
from nmm.scene.read import parse_scene
from nmm.stepping.drive.equilibrium.evidence import evidence
from nmm.stepping.drive.equilibrium.settling import SettledStep
from nmm.stepping.prepare import prepare

COVERS = {
    "block": 'type = "block"',
    "quads": 'type = "quads"\nsize = 0.7\ndegree = 0',
    "triangles": 'type = "triangles"\nsize = 0.6\nangle = 0.3\ndegree = 1',
    "splines": 'type = "bspline"\nsize = 0.6\ndegree = 0',
    "meshless": 'type = "mls"\nsize = 0.5\ndegree = 1',
}
MATERIAL = """
[materials.m]
law = "{law}"
young_modulus = {modulus}
poisson_ratio = {poisson}
density = 1.0
"""


def material(law, modulus=1.0, poisson=0.3):
    return MATERIAL.format(law=law, modulus=modulus, poisson=poisson)


def run(scene, cover, update="finite", more=""):
    text = f'[cover]\n{COVERS.get(cover, cover)}\n[rotation]\nupdate = "{update}"\n{more}'
    return nmm.run(parse_scene(scene), formulation=parse_formulation(text))


def box(name, low, high):
    (a, b), (c, d) = low, high
    corners = [[a, b], [c, b], [c, d], [a, d]]
    return f'[[blocks]]\nname = "{name}"\nmaterial = "m"\nvertices = {corners}\n'


def roller(name, segment, axes):
    return f'[[supports]]\nname = "{name}"\nsegment = {segment}\nfix = {axes}\n'


def pinned(name, point, axes):
    return f'[[supports]]\nname = "{name}"\npoint = {point}\nfix = {axes}\n'


def load(segment, traction):
    return f'[[loads]]\nname = "p"\nkind = "edge"\nsegment = {segment}\ntraction = {traction}\n'


def monitor(name, point, block):
    return f'[[monitors]]\nname = "{name}"\npoint = {point}\nblock = "{block}"\n'


def bar(law, pull):
    return (
        'plane = "strain"\n[loading]\nuntil = 1.0\n'
        + material(law)
        + box("bar", (0, 0), (1, 1))
        + roller("left", [[0, 0], [0, 1]], ["x"])
        # Along the bottom: with a pin alone the bar buckles at 0.2 E.
        + roller("low", [[0, 0], [1, 0]], ["y"])
        + load([[1, 0], [1, 1]], [pull, 0])
        + monitor("tip", [1, 1], "bar")
    )


# Stretches under nominal pulls, by sympy.
@pytest.mark.parametrize(
    ("law", "pull", "stretch", "lateral"),
    [
        ("neo_hookean", 0.2294051796, 1.25, 0.9038435519),
        ("neo_hookean", -0.2686315279, 0.8, 1.0948760560),
        ("elastic", 0.3863324176, 1.25, None),
    ],
)
@pytest.mark.parametrize("cover", COVERS)
def test_a_bar_is_stretched_evenly(cover, law, pull, stretch, lateral):
    found = run(bar(law, pull), cover, more="[loading]\nincrement = 0.5\n")
    assert found.summary.status == "converged", found.summary.sentence
    x, y = (1 + found.history[f"monitor:tip:u{axis}"][-1] for axis in "xy")
    # Springs of the support give way by a share of the stress over E; moving least squares bend.
    assert x == pytest.approx(stretch, abs=3e-3)
    if lateral is not None:
        assert y == pytest.approx(lateral, abs=3e-4 if cover == "meshless" else 1e-9)


def cantilever(length, depth, load_of_one, modulus=1e6):
    """A strip under a dead force at its end, P L^2 / (E I) of so much."""
    traction = load_of_one * modulus * depth**2 / 12 / length**2
    return (
        'plane = "stress"\n[loading]\nuntil = 1.0\n'
        + material("elastic", modulus, 0.0)
        + box("strip", (0, 0), (length, depth))
        + roller("root", [[0, 0], [0, depth]], ["x", "y"])
        + load([[length, 0], [length, depth]], [0, traction])
        + monitor("tip", [length, depth / 2], "strip")
    )


# Elastica: deflection and shortening over the length, by elliptic integrals.
@pytest.mark.parametrize(
    ("load_of_one", "rise", "shortening"),
    [(1, 0.3017207738, 0.0564332363), (10, 0.8106090249, 0.5549955978)],
)
def test_a_strip_bends_as_the_elastica_in_one_increment(load_of_one, rise, shortening):
    # Cells of a half are too stiff by 1.7e-3; of a quarter by 4e-4.
    cover = 'type = "triangles"\nsize = 0.25\ndegree = 1'
    found = run(cantilever(10, 0.2, load_of_one), cover, more="[loading]\nincrement = 1.0\n")
    assert found.summary.status == "converged", found.summary.sentence
    # Shear and stretch of a strip of a fiftieth of its length; the cells.
    assert found.history["monitor:tip:uy"][-1] / 10 == pytest.approx(rise, rel=2e-3)
    assert -found.history["monitor:tip:ux"][-1] / 10 == pytest.approx(shortening, rel=2e-3)
    # Iterations grow with the rotation, not with the slenderness.
    assert found.summary.passes <= 12


def pushed_column(method, across, until="1.0", size=0.5):
    """A column under 1.15 of its critical load, a share of it ``across``, in two leaps."""
    load_of_one = 1.1517196205 * np.pi**2 / 4
    column = cantilever(10, 0.1, load_of_one).replace("until = 1.0", f"until = {until}")
    lines = column.splitlines()
    push = load_of_one * 1e6 * 0.1**2 / 12 / 100
    at = next(n for n, line in enumerate(lines) if line.startswith("traction"))
    lines[at] = f"traction = [{-push}, {across * push}]"
    cover = f'type = "quads"\nsize = {size}\ndegree = 2'
    steps = "[loading]\nincrement = 0.5\ntolerance = 1e-3\n"
    more = f'{steps}[supports]\nmethod = "{method}"\n'
    return run("\n".join(lines), cover, more=more)


@pytest.mark.parametrize("method", ["auto", "lagrange"])
def test_a_straight_column_is_given_up_at_its_critical_load(method):
    found = pushed_column(method, 0.0, '"failure"', 1.0)
    assert found.summary.status == "failure_load"
    assert "not stable" in found.summary.sentence
    # Euler's, within the tolerance of the load; shear of a hundredth of its length takes 1e-4.
    assert found.history["load_factor"][-1] == pytest.approx(1 / 1.1517196205, rel=1.1e-3)


@pytest.mark.parametrize("method", ["auto", "lagrange"])
def test_a_column_bends_over_beyond_its_critical_load(method):
    # Increments that leap over the critical load must not end on the straight column.
    found = pushed_column(method, 1e-3)
    assert found.summary.status == "converged", found.summary.sentence
    assert found.history["monitor:tip:uy"][-1] / 10 == pytest.approx(0.5932076462, abs=1e-2)
    assert found.history["monitor:tip:ux"][-1] / 10 == pytest.approx(-0.2589803939, abs=1e-2)


def test_the_tangent_of_a_pressure_is_that_of_its_force():
    scene = (
        bar("elastic", 0.0)
        .replace('kind = "edge"', 'kind = "pressure"\npressure = 0.3')
        .replace("traction = [0.0, 0]\n", "")
    )
    text = f'[cover]\n{COVERS["triangles"]}\n[rotation]\nupdate = "finite"\n'
    made = prepare(parse_scene(scene), parse_formulation(text))
    effect, start = made.stepper.plan.effects["pressures"], made.start
    random = np.random.default_rng(0)
    bent, way = (0.1 * random.normal(size=len(start.deformation)) for _ in range(2))
    span = Span(None, 1.0, half=False)

    def through(unknowns):
        after = replace(start, deformation=unknowns, load_factor=1.0)
        return effect.step_force(start, after, span)

    slope = (through(bent + way).force - through(bent - way).force) / 2
    np.testing.assert_allclose(-through(bent).stiffness() @ way, slope, atol=1e-12)


def test_small_strain_is_met_where_loads_are_small():
    cover = 'type = "triangles"\nsize = 0.5\ndegree = 1'
    tips = [
        run(cantilever(10, 0.5, 1e-3), cover, update).history["monitor:tip:uy"][-1]
        for update in ("small", "finite")
    ]
    # Supports by springs in both would be one; by Nitsche's method for small strain.
    assert tips[1] == pytest.approx(tips[0], rel=2e-3)


def test_a_pressure_all_around_shrinks_a_body_evenly():
    pressed = "\n".join(
        f'[[loads]]\nname = "{n}"\nkind = "pressure"\nsegment = {segment}\npressure = 0.3\n'
        for n, segment in enumerate(
            ([[0, 0], [1, 0]], [[1, 0], [1, 1]], [[1, 1], [0, 1]], [[0, 1], [0, 0]])
        )
    )
    scene = (
        'plane = "strain"\n[loading]\nuntil = 1.0\n'
        + material("neo_hookean")
        + box("body", (0, 0), (1, 1))
        + pinned("pin", [0, 0], ["x", "y"])
        + pinned("slide", [1, 0], ["y"])
        + pressed
        + monitor("tip", [1, 1], "body")
    )
    found = run(scene, "quads", more="[loading]\nincrement = 0.5\n")
    assert found.summary.status == "converged", found.summary.sentence
    # -p = (mu (s^2 - 1) + lambda ln s^2) / s^2 with one stretch s.
    mu, lame = 1 / 2.6, 0.3 / (1.3 * 0.4)
    stretch = 1 + found.history["monitor:tip:ux"][-1]
    stress = (mu * (stretch**2 - 1) + lame * np.log(stretch**2)) / stretch**2
    assert stress == pytest.approx(-0.3, rel=1e-8)
    _, mean = found.stepper.model.matter.mean_stress(found.state.deformation, {})
    np.testing.assert_allclose(mean, np.tile([-0.3, -0.3, 0], (len(mean), 1)), atol=1e-8)


STACK = (
    'plane = "strain"\n[contact]\n[loading]\nuntil = 1.0\n[interfaces.smooth]\nfriction_angle = 0\n'
    + material("neo_hookean")
    + box("low", (0, 0), (1, 1))
    + box("top", (0, 1), (1, 2))
    + roller("ground", [[0, 0], [1, 0]], ["y"])
    + pinned("low", [0, 0], ["x"])
    + pinned("top", [0, 2], ["x"])
    + load([[0, 2], [1, 2]], [0, -0.2686315279])
    + monitor("tip", [1, 2], "top")
)


@pytest.mark.parametrize("cover", ["block", "quads", "splines"])
def test_two_bodies_are_pressed_together_evenly(cover):
    more = '[loading]\nincrement = 0.5\n[contact]\nenforcement = "lagrange"\n'
    found = run(STACK, cover, more=more)
    assert found.summary.status == "converged", found.summary.sentence
    assert 1 + found.history["monitor:tip:ux"][-1] == pytest.approx(1.0948760560, abs=1e-9)
    assert 2 + found.history["monitor:tip:uy"][-1] == pytest.approx(1.6, abs=2e-3)


CLAMP = (
    'plane = "strain"\n[contact]\n[loading]\nuntil = 1.0\n[interfaces.smooth]\nfriction_angle = 0\n'
    + material("elastic")
    + '[[blocks]]\nname = "clamp"\nmaterial = "m"\nvertices = '
    "[[0, 0], [2, 0], [2, 0.3], [0.3, 0.3], [0.3, 0.7], [2, 0.7], [2, 1], [0, 1]]\n"
    + roller("back", [[0, 0], [0, 1]], ["x", "y"])
    + load([[1.5, 1], [2, 1]], [0, -0.012])
    + load([[1.5, 0], [2, 0]], [0, 0.012]).replace('"p"', '"q"')
    + monitor("upper", [2, 0.7], "clamp")
    + monitor("lower", [2, 0.3], "clamp")
)


@pytest.mark.slow
def test_lips_of_one_body_close_and_press_on_each_other():
    cover = 'type = "bspline"\nsize = 0.25\ndegree = 0'
    # Springs over faces find no equilibrium beyond 0.70 of the load.
    corners = '[contact]\npoints = "vertices"\n'
    found = run(CLAMP, cover, more="[loading]\nincrement = 0.25\n" + corners)
    assert found.summary.status == "converged", found.summary.sentence
    upper, lower = (found.history[f"monitor:{lip}:uy"][-1] for lip in ("upper", "lower"))
    # They meet half way, but for springs that give by some 1e-3 of the opening of 0.4.
    assert upper == pytest.approx(-0.2, abs=2e-3)
    assert lower == pytest.approx(0.2, abs=2e-3)
    assert found.history["penetration"][-1] < 5e-3


STAGED = (
    'plane = "strain"\n[contact]\n[gravity]\n[interfaces.skin]\nfriction_angle = 0.5\n'
    + material("neo_hookean").replace("density = 1.0", "density = 0.005")
    + box("low", (0, 0), (2, 1))
    + roller("ground", [[0, 0], [2, 0]], ["x", "y"])
    + monitor("middle", [0.7, 1], "low")
)


def test_a_stage_that_takes_a_body_away_leaves_the_other_as_if_it_had_been_alone():
    stages = '[[stages]]\nname = "both"\n[[stages]]\nname = "one"\nremove = ["top"]\n'
    both = run(STAGED + box("top", (0.2, 1), (1.2, 2)) + stages, "quads")
    alone = run(STAGED, "quads")
    assert both.summary.status == alone.summary.status == "converged"
    ways = both.history["monitor:middle:uy"]
    assert ways[0] < 2 * ways[-1]
    assert ways[-1] == pytest.approx(alone.history["monitor:middle:uy"][-1], rel=1e-7)


FLYING = 'plane = "strain"\nduration = 10.0\n[inertia]\n' + "{material}" + box("b", (0, 0), (1, 1))
# Elongated by 1.1 and 0.95 at the start, and spun by 5 rad/s.
STRETCH, SPIN = np.diag([1.1, 0.95]), np.array([[0.0, -5.0], [5.0, 0.0]])
# Deformation gradients after 0.1 s, by an ODE solver of order 8.
AFTER = {
    "elastic": [[0.769215162, -0.495606666], [0.494580084, 0.932845685]],
    "neo_hookean": [[0.780447434, -0.488927997], [0.487991310, 0.917775193]],
}
ENERGY = {"elastic": 8.2676782853, "neo_hookean": 7.4644551543}


def flight(law, cover, step, steps, rule="energy_momentum"):
    """Energies (J), angular momenta and the last mean deformation gradient of a free body."""
    text = (
        f'[cover]\n{COVERS[cover]}\n[rotation]\nupdate = "finite"\n'
        f'[integrator]\ntype = "{rule}"\nstep = {step!r}\n'
    )
    scene = FLYING.format(material=material(law, 1000.0))
    made = prepare(parse_scene(scene), parse_formulation(text))
    stepper, state = made.stepper, made.start
    model, plan = stepper.model, stepper.plan
    rule_of_points = own_rule(model.manifold)
    points = rule_of_points.points - model.manifold.body_centroid[0]
    rows = model.manifold.rows(rule_of_points.owner, rule_of_points.points)
    matrix = rows.matrix(model.manifold.n_unknowns)

    def field(gradient):
        whole = matrix.toarray()
        return np.linalg.lstsq(whole, (points @ gradient.T).ravel(), rcond=1e-13)[0]

    state = replace(state, deformation=field(STRETCH - np.eye(2)), velocity=field(SPIN @ STRETCH))
    energies, spins = [], []
    for _ in range(steps + 1):
        energies.append(plan.energy("inertia", state) + model.strain_energy(state))
        spins.append((momenta(model, state.deformation) @ state.velocity)[2])
        attempt = stepper.attempt(state, Instant(state.time + step, 1.0), step)
        assert attempt.converged, attempt.sentence
        last, (state, _) = state, stepper.accept(attempt)
    way = (matrix @ last.deformation).reshape(-1, 2)
    gradient = np.linalg.lstsq(points, way, rcond=None)[0].T + np.eye(2)
    return np.array(energies), np.array(spins), gradient


@pytest.mark.parametrize("law", AFTER)
@pytest.mark.parametrize("cover", ["block", "quads", "triangles"])
def test_energy_and_angular_momentum_of_a_flight_are_kept(cover, law):
    energies, spins, _ = flight(law, cover, 0.01, 60)
    assert energies[0] == pytest.approx(ENERGY[law], rel=1e-9)
    assert spins[0] == pytest.approx(0.8802083333, rel=1e-9)
    assert np.ptp(energies) < 1e-12 * energies[0]
    assert np.ptp(spins) < 1e-12 * spins[0]


@pytest.mark.slow
@pytest.mark.parametrize("law", AFTER)
@pytest.mark.parametrize(("cover", "steps"), [("block", 10_000), ("triangles", 1000)])
def test_they_are_kept_over_a_long_flight(cover, steps, law):
    energies, spins, _ = flight(law, cover, 0.01, steps)
    assert np.ptp(energies) < 1e-9 * energies[0]
    assert np.ptp(spins) < 1e-10 * spins[0]


def test_newmarks_rule_keeps_neither():
    energies, spins, _ = flight("elastic", "block", 0.01, 60, "newmark")
    assert np.ptp(energies) > 1e-2 * energies[0]
    assert np.ptp(spins) > 1e-3 * spins[0]


@pytest.mark.parametrize(
    ("law", "errors"), [("elastic", (5.77e-3, 1.29e-3)), ("neo_hookean", None)]
)
def test_a_flight_is_of_second_order(law, errors):
    found = [
        np.abs(flight(law, "block", step, round(0.1 / step))[2] - AFTER[law]).max()
        for step in (0.004, 0.002)
    ]
    assert 1.9 < np.log2(found[0] / found[1]) < 2.4
    if errors is not None:  # of an independent program
        np.testing.assert_allclose(found, errors, rtol=5e-3)


def refused(scene, more="", update="finite"):
    text = f'[rotation]\nupdate = "{update}"\n{more}'
    with pytest.raises(NmmError) as told:
        prepare(parse_scene(scene), parse_formulation(text))
    return str(told.value)


def test_what_finite_strain_does_not_know_is_refused_in_words():
    wet = bar("elastic", 0.1).replace("density", "hydraulic_conductivity = 1.0\ndensity")
    wet += '[seepage]\n[[heads]]\nname = "h"\nblock = "bar"\nhead = 1.0\n'
    assert "its stress" in refused(wet.replace('plane = "strain"', 'plane = "stress"'))
    plastic = bar("von_mises", 0.1).replace("density", "yield_stress = 1.0\ndensity")
    assert "no potential of finite strain" in refused(plastic)
    damped = FLYING.format(material=material("elastic")) + "[damping]\nstiffness = 0.1\n"
    assert "damping by stiffness" in refused(damped, "[integrator]\nstep = 0.1\n")
    free = FLYING.format(material=material("elastic"))
    rule = '[integrator]\ntype = "energy_momentum"\nstep = 0.1\n'
    assert 'add update = "finite"' in refused(free, rule, "exact")
    mesh = '[cover]\ntype = "quads"\nsize = 0.5\nvolumetric = "projected"\n'
    nearly = bar("elastic", 0.1).replace("poisson_ratio = 0.3", "poisson_ratio = 0.49")
    assert "finite strain" in refused(nearly, mesh)


def test_matter_that_is_turned_inside_out_is_no_solution():
    # A bar of St Venant and Kirchhoff bears no more than E / (3 sqrt 3) of compression.
    found = run(bar("elastic", -1.0), "block", more="[loading]\nincrement = 0.25\n")
    assert found.summary.status in ("failed", "collapsed")
    assert found.state.load_factor < 0.4


@pytest.mark.parametrize(("update", "shown"), [("finite", False), ("exact", True)])
def test_an_iterate_far_away_is_no_proof_where_bodies_bend_by_any_angle(update, shown):
    scene = parse_scene(bar("elastic", 0.01) + "[contact]\n[interfaces.skin]\nfriction_angle = 0\n")
    formulation = parse_formulation(f'[cover]\ntype = "block"\n[rotation]\nupdate = "{update}"\n')
    made = prepare(scene, formulation)
    found = made.stepper.attempt(made.start, Instant(0.0, 0.1), None)
    far = replace(found, converged=False, motion=10 * made.stepper.size)
    told = evidence(made.stepper, made.start, 0.1, SettledStep(far, None), ["bar"])
    assert (told is not None) == shown


def test_nothing_of_it_is_imported_where_no_formulation_names_it():
    code = (
        "import sys, nmm\nfrom nmm.scene.read import parse_scene\n"
        f"nmm.run(parse_scene({bar('elastic', 1e-6)!r}))\n"
        "found = [m for m in sys.modules if 'finite_strain' in m or 'energy_momentum' in m]\n"
        "assert not found, found\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
