"""Statics: equilibrium, load control to failure, honest ends."""

import subprocess
import sys

import numpy as np
import pytest

import nmm
from nmm.formulation import Formulation
from nmm.model.effects_table import EFFECTS
from nmm.testing.scenes import roller_and_pin

BAR = (
    """
plane = "stress"
thickness = 0.5
[materials.steel]
young_modulus = 1000.0
poisson_ratio = 0.3
[[blocks]]
material = "steel"
vertices = [[0, 0], [2, 0], [2, 1], [0, 1]]
"""
    + roller_and_pin()
    + """[[loads]]
name = "pull"
kind = "edge"
segment = [[2, 0], [2, 1]]
traction = [1.0, 0]
[[monitors]]
name = "tip"
point = [2, 1]
"""
)

# Two blocks bonded on their shared edge of 1 m, pulled apart.
BOND = """
plane = "stress"
[materials.rock]
young_modulus = 1e9
poisson_ratio = 0.0
[interfaces.bond]
bonded = true
friction_angle = "30 deg"
cohesion = 2e6
tensile_strength = 1e6
[[blocks]]
name = "held"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[blocks]]
name = "pulled"
material = "rock"
vertices = [[1, 0], [2, 0], [2, 1], [1, 1]]
[[supports]]
name = "held"
block = "held"
fix = ["x", "y"]
[[loads]]
name = "pull"
kind = "edge"
segment = [[2, 0], [2, 1]]
traction = [1e6, 0]
[contact]
[loading]
until = "failure"
"""


def test_bar_in_tension_has_the_closed_form_stress_and_stretch() -> None:
    run = nmm.run(nmm.parse_scene(BAR))
    np.testing.assert_allclose(run.stress, [[1.0, 0.0, 0.0]], atol=1e-12)
    # L sigma / E, and the support's springs: 1000 E t at each of the edge's Gauss points.
    stretch = run.history["monitor:tip:ux"][-1]
    assert stretch == pytest.approx(2e-3, rel=2e-4)
    assert run.history["monitor:tip:uy"][-1] == pytest.approx(-0.3e-3, rel=1e-9)
    assert run.history["reaction:left:x"][-1] == pytest.approx(-0.5, rel=1e-9)


@pytest.mark.parametrize("increment", [0.07, 0.3, 5.0])
def test_failure_load_of_a_bond_does_not_depend_on_the_increment(increment: float) -> None:
    formulation = Formulation.model_validate({"loading": {"increment": increment}})
    run = nmm.run(nmm.parse_scene(BOND), formulation)
    assert run.summary.status == "failure_load"
    # f_t A = 1e6 N at factor 1; the bracket is 0.5 % wide and lies below the strength.
    assert run.summary.failure_load is not None
    assert 0.995e6 <= run.summary.failure_load <= 1e6
    assert run.summary.failure_tolerance is not None
    assert run.summary.failure_tolerance <= 0.00505


def test_a_bond_under_shear_fails_by_mohr_coulomb() -> None:
    # Pressure 1 MPa and cohesion 2 MPa: tau = 2 + 1 tan 30 = 2.577 MPa; the shear acts through the
    # joint's middle, so that no moment loads one spring more than the other.
    text = BOND.replace("traction = [1e6, 0]", "traction = [-1e6, 0]").replace(
        'until = "failure"', 'until = "failure"\nscaled = ["slip"]'
    )
    text += """
[[loads]]
name = "slip"
kind = "point"
point = [1.0, 0.5]
block = "pulled"
force = [0, -1e6]
"""
    run = nmm.run(nmm.parse_scene(text), None)
    assert run.summary.failure_factor == pytest.approx(2 + np.tan(np.pi / 6), rel=0.006)


def test_a_structure_without_support_is_refused_by_the_solution_not_answered() -> None:
    text = BAR.replace("fix = ['y']", "fix = ['x']")
    text += '[[loads]]\nname="up"\nkind="point"\npoint=[2,1]\nforce=[0,1.0]\n'
    run = nmm.run(nmm.parse_scene(text))
    assert run.summary.status == "collapsed"
    assert "singular" in run.summary.sentence
    assert len(run.history["step"]) == 0


def test_the_name_of_a_file_is_no_scene() -> None:
    with pytest.raises(TypeError, match=r"nmm\.run: 'a\.toml': expected a Scene: read a file by"):
        nmm.run("a.toml")


@pytest.fixture(scope="module")
def imported_by_the_bar() -> set[str]:
    """Modules that a run of the bar imports, in an interpreter of its own."""
    code = (
        "import nmm, sys\n"
        f"run = nmm.run(nmm.parse_scene('''{BAR}'''))\n"
        "assert sorted(run.stepper.plan.effects) == ['loads', 'supports']\n"
        "print(*sys.modules)\n"
    )
    told = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    return set(told.stdout.split())


@pytest.mark.parametrize("effect", sorted(set(EFFECTS.table) - {"loads", "supports"}))
def test_an_unnamed_effect_is_neither_built_nor_imported(
    effect: str, imported_by_the_bar: set[str]
) -> None:
    module, _, _ = EFFECTS.table[effect].partition(":")
    assert "nmm.effects.loading.loads" in imported_by_the_bar
    assert module not in imported_by_the_bar


def test_without_contact_nothing_of_it_nor_of_its_compiler_is_imported(
    imported_by_the_bar: set[str],
) -> None:
    heavy = {"numba", "matplotlib"}
    assert not [m for m in imported_by_the_bar if m in heavy or m.startswith("nmm.contact")]


def test_the_summary_estimates_the_condition_of_the_system_with_its_joints() -> None:
    text = BOND.replace('until = "failure"', "until = 0.5")
    run = nmm.run(nmm.parse_scene(text))
    found = run.summary.condition_estimate
    assert found is not None
    # Supports of 1000 E beside blocks of 1 E, Jacobi-scaled: between 1 and their product squared.
    assert 1 < found < 1e8


@pytest.mark.parametrize("budget", ["10 s", -1.0, float("nan")])
def test_a_budget_that_is_no_number_of_seconds_is_refused(budget, bar_text):
    with pytest.raises(TypeError, match=r"budget .*: expected a number of seconds, 0 or more"):
        nmm.run(nmm.parse_scene(bar_text()), budget=budget)
