"""Factors of safety of what is built and cut in stages: those over which all stages hold."""

import numpy as np
import pytest

import nmm
from nmm.errors import SceneError
from nmm.scene import parse_scene
from nmm.testing.resumed.killing import check_same_bytes, killed_and_gone_on
from nmm.testing.scenes import block_on_incline
from nmm.verification import text

ALONG = np.array([np.cos(np.pi / 6), np.sin(np.pi / 6)])
OFF = 0.5 * np.array([-ALONG[1], ALONG[0]])
STOP = text.block("stop", "rock", np.array([ALONG, 2 * ALONG, 2 * ALONG + OFF, ALONG + OFF]))
CUT = '[[stages]]\nname = "in place"\n[[stages]]\nname = "cut"\nremove = ["stop"]\n'
LATE = (
    '[[stages]]\nname = "bare"\nremove = ["stop"]\n'
    '[[stages]]\nname = "held"\nadd = ["stop"]\nsupports = ["hold slope", "hold stop"]\n'
)


def stopped(stages, more=""):
    """A block on an incline of 30 degrees, friction 40, before a stop that is held and cut away."""
    incline = block_on_incline(30, 40, search="tolerance = 0.02\nhighest = 3.0")
    return incline + STOP + text.fixed_block("stop") + stages + more


def test_a_block_whose_stop_is_cut_away_is_as_safe_as_without_it():
    """``tan 40 / tan 30``; with the stop it holds whatever its friction."""
    assert nmm.run(parse_scene(stopped(""))).summary.factor_that_fails is None
    found = nmm.run(parse_scene(stopped(CUT))).summary
    assert found.factor_of_safety <= np.tan(np.radians(40)) * np.sqrt(3) <= found.factor_that_fails
    assert found.factor_that_fails - found.factor_of_safety <= 0.02


def test_a_stage_on_the_way_that_holds_least_gives_the_factor_and_is_named():
    found = nmm.run(parse_scene(stopped(LATE))).summary
    # Blocks shorten by 1e-5, and are at rest within the tolerance of the run.
    low, high = found.factor_of_safety, found.factor_that_fails * (1 + 1e-4)
    assert low <= np.tan(np.radians(40)) * np.sqrt(3) <= high
    assert "stage bare" in found.sentence


def test_ground_that_is_cut_free_bears_twice_its_cohesion():
    """``F = 2 c / q`` under an even load once its side is free."""
    block = text.block("ground", "clay", [(0, 0), (1, 0), (1, 2), (0, 2)])
    side = text.block("side", "clay", [(1, 0), (2, 0), (2, 2), (1, 2)])
    supports = {
        "foot": ("[[0, 0], [2, 0]]", "y"),
        "left": ("[[0, 0], [0, 2]]", "x"),
        "right": ("[[2, 0], [2, 2]]", "x"),
    }
    run = nmm.run(
        parse_scene(
            text.scene(
                'plane = "strain"\n[strength_reduction]\nhighest = 4.0\n',
                [
                    '[materials.clay]\nlaw = "mohr_coulomb"\nyoung_modulus = 1e8\n'
                    "poisson_ratio = 0.3\ncohesion = 1e5\nfriction_angle = 0\n",
                    *(block, side),
                    "[interfaces.glue]\nbonded = true\nfriction_angle = 0.5\n",
                    *(
                        f'[[supports]]\nname = "{name}"\nsegment = {at}\nfix = ["{axis}"]\n'
                        for name, (at, axis) in supports.items()
                    ),
                    '[[loads]]\nname = "load"\nkind = "edge"\nsegment = [[0, 2], [1, 2]]\n'
                    "traction = [0, -120e3]\n",
                    '[[stages]]\nname = "in place"\n'
                    '[[stages]]\nname = "cut"\nremove = ["side"]\nsupports = ["foot", "left"]\n',
                    '[formulation.cover]\ntype = "quads"\nsize = 0.5\ndegree = 2\n',
                ],
            )
        )
    )
    assert run.summary.status == "converged"
    assert run.summary.factor_of_safety <= 200 / 120 <= run.summary.factor_that_fails
    assert run.summary.factor_that_fails - run.summary.factor_of_safety <= 0.01


def test_a_killed_search_in_stages_goes_on_to_the_same_bytes(tmp_path):
    scene = stopped(CUT, "[output]\ncheckpoint = { every_steps = 1 }\n")
    (tmp_path / "scene.toml").write_text(scene)
    whole = nmm.run(nmm.parse_scene(scene, "scene"), out=tmp_path / "whole")
    again = killed_and_gone_on(tmp_path / "scene.toml", tmp_path / "half", "write", 9)
    check_same_bytes(whole, again, (whole.folder, tmp_path / "half"))


def test_stages_in_time_are_refused_by_line():
    with pytest.raises(SceneError, match=r"scene:\d+: stages.1.duration.*come to rest"):
        parse_scene(stopped(CUT.replace('"cut"\n', '"cut"\nduration = 5.0\n')))
