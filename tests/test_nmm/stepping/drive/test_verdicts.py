"""A failed structure, a failed solver and a spent budget are told apart, with what shows it."""

import numpy as np
import pytest
from typer.testing import CliRunner

import nmm
from nmm.cli.app import app
from nmm.stepping.bounds.static_theorem import carried, load_bound
from nmm.stepping.drive.verdict import EXIT_CODES, MEANT
from nmm.stepping.prepare import prepare

BLOCKS = """
plane = "stress"
[contact]
[gravity]
[materials.r]
young_modulus = 1e9
poisson_ratio = 0.0
density = 2000.0
[interfaces.any]
between = "any"
friction_angle = "%s deg"
[[blocks]]
name = "base"
material = "r"
vertices = [[-3, -1], [4, -1], [4, 0], [-3, 0]]
[[blocks]]
name = "b"
material = "r"
vertices = [[0, 0], [1, 0], [1, 2], [0, 2]]
[[supports]]
name = "held"
block = "base"
fix = ["x", "y"]
"""
PUSH = '[[loads]]\nname = "push"\nkind = "point"\npoint = [0, %s]\nblock = "b"\nforce = [%s, 0]\n'
WEIGHT = 2000.0 * 9.81 * 2


def run(text, **loading):
    table = {"loading": loading} if loading else {}
    return nmm.run(nmm.parse_scene(text), nmm.Formulation.model_validate(table)).summary


@pytest.mark.parametrize(("height", "friction", "right"), [(2.0, 45, 0.25), (0.02, 30, 0.57735)])
def test_the_static_theorem_finds_what_a_block_carries(height, friction, right):
    # Toppling: W 0.5 / 2; sliding: W tan 30.
    text = BLOCKS % friction + PUSH % (height, WEIGHT) + '[loading]\nscaled = ["push"]\n'
    made = prepare(nmm.parse_scene(text), nmm.Formulation())
    found = carried(made.stepper, made.start, 1.0)
    assert found.fails
    assert found.factor == pytest.approx(right, rel=1e-5)
    assert carried(made.stepper, made.start, 0.99 * right).fails is False


@pytest.mark.parametrize(
    ("height", "friction", "right", "how"),
    [(2.0, 45, 0.25, "turns clockwise"), (0.02, 30, 0.57735, "moves along (0.87, 0.50)")],
)
def test_bound_prints_the_load_and_the_mechanism(tmp_path, height, friction, right, how):
    # Toppling: W 0.5 / 2; sliding: W tan 30, with friction that dilates by its angle.
    scene = tmp_path / "pushed.toml"
    text = BLOCKS % friction + PUSH % (height, WEIGHT) + '[loading]\nscaled = ["push"]\n'
    scene.write_text(text)
    said = CliRunner().invoke(app, ["bound", str(scene)]).output
    assert float(said.split("load factor ")[1].split(",")[0]) == pytest.approx(right, rel=1e-5)
    assert f"block b moves most: it {how}" in " ".join(said.split())


def test_a_load_that_presses_on_the_floor_has_no_bound(tmp_path):
    scene = tmp_path / "pressed.toml"
    pressed = (PUSH % (2.0, 0.0)).replace("force = [0.0, 0]", "force = [0, -1]")
    scene.write_text(BLOCKS % 30 + pressed + '[loading]\nscaled = ["push"]\n')
    assert "carry any load factor" in CliRunner().invoke(app, ["bound", str(scene)]).output


def test_bound_of_a_scene_without_contact_is_refused(tmp_path):
    scene = tmp_path / "whole.toml"
    scene.write_text(BLOCKS.replace("[contact]\n", "") % 30)
    told = CliRunner().invoke(app, ["bound", str(scene)])
    assert told.exit_code == 1
    assert "[contact] is missing" in " ".join(told.output.split())


TOE = """
plane = "stress"
[contact]
[gravity]
[interfaces.smooth]
between = "any"
friction_angle = 0.0
[interfaces.rough]
between = ["b", "g"]
friction_angle = %s
%s
"""
"""A wedge on a smooth slope of 45 degrees that presses on a block, flush with it, on the flat."""
MATTER = "[materials.%s]\nyoung_modulus = 1e9\npoisson_ratio = 0.0\ndensity = 2000.0\n"
OUTLINES = {
    "ground": ("g", [[-4, 4], [-4, -2], [6, -2], [6, 0], [0, 0]]),
    "wedge": ("w", [[0, 0], [0, 2], [-2, 2]]),
    "block": ("b", [[0, 0], [2, 0], [2, 2], [0, 2]]),
}


