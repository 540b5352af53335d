"""Searches for a factor of safety that are stopped or killed go on to the same bytes."""

import pytest

import nmm
from nmm.stepping.safety import strength_reduction
from nmm.testing.resumed.killing import check_same_bytes, killed_and_gone_on
from nmm.testing.resumed.stopping import stopped_after
from nmm.testing.scenes import block_on_incline

# A block on an incline of 30 degrees: its factor is tan 20 / tan 30 = 0.63 without cohesion.
INCLINE = block_on_incline(30, 20, search="tolerance = 0.05") + (
    "[output]\ncheckpoint = { every_steps = 1 }\n"
)


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    folder = tmp_path_factory.mktemp("safety") / "whole"
    return nmm.run(nmm.parse_scene(INCLINE, "scene"), out=folder)


@pytest.mark.parametrize(
    ("what", "count"),
    [
        ("step", 2),
        ("write", 7),
        pytest.param("step", 0, marks=pytest.mark.slow),
        pytest.param("write", 14, marks=pytest.mark.slow),
    ],
)
def test_a_killed_search_goes_on_to_the_same_bytes(what, count, whole, tmp_path):
    (tmp_path / "scene.toml").write_text(INCLINE)
    again = killed_and_gone_on(tmp_path / "scene.toml", tmp_path / "half", what, count)
    check_same_bytes(whole, again, (whole.folder, tmp_path / "half"))
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
