"""An enforcement, an integrator and a solver of a user's own are treated as built-in ones are.

Each passes everything on to a built-in part, under a name of its own: where numerics were chosen by
name or class, a digit would differ.
"""

from pathlib import Path

import numpy as np
import pytest

import nmm
from nmm.formulation import parse_formulation
from nmm.testing import check_enforcement, check_integrator, check_solver
from nmm.trust import allowing

HERE = "own_parts_for_a_run"
SCENE = """
title = "a block thrown on another"
plane = "stress"
{time}
[materials.rock]
young_modulus = 1e8
poisson_ratio = 0.2
density = 2e3
[interfaces.joint]
friction_angle = 0.4
[[blocks]]
name = "floor"
material = "rock"
vertices = [[0, 0], [4, 0], [4, 1], [0, 1]]
[[blocks]]
name = "top"
material = "rock"
vertices = [[1, 1], [2, 1], [2, 2], [1, 2]]
[[supports]]
name = "hold"
segment = [[0, 0], [4, 0]]
fix = ["x", "y"]
[[loads]]
name = "push"
kind = "edge"
segment = [[1, 1], [1, 2]]
traction = [5e3, 0]
[gravity]
[contact]
"""
TIMES = {
    "dynamic": 'duration = "20 ms"\n[inertia]\n',
    "static": "",
}
COVERS = {"blocks": 'type = "block"\n', "meshes": 'type = "triangles"\nsize = 0.6\ndegree = 1\n'}
# Table, built-in part, one's own.
PAIRS = {
    "exact enforcement": ("contact", "enforcement", "cone", "Exact"),
    "enforcement by springs": ("contact", "enforcement", "penalty", "Springs"),
    "integrator": ("integrator", "type", "newmark", "Rule"),
    "solver": ("solver", "type", "superlu", "Solver"),
}


@pytest.fixture(autouse=True)
def beside(monkeypatch):
    monkeypatch.syspath_prepend(str(Path(__file__).parent))


def history(part, name, cover, time):
    table, key, *_ = PAIRS[part]
    step = "" if table == "integrator" else "[integrator]\nstep = 1e-3\n"
    text = f'[cover]\n{COVERS[cover]}{step}[{table}]\n{key} = "{name}"\n'
    text += "step = 1e-3\n" if table == "integrator" else ""
    scene = nmm.parse_scene(SCENE.format(time=TIMES[time]))
    done = nmm.run(scene, parse_formulation(text), allow_code=[HERE])
    assert len(done.history["time"]) == (20 if time == "dynamic" else 1)
    return done.history


@pytest.mark.parametrize("time", TIMES)
@pytest.mark.parametrize("cover", COVERS)
@pytest.mark.parametrize("part", PAIRS)
def test_a_part_of_ones_own_gives_the_digits_of_the_one_it_passes_on_to(part, cover, time):
    *_, builtin, own = PAIRS[part]
    expected = history(part, builtin, cover, time)
    found = history(part, f"{HERE}:{own}", cover, time)
    assert set(found) == set(expected)
    for name, column in expected.items():
        assert np.array_equal(found[name], column, equal_nan=True), name


def test_parts_of_ones_own_are_held_to_the_suites_of_all():
    with allowing(HERE, folder=Path(__file__).parent):
        import own_parts_for_a_run as own

        check_enforcement(own.Exact(), seeds=range(5))
        check_enforcement(own.Springs(), seeds=range(5))
        check_integrator(own.Rule(), order=2.0)
        check_solver(own.Solver())