SIDE_BY_SIDE = {
    "ground": ("g", [[-4, 4], [-4, -2], [0, -2], [0, 0]]),
    "ground below the block": ("g", [[0, 0], [0, -2], [6, -2], [6, 0]]),
}


def toe(friction, outlines=OUTLINES, mirrored=False):
    matter = "".join(MATTER % name for name in "gwb")
    flip = np.array([-1 if mirrored else 1, 1])
    blocks = (
        f'[[blocks]]\nname = "{name}"\nmaterial = "{of}"\nvertices = {(outline * flip).tolist()}\n'
        for name, (of, outline) in outlines.items()
    )
    held = (
        f'[[supports]]\nname = "{name}"\nblock = "{name}"\nfix = ["x", "y"]\n'
        for name, (of, _) in outlines.items()
        if of == "g"
    )
    return TOE % (np.arctan(friction), matter + "".join([*blocks, *held]))


# Least pressure on the block: the slope's force N acts at the upper end of the wedge, W of which
# acts at a third of its width; about the toe W 2/3 = N 2 sqrt(2), and the block, of 2 W, is pushed
# by N / sqrt(2) = W / 6, while the toe stands on the flat with 5 W / 6. So friction of 1 / 12.
@pytest.mark.parametrize("share", [0.999, 1.001])
@pytest.mark.parametrize("ground", [{}, SIDE_BY_SIDE], ids=["one body", "two bodies"])
@pytest.mark.parametrize("mirrored", [False, True])
@pytest.mark.parametrize("cover", [{}, {"type": "triangles", "size": 0.5}], ids=["blocks", "mesh"])
def test_a_toe_stands_on_the_flat_beside_a_flush_block_in_the_static_theorem(
    share, ground, mirrored, cover
):
    scene = nmm.parse_scene(toe(0.3, OUTLINES | ground, mirrored))
    made = prepare(scene, nmm.Formulation.model_validate({"cover": cover}))
    found = carried(made.stepper, made.start, 1.0, weaker=0.3 * 12 * share)
    assert found.fails == (share > 1)


@pytest.mark.parametrize("cover", [{}, {"type": "triangles", "size": 0.5}])
def test_a_toe_on_the_flat_beside_a_flush_block_is_at_rest_at_once(cover):
    formulation = nmm.Formulation.model_validate({"cover": cover})
    found = nmm.run(nmm.parse_scene(toe(0.3)), formulation).summary
    assert (found.status, found.sentence) == ("converged", "equilibrium at load factor 1")


# Of two bodies the slope and the flat are held as well, but their seam ends where the toe stands.
@pytest.mark.parametrize(
    ("friction", "status", "mirrored"),
    [(0.082, "collapsed", True), (0.085, "converged", True), (0.3, "converged", False)],
)
def test_a_toe_in_a_kink_of_two_bodies_stands_as_soon_as_friction_may_hold_the_block(
    friction, status, mirrored
):
    scene = nmm.parse_scene(toe(friction, OUTLINES | SIDE_BY_SIDE, mirrored))
    assert nmm.run(scene).summary.status == status


def test_a_run_until_failure_tells_its_bound_beside_what_it_found():
    text = BLOCKS % 45 + PUSH % (2.0, WEIGHT)
    text += '[loading]\nscaled = ["push"]\nuntil = "failure"\n'
    found = run(text, increment=0.1)
    assert found.failure_bound == pytest.approx(0.25, rel=1e-5)
    assert 0.99 * found.failure_bound <= found.failure_factor <= found.failure_bound


def test_a_bond_carries_its_strength_in_the_static_theorem():
    more = 'tensile_strength = 1e5\ncohesion = 1e9\nbonded = true\n[[blocks]]\nname = "base"'
    text = BLOCKS.replace('[[blocks]]\nname = "base"', more) % 30
    pull = PUSH % (2.0, 0.0)
    text += pull.replace("force = [0.0, 0]", "force = [0, 1.0e6]").replace("[0, 2.0]", "[0.5, 2.0]")
    text += '[loading]\nscaled = ["push"]\n'
    made = prepare(nmm.parse_scene(text), nmm.Formulation())
    # 1e5 Pa on 1 m2 and the weight, of 1e6 N.
    right = (1e5 + WEIGHT) / 1e6
    assert carried(made.stepper, made.start, 1.0).factor == pytest.approx(right, rel=1e-5)


