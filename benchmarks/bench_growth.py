"""Cracks that grow piece by piece: what a step costs beside one solution of the same model.

*One solution* assembles, factorises and solves a model of the same cells that is there already; a
step of growth finds the load of the present cracks, lets them grow, and changes the model. Seconds
of its phases are shares of the step. Cutting again is measured by itself, beside cutting anew.
"""

from functools import cache
from time import process_time
from typing import Any

import numpy as np
import pytest

from covers.cutting.again.recut import cut_again
from covers.cutting.cut import cutting
from nmm.effects.base import Instant
from nmm.formulation import Formulation, parse_formulation
from nmm.results.sink import MemorySink
from nmm.scene.model import Scene
from nmm.scene.read import parse_scene
from nmm.stepping.prepare import prepare
from nmm.stepping.simulation import Simulation
from nmm.testing.cracked_plates import notched_plate, turned_net

SIZES = (0.05, 0.035, 0.025, 0.0175)
"""Cells of a plate of one by one."""
PIECES = 12
PHASES = ("change", "events", "assembly", "solve")

FRACTURE = """toughness = 1.0
increment = 0.01
max_growth = {growth}
control = "toughness"
"""


def plate(pieces: int) -> Scene:
    """Return the plate whose edge crack grows by so many pieces."""
    return parse_scene(notched_plate(FRACTURE.format(growth=0.01 * pieces)))


def cover(size: float) -> Formulation:
    """Return the net of cells of a size."""
    return parse_formulation(turned_net(size))


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


@pytest.mark.parametrize("size", SIZES)
def test_cut_of_a_piece(benchmark: Any, size: float) -> None:
    laid = prepare(plate(1), cover(size)).stepper.model.cutting
    assert laid is not None
    longer = [np.array([[-0.1, 0.0], [0.3, 0.0], [0.31, 0.0]])]
    benchmark.group = "cut of a piece"
    benchmark.pedantic(cut_again, (laid, longer), rounds=5, warmup_rounds=1)
    begun = process_time()
    found = cutting(laid.cover, laid.regions, longer)
    anew = process_time() - begun
    benchmark.extra_info |= {
        "elements": len(found.cells.elements),
        "anew, s": anew,
        "anew over it": anew / benchmark.stats.stats.min,
    }
