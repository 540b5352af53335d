"""Seconds of a run by effect: what an effect causes is its own, and the shares sum to the run."""

import re
from time import sleep

import pytest

import nmm
from nmm.effects.gravity import Gravity
from nmm.results.sink import MemorySink
from nmm.results.summary_lines import rows
from nmm.splitting.splitting import Splitting
from nmm.stepping.step import clock

SLIDING = """
plane = "strain"
duration = 0.1
[materials.rock]
young_modulus = "1 GPa"
poisson_ratio = 0.2
density = 2500
[[blocks]]
name = "floor"
material = "rock"
vertices = [[-1, -1], [5, -1], [5, 0], [-1, 0]]
[[blocks]]
name = "stone"
material = "rock"
vertices = [[0, 0], [1, 0], [1, 0.5], [0, 0.5]]
[[supports]]
name = "held"
block = "floor"
fix = ["x", "y"]
[[initial_velocities]]
block = "stone"
velocity = [1, 0]
[inertia]
[gravity]
[contact]
[interfaces.dry]
friction_angle = "25 deg"
[formulation.integrator]
step = 1e-3
"""


def test_search_and_further_solutions_of_blocks_that_slide_are_contact_s():
    nmm.run(nmm.parse_scene(SLIDING))  # compiled
    summary = nmm.run(nmm.parse_scene(SLIDING)).summary
    more = 1 - summary.steps / summary.passes
    own = summary.seconds["search"] + summary.seconds["contact"]
    caused = own + more * summary.seconds["solve"]
    assert summary.effect_seconds["contact"] >= caused
    assert summary.effect_seconds["contact"] < sum(summary.seconds.values())


def test_the_shares_that_are_told_sum_to_the_run():
    summary = nmm.run(nmm.parse_scene(SLIDING)).summary
    told = dict(rows(summary))["seconds by effect"]
    whole, parts = re.fullmatch(r"(\S+) \((.*)\)", told).groups()
    shares = [float(part.rsplit(" ", 1)[1]) for part in parts.split(", ")]
    assert parts.rsplit(", ", 1)[1].startswith("all else")
    # Numbers are told with three digits.
    assert sum(shares) == pytest.approx(float(whole), rel=0.02)
    assert float(whole) == pytest.approx(sum(summary.seconds.values()), rel=0.01)


def _slower(monkeypatch, owner, name, seconds=2e-3):
    """Let a method take longer by some seconds."""
    method = getattr(owner, name)
    monkeypatch.setattr(owner, name, lambda *given: sleep(seconds) or method(*given))


def test_a_phase_within_another_counts_once(monkeypatch):
    times = iter([0.0, 1.0, 4.0, 10.0])
    monkeypatch.setattr(clock, "perf_counter", lambda: next(times))
    measured = clock.Clock()
    with measured.phase("path"), measured.phase("search"):
        pass
    assert measured.seconds == {"path": 7.0, "search": 3.0}


def test_what_an_effect_is_asked_for_after_a_step_is_its_own(monkeypatch):
    _slower(monkeypatch, Gravity, "work")
    summary = nmm.run(nmm.parse_scene(SLIDING)).summary
    assert summary.effect_seconds["gravity"] >= 2e-3 * summary.steps


def test_what_rows_and_frames_take_is_that_of_reports(monkeypatch):
    _slower(monkeypatch, MemorySink, "row")
    summary = nmm.run(nmm.parse_scene(SLIDING)).summary
    assert summary.seconds["reports"] >= 2e-3 * summary.steps


def test_what_an_event_takes_is_counted_once(monkeypatch):
    _slower(monkeypatch, Splitting, "event", 2e-2)
    asks = SLIDING + "[splitting.rock]\ntensile_strength = 1e9\nsmallest_block = 0.02\n"
    summary = nmm.run(nmm.parse_scene(asks)).summary
    # Counted twice they are nearly twice the run, whose steps take less than an event.
    assert sum(summary.effect_seconds.values()) < sum(summary.seconds.values())
    assert summary.effect_seconds["splitting"] >= 2e-2 * summary.steps
