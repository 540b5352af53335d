"""Water in the joints of scenes: coupling, restarts, other stages, and faults by line."""

import numpy as np
import pytest

import nmm
from nmm.errors import SceneError
from nmm.testing import check_effect_of
from nmm.testing.resumed.stopping import check_goes_on
from nmm.testing.scenes import wet_pile

PILE = (
    """
title = "pile"
plane = "strain"
[gravity]
[contact]
[joint_flow]
"""
    + wet_pile()
    + """
[[joint_heads]]
name = "out"
point = [4, 0]
head = 0.0
"""
)


def test_a_pile_with_water_in_its_joints_is_in_balance_with_it():
    run = nmm.run(nmm.parse_scene(PILE))
    assert run.summary.status == "converged"
    flow = run.stepper.plan.effects["joint flow"]
    heads = flow.heads(run.state, run.state.time)
    pressure = flow.pressures(run.state, run.state.time)
    places = flow.sites.places
    # The vertical joint is a dead end: it has the head of its root, and less pressure above.
    root, top = (int(np.argmin(np.hypot(*(places - at).T))) for at in ([2, 0], [2, 1]))
    assert heads[top] == pytest.approx(heads[root], rel=1e-12)
    assert 0 < heads[root] < 1.5
    assert pressure[top] == pytest.approx(max(heads[top] - 1, 0) * 9810, abs=1e-6)
    # What flows in flows out.
    taken = run.history["joint flow:inflow:in"][-1] + run.history["joint flow:inflow:out"][-1]
    assert abs(taken) < 1e-12 * run.history["joint flow:inflow:in"][-1]
    # Contact and water on the base carry the weight: its faces lie level.
    last = run.frames[-1]
    level = abs(last.contact_normal[:, 1]) > 0.9
    uplift = 9810 * 2 * (1.5 / 2 + heads[root])
    carried = -last.contact_force[level, 0].sum()
    assert carried + uplift == pytest.approx(4 * 2500 * 9.81, rel=1e-3)


def test_water_in_joints_keeps_what_every_effect_promises():
    check_effect_of(nmm.parse_scene(PILE), "joint flow")


def test_a_pile_with_water_goes_on_from_a_checkpoint(tmp_path):
    text = PILE + (
        "[formulation.solver]\ntype = 'superlu'\n[loading]\nuntil = 1.0\n[[loads]]\nname = 'top'\n"
        "kind = 'edge'\nsegment = [[0, 1], [4, 1]]\ntraction = [0, -1e4]\n"
        "[formulation.loading]\nincrement = 0.1\n[output]\ncheckpoint = { every_steps = 3 }\n"
    )
    check_goes_on(nmm.parse_scene(text), tmp_path)


def test_joints_are_found_again_when_a_block_leaves():
    stages = '[[stages]]\nname = "three"\n[[stages]]\nname = "less"\nremove = ["right"]\n'
    text = PILE.replace("point = [4, 0]", "point = [2, 0]") + stages
    run = nmm.run(nmm.parse_scene(text))
    assert run.summary.status == "converged"
    assert len(run.stepper.plan.effects["joint flow"].network.length) == 1


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        (
            'aperture = "0.2 mm"',
            'aperture = "-0.2 mm"',
            "interfaces.joint.aperture: .*an initial aperture",
        ),
        ('"0.01 mm"', '"0.3 mm"', "interfaces.joint: residual_aperture.*of the aperture"),
        ("[joint_flow]\n", "", "joint_heads: no .joint_flow."),
        ('name = "out"', 'name = "in"', "a name of its own"),
        ("head = 0.0", "head = 0.0\nblock = 'base'", "a point or a segment"),
    ],
)
def test_what_contradicts_itself_is_refused_by_line(old, new, said):
    with pytest.raises(SceneError, match=said):
        nmm.parse_scene(PILE.replace(old, new))


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("point = [4, 0]", "point = [3, 0.5]", "joint_heads.1: .*a place where a joint ends"),
        ('aperture = "0.2 mm"\n', "", "joint_flow: no joint"),
    ],
)
def test_water_without_a_way_is_refused_by_line(old, new, said):
    with pytest.raises(SceneError, match=said):
        nmm.run(nmm.parse_scene(PILE.replace(old, new)))


def test_joints_that_no_head_reaches_are_named_by_their_place():
    apart = PILE + (
        '[[blocks]]\nname = "far"\nmaterial = "rock"\n'
        "vertices = [[9, -1], [11, -1], [11, 0], [9, 0]]\n"
        '[[blocks]]\nname = "top"\nmaterial = "rock"\n'
        "vertices = [[9, 0], [11, 0], [11, 1], [9, 1]]\n"
        '[[supports]]\nname = "more"\nblock = "far"\nfix = ["x", "y"]\n'
    )
    with pytest.raises(SceneError, match=r"joint_flow: 2 ends of joints.*\((9|11), 0\)"):
        nmm.run(nmm.parse_scene(apart))
