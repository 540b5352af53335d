"""`nmm compile`: what runs of blocks need is there before the first of them."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

import nmm
from nmm.cli.app import app

ROOT = Path(__file__).parents[3]


def test_it_runs_scenes_smaller_than_those_of_the_examples(monkeypatch):
    run = []
    monkeypatch.setattr(nmm, "run", run.append, raising=False)
    assert CliRunner().invoke(app, ["compile"]).exit_code == 0
    beam, wall = run
    assert 24 < beam.tessellations[0].blocks < 130
    assert beam.loading.until == "failure"
    assert wall.inertia is not None
    assert wall.duration < nmm.read_scene(ROOT / "examples/stack/stack.toml").duration


DEMO = """
import numba.core.event as events
from nmm.cli.app import app
counted = events.RecordingListener()
events.register("numba:compile", counted)
app(["demo", "-q", "-o", "run"], standalone_mode=False)
print(len(counted.buffer))
"""


@pytest.mark.slow
def test_after_it_the_demonstration_compiles_nothing(tmp_path):
    place = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path), "PYTHONPATH": str(ROOT)}
    how = {"check": True, "capture_output": True, "text": True, "env": place, "cwd": tmp_path}
    code = "from nmm.cli.app import app; app(['compile'])"
    subprocess.run([sys.executable, "-c", code], **how)
    found = subprocess.run([sys.executable, "-c", DEMO], **how)
    assert found.stdout.splitlines()[-1] == "0"
