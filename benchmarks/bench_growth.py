"""Cracks that grow piece by piece: what a step costs beside one solution of the same model.

*One solution* assembles, factorises and solves a model of the same cells that is there already; a
step of growth finds the load of the present cracks, lets them grow, and changes the model. Seconds
of its phases are shares of the step.
"""

from functools import cache
from time import process_time
from typing import Any

import pytest

from nmm.effects.base import Instant
from nmm.formulation import Formulation
from nmm.results.sink import MemorySink
from nmm.scene.model import Scene
from nmm.scene.read import parse_scene
from nmm.stepping.prepare import prepare
from nmm.stepping.simulation import Simulation

SIZES = (0.05, 0.035, 0.025, 0.0175)
"""Cells of a plate of one by one."""
PIECES = 12
PHASES = ("change", "events", "assembly", "solve")

PLATE = """
plane = "strain"
[materials.m]
young_modulus = 1.0
poisson_ratio = 0.3
[[blocks]]
name = "plate"
material = "m"
vertices = [[0, -0.5], [1, -0.5], [1, 0.5], [0, 0.5]]
[[cracks]]
name = "notch"
points = [[-0.1, 0.0], [0.3, 0.0]]
[[supports]]
name = "floor"
segment = [[0, -0.5], [1, -0.5]]
fix = ["x", "y"]
[[loads]]
name = "up"
kind = "edge"
segment = [[0, 0.5], [1, 0.5]]
traction = [0, 1.0]
[fracture]
toughness = 1.0
increment = 0.01
max_growth = {growth}
control = "toughness"
"""


def plate(pieces: int) -> Scene:
    """Return the plate whose edge crack grows by so many pieces."""
    return parse_scene(PLATE.format(growth=0.01 * pieces))


def cover(size: float) -> Formulation:
    """Return the net of cells of a size."""
    net = {"type": "triangles", "size": size, "angle": 0.3, "shift": [0.13, 0.27], "degree": 1}
    return Formulation.model_validate({"cover": net, "supports": {"method": "nitsche"}})


@cache
def one_solution(size: float) -> float:
    """Seconds of one solution, the model being there: the least of three."""
    found = []
    for _ in range(3):
        made = prepare(plate(1), cover(size))
        begun = process_time()
        made.stepper.attempt(made.start, Instant(0.0, 1.0), None)
        found.append(process_time() - begun)
    return min(found)


def grow(made: Simulation) -> MemorySink:
    """Let the crack grow as far as it may."""
    memory = MemorySink()
    made.run([memory], lambda share, text: None)
    return memory


@pytest.mark.parametrize("size", SIZES)
def test_steps_of_growth(benchmark: Any, size: float) -> None:
    once = one_solution(size)  # loads what is loaded once
    made = prepare(plate(PIECES), cover(size))
    benchmark.group = "steps of growth"
    memory = benchmark.pedantic(grow, (made,), rounds=1)
    summary = memory.summary
    steps, seconds = summary.steps, summary.seconds
    total = sum(seconds.values()) - seconds["covers"] - seconds["effects"]
    benchmark.extra_info |= {
        "unknowns": summary.unknowns,
        "steps": steps,
        "one solution, s": once,
        "a step over it": benchmark.stats.stats.min / steps / once,
        **{name: seconds[name] / total for name in PHASES},
    }
