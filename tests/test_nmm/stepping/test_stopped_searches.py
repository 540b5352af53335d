"""Searches for a factor of safety that are stopped or killed go on to the same bytes."""

import importlib.util
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

import nmm
from nmm.stepping import strength_reduction
from nmm.testing.stopping import stopped_after

HERE = Path(__file__)
SPEC = importlib.util.spec_from_file_location("resumed", HERE.with_name("test_resume.py"))
resumed = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(resumed)

# A block on an incline of 30 degrees: its factor is tan 20 / tan 30 = 0.63 without cohesion.
INCLINE = """
plane = "strain"
[materials.rock]
young_modulus = "1 GPa"
poisson_ratio = 0.2
density = "2000 kg/m^3"
[interfaces.joint]
friction_angle = "20 deg"
[[blocks]]
name = "slope"
material = "rock"
vertices = [[0, 0], [5.196152422706632, 0], [5.196152422706632, 3]]
[[blocks]]
name = "block"
material = "rock"
vertices = [
    [1.7320508075688772, 1], [2.598076211353316, 1.5],
    [2.348076211353316, 1.9330127018922192], [1.4820508075688772, 1.4330127018922193],
]
[[supports]]
name = "ground"
block = "slope"
fix = ["x", "y"]
[gravity]
[contact]
[strength_reduction]
tolerance = 0.05
[output]
checkpoint = { every_steps = 1 }
"""


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    folder = tmp_path_factory.mktemp("safety") / "whole"
    return nmm.run(nmm.parse_scene(INCLINE, "scene"), out=folder)


@pytest.mark.parametrize(("what", "count"), [("step", 0), ("step", 2), ("write", 7), ("write", 14)])
def test_a_killed_search_goes_on_to_the_same_bytes(what, count, whole, tmp_path):
    (tmp_path / "scene.toml").write_text(INCLINE)
    places = tmp_path / "scene.toml", tmp_path / "half"
    done = subprocess.run(
        [sys.executable, "-c", resumed.KILLED, *places, what, str(count)],
        env={**os.environ, "PYTHONPATH": str(resumed.ROOT)},
        capture_output=True,
        timeout=600,
    )
    assert done.returncode == -signal.SIGKILL, done.stderr
    again = nmm.resume(tmp_path / "half")
    for scratch in (tmp_path / "half").rglob(".*.tmp"):
        scratch.unlink()
    resumed.check_same(whole, again, (whole.folder, tmp_path / "half"))
    # tan 20 / tan 30, within the width that is asked for
    assert again.summary.factor_of_safety <= 0.6304 <= again.summary.factor_that_fails + 1e-4


def test_factors_that_were_tried_are_not_tried_again(whole, tmp_path, monkeypatch):
    stopped_after(nmm.parse_scene(INCLINE, "scene"), tmp_path / "half", 2)
    tried, weaken = [], strength_reduction.weakened
    monkeypatch.setattr(
        strength_reduction,
        "weakened",
        lambda scene, factor: tried.append(factor) or weaken(scene, factor),
    )
    again = nmm.resume(tmp_path / "half")
    assert not {1.0, 0.5} & set(tried)  # the first two fail and hold
    assert again.summary.factor_of_safety == whole.summary.factor_of_safety
