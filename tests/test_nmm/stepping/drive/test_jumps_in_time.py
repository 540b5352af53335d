"""Time that passes without inertia over a jump from one equilibrium to the next."""

import re

import numpy as np
import pytest

import nmm
from nmm.testing.resumed.stopping import check_goes_on

WEDGES, INNER, OUTER, LOAD, LASTS = 8, 5.0, 6.0, 3e5, 2.0


def wedge(name, low, high):
    """Return a stone of the ring between two angles (degrees)."""
    turns = np.radians([low, high, high, low])
    radii = np.array([INNER, INNER, OUTER, OUTER])
    corners = np.column_stack([radii * np.cos(turns), radii * np.sin(turns)]).tolist()
    corners = corners[::-1]
    return f'[[blocks]]\nname = "{name}"\nmaterial = "stone"\nvertices = {corners}\n'


def arch(step, more=""):
    """Return an arch of eight stones over which a force goes 1 m in 2 s."""
    turns = np.linspace(20, 160, WEDGES + 1)
    stones = [wedge(f"stone {n}", *turns[n : n + 2]) for n in range(WEDGES)]
    springers = wedge("right", 10, 20) + wedge("left", 160, 170)
    top = OUTER * np.array([np.cos(np.radians(turns[3:5])), np.sin(np.radians(turns[3:5]))])
    way = top.T[::-1].tolist()
    return f"""plane = "strain"
[materials.stone]
young_modulus = "30 GPa"
poisson_ratio = 0.2
density = 2400
{"".join(stones)}{springers}
[[supports]]
name = "right"
block = "right"
fix = ["x", "y"]
[[supports]]
name = "left"
block = "left"
fix = ["x", "y"]
[gravity]
[contact]
[interfaces.joints]
friction_angle = 0.6
[[loads]]
name = "wheel"
kind = "moving"
segment = {way}
force = [0, -{LOAD}]
speed = {1 / LASTS}
[[stages]]
name = "weight"
loads = []
[[stages]]
name = "crossing"
loads = ["wheel"]
duration = {LASTS}
[[monitors]]
name = "crown"
point = {way[0]}
block = "stone 3"
{more}
[formulation.integrator]
step = {step}
"""


def test_a_load_crosses_an_arch_that_jumps_to_another_equilibrium():
    """When the load has gone 0.24 m a joint opens at once, and the crown is 7.3 um higher.

    No step found the one equilibrium from the other, down to 1/1024 of the step that was asked for,
    and the run ended ``failed``.
    """
    place = np.array([OUTER * np.cos(np.radians(72.5)), OUTER * np.sin(np.radians(72.5))])
    place = np.array([0.0, OUTER]) + (place - [0, OUTER]) / np.hypot(*(place - [0, OUTER]))
    put_there = f'kind = "point"\nblock = "stone 3"\npoint = {place.tolist()}\n'
    at_once = re.sub(r'kind = "moving"\nsegment = .*\n', put_there, arch(0.2))
    at_once = at_once.replace(f"speed = {1 / LASTS}\n", "").replace(f"duration = {LASTS}\n", "")
    stands = nmm.run(nmm.parse_scene(at_once)).history["monitor:crown:uy"][-1]
    ends = []
    for step in (0.2, 0.05):
        run = nmm.run(nmm.parse_scene(arch(step)))
        assert run.summary.status == "converged", run.summary.sentence
        assert "jumped to rest" in run.summary.sentence
        up = run.history["monitor:crown:uy"]
        assert up[-1] == pytest.approx(stands, rel=0.02)  # what friction holds depends on the way
        ends.append(up[-1])
    assert ends[0] == pytest.approx(ends[1], rel=1e-5)


def test_a_run_that_jumped_goes_on_bit_by_bit(tmp_path):
    more = "[output.checkpoint]\nevery_steps = 1\n"
    before_it = 8
    whole = check_goes_on(nmm.parse_scene(arch(0.2, more)), tmp_path, before_it)
    assert "jumped to rest" in whole.summary.sentence
