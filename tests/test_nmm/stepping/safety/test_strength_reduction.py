"""Factors of safety: a block on an incline against its closed form, the bracket, the bounds."""

import json

import numpy as np
import pytest

import nmm
from nmm.errors import NmmError, SceneError
from nmm.model.build import material_law
from nmm.scene import parse_scene
from nmm.scene.tables.strength_reduction import StrengthReductionTable
from nmm.stepping.safety.strength_reduction import FactorTried, bracket, weakened
from nmm.testing.scenes import block_on_incline
from nmm.verification.problems.matter.slopes import ToppledSlope


def incline(slope, friction, cohesion=0.0, lowest=0.5, highest=4.0):
    """A block of 1 m by 0.5 m on an incline of so many degrees."""
    search = f"lowest = {lowest}\nhighest = {highest}"
    return parse_scene(block_on_incline(slope, friction, cohesion, search), "incline.toml")


@pytest.mark.parametrize(
    ("slope", "friction", "cohesion"), [(30, 40, 0.0), (20, 30, 0.0), (30, 20, 10e3), (35, 30, 0.0)]
)
def test_a_block_on_an_incline_is_as_safe_as_its_closed_form(slope, friction, cohesion, tmp_path):
    run = nmm.run(incline(slope, friction, cohesion), out=tmp_path / "run")
    angle, weight = np.radians(slope), 2000 * 9.81 * 0.5
    resists = cohesion + weight * np.cos(angle) * np.tan(np.radians(friction))
    expected = resists / (weight * np.sin(angle))
    found = run.summary
    # The closed form is of rigid blocks; these shorten by 1e-5, and their joints with them.
    assert found.factor_of_safety <= expected <= found.factor_that_fails * (1 + 1e-4)
    assert found.factor_that_fails - found.factor_of_safety <= 0.01
    assert "2 runs" in found.sentence or expected < 1  # one that holds, and one below the theorem's
    assert found.status == "converged"
    assert "factor of safety" in found.sentence
    stored = json.loads((tmp_path / "run/summary.json").read_text())
    assert stored["factor_of_safety"] == found.factor_of_safety


def test_the_theorem_tells_of_members_that_hold_a_block_beside_friction():
    """A tie that yields at T is no weaker: W cos(b) tan(phi) / F + T = W sin(b)."""
    slope, friction, tie = np.radians(30), np.radians(25), 2e3
    along = np.array([np.cos(slope), np.sin(slope)])
    middle = 2 * along + 0.25 * np.array([-along[1], along[0]])
    text = block_on_incline(30, 25, search="lowest = 0.5\nhighest = 4.0") + (
        f'[[springs]]\nname = "tie"\npoints = [{middle.tolist()}, {(middle + along).tolist()}]\n'
        f'blocks = ["block", "ground"]\nstiffness = "1 GN/m"\nyield_force = {tie}\n'
    )
    found, weight = nmm.run(parse_scene(text)).summary, 2000 * 9.81 * 0.5
    expected = weight * np.cos(slope) * np.tan(friction) / (weight * np.sin(slope) - tie)
    # The block shortens by 1e-5, and its joint with it.
    assert found.factor_of_safety <= expected <= found.factor_that_fails * (1 + 1e-4)
    said = "no contact forces within friction and strength and forces of members within theirs"
    assert said in found.sentence


def test_a_scene_that_holds_at_the_highest_factor_says_so():
    found = nmm.run(incline(10, 40, highest=1.5)).summary
    assert found.factor_of_safety == 1.5
    assert found.factor_that_fails is None
    assert "highest" in found.sentence


def test_a_scene_that_fails_at_the_lowest_factor_has_collapsed():
    found = nmm.run(incline(40, 20, lowest=0.9, highest=1.2)).summary
    assert found.factor_of_safety is None
    assert found.factor_that_fails == 0.9
    assert found.status == "collapsed"


def test_a_bound_of_the_static_theorem_spares_runs_and_may_be_above_the_limit():
    tried = []

    def run(factor, bound, limit):
        tried.append(factor)
        status = "converged" if factor <= limit else "collapsed"
        return FactorTried(factor, status, "", lambda highest, width: bound)

    low, high = bracket(lambda f: run(f, 1.37, 1.3699), StrengthReductionTable())
    assert (len(tried), high.factor) == (2, 1.37)
    assert high.factor - low.factor <= 0.01
    low, high = bracket(lambda f: run(f, 1.6, 1.37), StrengthReductionTable())
    assert low.factor <= 1.37 < high.factor <= low.factor + 0.01


@pytest.mark.parametrize(("limit", "asked"), [(1.5, [4.0]), (0.7, [1.0])])
def test_the_static_theorem_is_asked_up_to_the_least_factor_that_is_known_to_fail(limit, asked):
    highest = []

    def run(factor):
        status = "converged" if factor <= limit else "collapsed"
        return FactorTried(factor, status, "", lambda most, width: highest.append(most))

    bracket(run, StrengthReductionTable(highest=4.0))
    assert highest == asked