@pytest.mark.parametrize("law", ["", 'law = "linear_softening"\nfracture_energy = 100\n'])
@pytest.mark.parametrize("strength", [1e3, 1e5])
def test_a_bonded_block_turns_over_about_its_corner_in_the_static_theorem(law, strength):
    # No bond pulls by more than its strength, nothing pushes beyond the corner: (W + f A) b / 2 h.
    # Within its Gauss points, of which ends tell once bonds give way, it would be 0.577 of that.
    more = f"tensile_strength = {strength}\ncohesion = 1e9\nbonded = true\n{law}"
    text = BLOCKS.replace('[[blocks]]\nname = "base"', more + '[[blocks]]\nname = "base"') % 30
    made = prepare(nmm.parse_scene(text + PUSH % (2.0, 1.0)), nmm.Formulation())
    right = (WEIGHT + strength) * 0.5 / 2.0
    assert load_bound(made.stepper, made.start).factor == pytest.approx(right, rel=1e-6)


def test_a_proof_says_that_bonds_which_broke_before_count_as_broken(monkeypatch):
    made = prepare(nmm.parse_scene(BLOCKS % 45 + PUSH % (2.0, WEIGHT)), nmm.Formulation())
    whole = carried(made.stepper, made.start, 1.0)
    monkeypatch.setattr(type(made.stepper), "broken_bonds", 1)
    torn = carried(made.stepper, made.start, 1.0)
    assert torn.factor == whole.factor
    assert whole.sentence.endswith("(static theorem)")
    assert torn.sentence.endswith("(static theorem, bonds that broke before counted as broken)")


def test_a_block_pushed_over_is_a_failed_structure_with_its_proof():
    text = BLOCKS % 45 + PUSH % (2.0, WEIGHT) + '[loading]\nscaled = ["push"]\n'
    found = run(text, increment=0.1)
    assert found.status == "collapsed"
    assert "static theorem" in found.sentence
    assert found.failure_factor == pytest.approx(0.25, rel=0.006)


@pytest.mark.parametrize(
    ("height", "friction", "right"), [(1.8, 60, 0.5 / 1.8), (0.2, 30, 0.57735)]
)
def test_a_block_led_at_once_beyond_its_limit_is_told_what_it_carries(height, friction, right):
    found = run(BLOCKS % friction + PUSH % (height, WEIGHT))
    assert found.status == "collapsed"
    said = float(found.sentence.split("no more than load factor ")[1].split(" ")[0])
    assert said == pytest.approx(right, rel=1e-5)
    assert "lower the load" in found.sentence


@pytest.mark.parametrize("share", [0.995, 1.005])
@pytest.mark.parametrize("enforcement", ["penalty", "cone"])
@pytest.mark.parametrize(
    ("height", "friction", "right"), [(1.8, 60, 0.5 / 1.8), (0.2, 30, 0.57735)]
)
def test_a_load_just_below_the_limit_is_carried_and_one_just_above_is_not(
    height, friction, right, enforcement, share
):
    # Springs of 10 E let the block lean by 4e-5 of its width; half a percent is far from that.
    text = BLOCKS % friction + PUSH % (height, share * right * WEIGHT)
    text += f'[formulation.contact]\nenforcement = "{enforcement}"\n'
    scene = nmm.parse_scene(text)
    found = nmm.run(scene, scene.formulation).summary
    assert found.status == ("converged" if share < 1 else "collapsed")
    assert share < 1 or "static theorem" in found.sentence


def test_a_block_on_a_slope_too_steep_for_it_is_a_failed_structure():
    # arctan(3 / 8) is 20.6 degrees.
    turned = BLOCKS.replace("[gravity]", "[gravity]\nacceleration = [3.0, -8.0]")
    assert run(turned % 19).status == "collapsed"
    assert run(turned % 22).status == "converged"


def test_a_solver_that_gives_up_says_that_the_structure_may_carry_more():
    """Two passes of springs are too few for a block that slides on one corner and lifts another."""
    text = BLOCKS % 30 + PUSH % (1.0, 0.4 * WEIGHT) + '[loading]\nscaled = ["push"]\n'
    table = {
        "contact": {"options": {"iteration": "open_close"}, "max_passes": 1},
        "loading": {"increment": 1.0},
    }
    found = nmm.run(nmm.parse_scene(text), nmm.Formulation.model_validate(table)).summary
    assert found.status == "failed"
    assert "may carry more" in found.sentence or "relaxation" in found.sentence


def test_a_spent_budget_keeps_what_was_reached():
    text = BLOCKS % 30 + PUSH % (0.02, 0.5 * WEIGHT) + '[loading]\nscaled = ["push"]\n'
    found = run(text, increment=0.1, max_steps=3)
    assert found.status == "budget_spent"
    assert found.steps == 3
    assert "load factor 0.3" in found.sentence
    found = run(text, increment=0.1, budget=1e-6)
    assert (found.status, found.steps) == ("budget_spent", 0)


