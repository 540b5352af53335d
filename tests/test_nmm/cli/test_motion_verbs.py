"""The verb that writes response spectra."""

from typer.testing import CliRunner

import nmm
from nmm.cli.app import app

SCENE = """
title = "shaken block"
plane = "strain"
duration = 0.2
[materials.rock]
density = 2500
young_modulus = "1 GPa"
poisson_ratio = 0.2
[[blocks]]
name = "block"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[records.shake]
samples = [[0, 0], [0.05, 6], [0.15, -6], [0.2, 0]]
[[supports]]
name = "base"
segment = [[0, 0], [1, 0]]
fix = ["x", "y"]
motion = { x = "shake" }
[[monitors]]
name = "top"
point = [0.5, 1]
[inertia]
[formulation.integrator]
step = 0.01
"""


def test_a_spectrum_is_written_as_numbers_and_as_a_picture(tmp_path):
    nmm.run(nmm.parse_scene(SCENE), out=tmp_path / "run")
    told = CliRunner().invoke(app, ["spectrum", str(tmp_path / "run"), "top", "--damping", "0.02"])
    assert told.exit_code == 0, told.output
    lines = (tmp_path / "run" / "spectrum_top_x.csv").read_text().splitlines()
    assert lines[0].startswith("period_s,displacement_m")
    assert len(lines) == 101
    assert (tmp_path / "run" / "spectrum_top_x.png").stat().st_size > 5000


def test_a_monitor_that_is_not_there_is_told(tmp_path):
    nmm.run(nmm.parse_scene(SCENE), out=tmp_path / "run")
    told = CliRunner().invoke(app, ["spectrum", str(tmp_path / "run"), "tip"])
    assert told.exit_code == 1
    assert "expected one of top" in told.output.replace("\n", " ")
