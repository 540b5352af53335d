"""Seconds of a run by effect: what an effect causes is its own, and the shares sum to the run."""

import re

import pytest

import nmm
from nmm.results.summary_lines import rows

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
    caused = summary.seconds["search"] + more * summary.seconds["solve"]
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