def test_a_run_that_its_budget_of_steps_stops_is_where_a_run_to_there_ends():
    """Loads of 0.3 as three steps and as a part of 1.0 differ by rounding alone, audits too."""
    text = BLOCKS % 30 + PUSH % (0.02, 0.5 * WEIGHT) + '[loading]\nscaled = ["push"]\n'
    made = {"loading": {"increment": 0.1}}, {"loading": {"increment": 0.1, "max_steps": 3}}
    scenes = (nmm.parse_scene(text + f"until = {until}\n") for until in (0.3, 1.0))
    whole, stopped = (
        nmm.run(scene, nmm.Formulation.model_validate(one))
        for scene, one in zip(scenes, made, strict=True)
    )
    assert (whole.summary.status, stopped.summary.status) == ("converged", "budget_spent")
    strain = whole.state.deformation
    np.testing.assert_allclose(
        stopped.state.deformation, strain, rtol=0, atol=1e-9 * np.abs(strain).max()
    )
    np.testing.assert_allclose(
        stopped.state.frames.centre, whole.state.frames.centre, rtol=0, atol=1e-12
    )
    audits = whole.summary.audits
    assert audits.keys() - stopped.summary.audits.keys() == {"force_balance"}
    for name, value in stopped.summary.audits.items():
        assert value == pytest.approx(audits[name], rel=1e-6, abs=1e-12)


def test_a_dynamic_run_ends_with_its_budget():
    text = "duration = 1.0\n" + BLOCKS % 30 + "[inertia]\n"
    table = {"loading": {"max_steps": 5}, "integrator": {"step": 0.01}}
    done = nmm.run(nmm.parse_scene(text), nmm.Formulation.model_validate(table))
    assert done.summary.status == "budget_spent"
    assert done.state.time == pytest.approx(0.05)
    assert np.isclose(done.frames[-1].time, 0.05)


def test_every_end_has_its_words_and_its_own_code():
    assert set(EXIT_CODES) == set(MEANT)
    failures = [code for code in EXIT_CODES.values() if code]
    assert len(set(failures)) == len(failures) == 4
    assert 1 not in failures  # faults of the files


ENDS = [
    (BLOCKS % 45 + PUSH % (2.0, 0.1 * WEIGHT), [], 0),
    (BLOCKS % 45 + PUSH % (2.0, WEIGHT) + '[loading]\nscaled = ["push"]\n', [], 4),
    (BLOCKS % 45 + PUSH % (2.0, 0.1 * WEIGHT), ["--budget", "1e-9"], 3),
]


@pytest.mark.parametrize(("text", "options", "code"), ENDS)
def test_the_command_line_leaves_with_the_code_of_the_end(tmp_path, text, options, code):
    scene = tmp_path / "a.toml"
    scene.write_text(text)
    told = CliRunner().invoke(app, ["run", str(scene), "--out", str(tmp_path / "r"), *options])
    assert told.exit_code == code, told.output


PULL = '[[loads]]\nname = "pull"\nkind = "body"\nblock = "b"\nfield = ["%s", "0"]\n'
IN_TIME = "duration = 0.01\n[inertia]\n[formulation.integrator]\nstep = 1e-3\n"


def in_time(field):
    head, rest = IN_TIME.split("\n", 1)
    return head + BLOCKS % 30 + PULL % field + rest


def test_a_load_that_is_infinite_on_the_way_ends_the_run_with_what_it_had(tmp_path):
    found = nmm.run(nmm.parse_scene(in_time("1e3 / abs(t - 0.005)")), out=tmp_path / "run")
    assert found.summary.status == "failed"
    told = "broken off at 0.004 s, after 4 steps: [[loads]] pull: field is [inf, 0.0] at "
    assert found.summary.sentence.startswith(told)
    assert found.history["time"] == pytest.approx([1e-3, 2e-3, 3e-3, 4e-3])
    assert found.frames[-1].time == pytest.approx(4e-3)
    stored = nmm.results.read_run(tmp_path / "run")
    assert (stored.summary.status, stored.faults) == ("failed", ())
    assert len(stored.history["time"]) == 4


@pytest.mark.parametrize(
    "field", ["1 / t", "log(t)", "sqrt(0.0099 - t)", "0 / 0", "1 / (0.01 - t)"]
)
def test_a_load_that_is_no_number_as_its_run_begins_or_ends_is_refused_before(field):
    scene = nmm.parse_scene(in_time(field))
    with pytest.raises(nmm.NmmError, match="pull: field is .*expected finite values wherever"):
        prepare(scene, scene.formulation)


def test_a_budget_of_no_seconds_is_spent_at_once():
    found = nmm.run(nmm.parse_scene(in_time("0")), budget=0.0).summary
    assert (found.status, found.steps) == ("budget_spent", 0)
    assert "the budget of 0 s was spent" in found.sentence