@pytest.mark.parametrize("limit", [0.13, 0.99, 1.0, 1.37, 7.7])
def test_the_bracket_closes_around_any_limit(limit):
    def run(factor):
        return FactorTried(factor, "converged" if factor <= limit else "collapsed", "")

    low, high = bracket(run, StrengthReductionTable())
    assert low.factor <= limit < high.factor
    assert high.factor - low.factor <= 0.01


def test_strengths_are_divided_and_angles_by_their_tangents():
    soil = {"law": "mohr_coulomb", "young_modulus": 1e8, "poisson_ratio": 0.3, "cohesion": 1e4}
    soil |= {"friction_angle": 0.5, "dilation_angle": 0.4, "tensile_strength": 2e3}
    block = {"material": "soil", "vertices": [[0, 0], [1, 0], [0, 1]]}
    scene = nmm.scene.build_scene(
        {"plane": "strain", "materials": {"soil": soil}, "blocks": [block]}
    )
    weak = weakened(scene, 2.0).materials["soil"]
    assert (weak.cohesion, weak.tensile_strength) == (5e3, 1e3)
    assert np.tan(weak.friction_angle) == pytest.approx(np.tan(0.5) / 2)
    assert weak.dilation_angle == weak.friction_angle  # 0.4 would be beyond it
    assert weak.young_modulus == 1e8


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("lowest = 0.5", "lowest = 5.0", "less than 4"),
        ("[gravity]", "[gravity]\n[inertia]", "with inertia"),
        ("[strength_reduction]", "[strength_reduction]\nfactor = 1", "factor"),
    ],
)
def test_what_contradicts_it_is_refused_by_line(old, new, said):
    text = block_on_incline(45, 30, search="lowest = 0.5\nhighest = 4.0")
    assert old in text
    with pytest.raises(SceneError, match=rf"slope\.toml:\d+.*{said}"):
        parse_scene(text.replace(old, new), "slope.toml")


def test_the_scene_of_a_run_folder_is_read_back(tmp_path):
    nmm.run(incline(20, 35), out=tmp_path / "run")
    scene = nmm.read_scene(tmp_path / "run" / "scene.toml")
    assert scene.strength_reduction == StrengthReductionTable(lowest=0.5, highest=4.0)


def test_leaning_columns_need_the_friction_of_goodman_and_bray():
    # A corner held back from an increment before, with its friction, let them stand at 0.71.
    found = ToppledSlope(45.0).checks("rigid")
    assert all(check.passed for check in found.values()), found


def test_friction_that_is_left_is_reduced_with_that_at_first_and_dilation_stays_below():
    text = (
        'plane = "strain"\n[materials.m]\nlaw = "mohr_coulomb"\nyoung_modulus = 1e8\n'
        'poisson_ratio = 0.2\ncohesion = 1e4\nfriction_angle = "30 deg"\n'
        'dilation_angle = "18 deg"\n'
        'softening_energy = 100.0\nresidual_cohesion = 2e3\nresidual_friction_angle = "20 deg"\n'
        'residual_dilation_angle = "12 deg"\n'
        '[[blocks]]\nname = "b"\nmaterial = "m"\nvertices = [[0, 0], [1, 0], [1, 1]]\n'
    )
    found = weakened(nmm.parse_scene(text), 2.0).materials["m"]
    first, last = np.tan(np.radians([30, 20])) / 2
    assert np.tan(found.friction_angle) == pytest.approx(first, rel=1e-14)
    assert np.tan(found.residual_friction_angle) == pytest.approx(last, rel=1e-14)
    assert found.dilation_angle == pytest.approx(np.arctan(first), rel=1e-14)
    assert found.residual_dilation_angle == pytest.approx(np.arctan(last), rel=1e-14)
    assert material_law(found).fall == pytest.approx(0.8)


def test_a_factor_whose_strengths_are_refused_is_named():
    """Energies are divided, the apex of the cone is not: cells may grow too large on the way."""
    text = (
        'plane = "strain"\n[materials.m]\nlaw = "drucker_prager"\nyoung_modulus = 1e8\n'
        "poisson_ratio = 0.3\ncohesion = 1e4\nfriction_angle = 0.8\ndensity = 2000.0\n"
        "softening_energy = 0.6\n[gravity]\n[strength_reduction]\nlowest = 1.0\n"
        '[[supports]]\nname = "s"\nsegment = [[0, 0], [1, 0]]\nfix = ["x", "y"]\n'
        '[[blocks]]\nname = "b"\nmaterial = "m"\nvertices = [[0, 0], [1, 0], [1, 1], [0, 1]]\n'
    )
    with pytest.raises(NmmError, match=r"strengths over 2 are refused.*softening_energy: 0\.3: "):
        nmm.run(nmm.parse_scene(text))
