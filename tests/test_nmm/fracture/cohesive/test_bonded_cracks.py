"""Cracks whose faces begin bonded: a cohesive plane inside a body, whatever the net."""

import numpy as np
import pytest

import nmm
from nmm.errors import NmmError
from nmm.formulation import parse_formulation
from nmm.model.manifolds.tips import tip_lines
from nmm.model.solver_settings import warnings
from nmm.scene.methods.cover_tables import EnrichmentTable
from nmm.scene.read import parse_scene
from nmm.stepping.prepare import prepare

# A bar of 0.5 m x 0.1 m x 0.1 m with a crack across it: ft = 3 MPa, GF = 100 J/m2.
STRENGTH, ENERGY, AREA, MODULUS = 3e6, 100.0, 0.01, 30e9
BAR = """
plane = "stress"
thickness = 0.1
{contact}
[materials.m]
young_modulus = 30e9
poisson_ratio = 0.0
[interfaces.c]
law = "{law}_softening"
friction_angle = "30 deg"
cohesion = 1e8
tensile_strength = 3e6
bonded = true
fracture_energy = 100.0
[[blocks]]
name = "b"
material = "m"
vertices = [[0, 0], [0.5, 0], [0.5, 0.1], [0, 0.1]]
[[cracks]]
name = "c"
points = [[0.23, -0.01], [0.23, 0.11]]
bonded = true
[[supports]]
name = "left"
segment = [[0, 0], [0, 0.1]]
fix = ["x"]
[[supports]]
name = "floor"
segment = [[0, 0], [0.22, 0]]
fix = ["y"]
[[supports]]
name = "track"
segment = [[0.24, 0], [0.5, 0]]
fix = ["y"]
[[loads]]
name = "pull"
kind = "edge"
segment = [[0.5, 0], [0.5, 0.1]]
traction = ["1 MPa", 0]
[[monitors]]
name = "one"
point = [0.2, 0.05]
[[monitors]]
name = "other"
point = [0.26, 0.05]
[loading]
until = "failure"
[loading.control]
type = "opening"
monitors = ["other", "one"]
increment = {increment!r}
end = {end!r}
"""
NET = """
[cover]
type = "{cover}"
size = 0.06
degree = {degree}
angle = {angle}
shift = [0.13, 0.27]
[supports]
method = "nitsche"
"""
WIDTHS = {"linear": 2.0, "bilinear": 3.6, "exponential": 10.0}


def bar(law="linear", steps=10, contact="[contact]"):
    end = WIDTHS[law] * ENERGY / STRENGTH
    given = {"law": law, "contact": contact, "increment": end / steps, "end": 1.02 * end}
    return parse_scene(BAR.format(**given))


def net(degree=1, angle=0.0, cover="triangles"):
    return parse_formulation(NET.format(degree=degree, angle=angle, cover=cover))


@pytest.mark.parametrize(
    ("degree", "angle", "cover"),
    [
        (0, 0.4, "quads"),
        pytest.param(1, 0.0, "triangles", marks=pytest.mark.slow),
        pytest.param(1, 0.7, "triangles", marks=pytest.mark.slow),
    ],
)
def test_a_bonded_crack_breaks_at_its_strength_and_takes_its_energy(degree, angle, cover):
    # Uniform stress: the peak is ft A and the work GF A, whatever the net; linear softening is
    # linear in a step, so that nothing is left but rounding.
    run = nmm.run(bar(steps=5), net(degree, angle, cover))
    assert run.summary.failure_factor == pytest.approx(STRENGTH / 1e6, rel=1e-9)
    assert run.history["external_work"][-1] == pytest.approx(ENERGY * AREA, rel=1e-9)
    assert run.history["friction_loss"][0] == pytest.approx(0.0, abs=1e-9 * ENERGY * AREA)
    assert abs(run.summary.energy_balance) < 1e-9


def test_a_whole_bond_does_not_show():
    # At its strength the bar is as long as its material alone makes it: no stiffness was measured,
    # none is there.
    run = nmm.run(bar(steps=5), net(0, 0.4, "quads"))
    apart = run.history["monitor:other:ux"] - run.history["monitor:one:ux"]
    assert run.history["load_factor"][0] == pytest.approx(STRENGTH / 1e6, rel=1e-9)
    assert apart[0] == pytest.approx(0.06 * STRENGTH / MODULUS, rel=1e-9)


CURVES = {
    "linear": lambda w: 1 - w / 2,
    "bilinear": lambda w: np.interp(w, [0, 0.8, 3.6], [1, 1 / 3, 0]),
    "exponential": lambda w: np.exp(-w),
}


@pytest.mark.parametrize("law", WIDTHS)
def test_traction_follows_the_law_over_the_opening(law):
    # Closed form of each law; chords stand for the exponential to 1e-3.
    run = nmm.run(bar(law, steps=4), net(0, 0.4, "quads"))
    load = run.history["load_factor"][1:]
    apart = run.history["monitor:other:ux"] - run.history["monitor:one:ux"]
    opening = apart[1:] - 0.06 * load * 1e6 / MODULUS
    expected = np.maximum(CURVES[law](opening * STRENGTH / ENERGY), 0) * STRENGTH / 1e6
    off = 1e-3 if law == "exponential" else 1e-9
    assert np.abs(load - expected).max() < off * STRENGTH / 1e6


def test_a_bonded_crack_asks_for_contact():
    with pytest.raises(NmmError, match=r"cracks\.0\.bonded.*without \[contact\]"):
        bar(contact="")


def test_a_bonded_crack_in_a_material_without_bond_is_refused():
    text = BAR.format(law="linear", contact="[contact]", increment=1e-6, end=1e-5)
    text = text.replace(
        "[interfaces.c]",
        '[interfaces.free]\nbetween = ["m", "m"]\nfriction_angle = 0.5\n[interfaces.c]',
    )
    with pytest.raises(NmmError, match="holds nothing"):
        prepare(parse_scene(text), net())


def test_tips_of_bonded_cracks_carry_no_singular_functions():
    text = BAR.format(law="linear", contact="[contact]", increment=1e-6, end=1e-5)
    short = parse_scene(text.replace("[0.23, 0.11]", "[0.23, 0.05]"))
    model = prepare(short, net()).stepper.model
    assert len(model.cut.tips) == 1
    assert not len(model.manifold.singular)


def test_a_cohesive_tip_misses_no_functions_and_is_not_warned_of():
    text = BAR.format(law="linear", contact="[contact]", increment=1e-6, end=1e-5)
    short = text.replace("[0.23, 0.11]", "[0.23, 0.05]")
    model = prepare(parse_scene(short), net()).stepper.model
    assert warnings(model) == []
    assert list(tip_lines(model)) == ["crack tip [0.23, 0.05]: cohesive, without a singularity"]
    # The same crack with free faces is one whose functions are missed.
    free = parse_scene(short.replace("[0.23, 0.05]]\nbonded = true", "[0.23, 0.05]]"))
    bare = net().model_copy(
        update={"cover": net().cover.model_copy(update={"enrichment": EnrichmentTable(tips=False)})}
    )
    assert "without tip functions" in warnings(prepare(free, bare).stepper.model)[0]
