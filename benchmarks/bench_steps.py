"""Whole runs by enforcement: search, assembly, contact, update, output; every step counts.

A wall of bricks and a pile of Voronoi cells begin to move under gravity (friction 0.6, no bond).
"""

from typing import Any

import pytest
from enforcements import VARIANTS
from whole_scenes import SCENES

from nmm.formulation import Formulation
from nmm.results.sink import MemorySink
from nmm.stepping.prepare import prepare
from nmm.stepping.simulation import Simulation

STEP, STEPS = 1e-3, 12
"""Seconds of time a step, and steps of a run."""
# On 1000 blocks these take minutes, and say no more than on 100.
SLOW = ("augmented", "lagrange", "penalty 100 E")


def simulation(scene: str, size: int, name: str, steps: int = STEPS) -> Simulation:
    """Return a run that is ready for its first step."""
    variant = VARIANTS[name]
    contact = {
        "enforcement": variant.name,
        "normal_penalty": variant.penalty,
        "options": variant.options,
    }
    formulation = Formulation.model_validate({"contact": contact, "integrator": {"step": STEP}})
    return prepare(SCENES[scene](size, steps * STEP), formulation)


def run(made: Simulation) -> MemorySink:
    """Run to the end."""
    memory = MemorySink()
    made.run([memory], lambda share, text: None)
    return memory


@pytest.mark.parametrize("name", VARIANTS)
@pytest.mark.parametrize("size", [100, 1000])
@pytest.mark.parametrize("scene", SCENES)
def test_whole_steps(benchmark: Any, scene: str, size: int, name: str) -> None:
    if size > 100 and name in SLOW:
        pytest.skip("takes minutes")
    run(simulation("wall", 12, name, 2))  # loads compiled code
    benchmark.group = f"whole steps, {scene} of {size}"
    made = simulation(scene, size, name)
    memory = benchmark.pedantic(run, (made,), rounds=1)
    rows = memory.rows
    benchmark.extra_info |= {
        "enforcement": name,
        "steps": len(rows),
        "contacts": sum(rows[-1][state] for state in ("open", "stick", "slide")) if rows else 0,
        "passes a step": sum(row["passes"] for row in rows) / max(len(rows), 1),
        "ended": memory.summary.sentence,
    }
