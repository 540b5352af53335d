"""A linear step whose residual spoils it is no answer."""

import pytest

from nmm.scene import parse_scene
from nmm.solvers.linear import Factor
from nmm.stepping.run import run

SCENE = """
plane = "strain"
[materials.m]
young_modulus = 1e9
poisson_ratio = 0.2
density = 2000
[gravity]
[[blocks]]
name = "b"
material = "m"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[supports]]
name = "s"
segment = [[0, 0], [1, 0]]
fix = ["x", "y"]
"""


@pytest.mark.parametrize(
    ("left", "status"), [(1e-12, "converged"), (5e-5, "converged"), (5e-3, "failed")]
)
def test_residuals_are_in_the_summary_and_refused_above_a_ten_thousandth(
    left: float, status: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Factor, "relative_residual", lambda *_: left)
    summary = run(parse_scene(SCENE, "scene")).summary
    assert summary.status == status
    if status == "failed":
        assert "rounding leaves a residual of 5.0e-03" in summary.sentence
    else:
        assert summary.equilibrium_residual == left
