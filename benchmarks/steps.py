"""Seconds a step of a brick wall, by phase, number of blocks and enforcement, with growth.

Staggered bricks of 0.5 m x 0.25 m on a held base, friction 0.6, no bond, gravity and inertia:

    python benchmarks/steps.py --blocks 100 1000 10000 --enforcement penalty cone --steps 20
"""

import argparse
import os

os.environ.setdefault("OMP_NUM_THREADS", "1")

from dataclasses import dataclass
from itertools import pairwise
from time import perf_counter, process_time

import numpy as np

from nmm.formulation import Formulation
from nmm.results.sink import MemorySink
from nmm.scene.model import Scene
from nmm.stepping.simulation import prepare

PHASES = ("search", "assembly", "solve", "update")
# Steps left out of the mean: compiled code is loaded and the first list of neighbours built.
WARM = 3


def wall(n_blocks: int, duration: float) -> Scene:
    """Running bond with half bricks at alternate ends."""
    courses = max(2, round(np.sqrt(n_blocks)))
    width = max(2, round(n_blocks / courses))
    base = [[-0.5, -0.25], [0.5 * width + 0.5, -0.25], [0.5 * width + 0.5, 0], [-0.5, 0]]
    blocks = [{"name": "base", "material": "rock", "vertices": base}]
    for course in range(courses):
        cuts = np.arange(width + 1) * 0.5
        if course % 2:
            cuts = np.r_[0, 0.25 + np.arange(width) * 0.5, 0.5 * width]
        low, high = 0.25 * course, 0.25 * (course + 1)
        for left, right in pairwise(cuts):
            corners = [[left, low], [right, low], [right, high], [left, high]]
            blocks.append({"material": "rock", "vertices": corners})
    return Scene.model_validate(
        {
            "title": "wall",
            "plane": "strain",
            "duration": duration,
            "materials": {"rock": {"young_modulus": 1e9, "poisson_ratio": 0.2, "density": 2000.0}},
            "interfaces": {"bed": {"friction_angle": float(np.arctan(0.6))}},
            "blocks": blocks,
            "supports": [{"name": "ground", "block": "base", "fix": ["x", "y"]}],
            "gravity": {},
            "inertia": {},
            "contact": {},
        }
    )


@dataclass(frozen=True)
class Cost:
    """Mean seconds a step after the first ones, all and by phase, and passes a step.

    ``processor`` counts the seconds of this process alone, on a machine that others share.
    """

    blocks: int
    contacts: int
    status: str
    total: float
    processor: float
    phases: dict[str, float]
    passes: float


def measure(n_blocks: int, enforcement: str, steps: int, penalty: float) -> Cost:
    """Run the wall once."""
    contact = {"enforcement": enforcement, "normal_penalty": penalty}
    scene = wall(n_blocks, steps * 1e-3)
    simulation = prepare(scene, Formulation.model_validate({"contact": contact}))
    seconds, stamps, own, marks = simulation.stepper.seconds, [], [], []

    def note(share: float, text: str) -> None:
        stamps.append(perf_counter())
        own.append(process_time())
        marks.append(dict(seconds))

    memory = MemorySink()
    simulation.run([memory], note)
    if len(stamps) <= WARM + 1:
        return Cost(
            len(scene.blocks), 0, "failed", np.nan, np.nan, dict.fromkeys(PHASES, np.nan), np.nan
        )
    count = len(stamps) - 1 - WARM
    phases = {name: (marks[-1][name] - marks[WARM][name]) / count for name in PHASES}
    return Cost(
        len(scene.blocks),
        len(memory.frames[-1].contact_gap),
        "all converged" if len(stamps) == steps else f"stopped after {len(stamps)}",
        (stamps[-1] - stamps[WARM]) / count,
        (own[-1] - own[WARM]) / count,
        phases,
        float(np.mean(memory.history["passes"][WARM:])),
    )


def main() -> None:
    """Print one table an enforcement."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--blocks", type=int, nargs="+", default=[100, 1000, 10000])
    parser.add_argument("--enforcement", nargs="+", default=["penalty"])
    parser.add_argument("--steps", type=int, default=20)
    parser.add_argument("--penalty", type=float, default=1.0, help="normal penalty in E x t")
    options = parser.parse_args()
    for enforcement in options.enforcement:
        print(f"\n{enforcement}, penalty {options.penalty:g} E t, {options.steps} steps of 1 ms")
        print(
            "blocks contacts  total s " + "".join(f"{p:>10}" for p in PHASES) + "      rest passes"
        )
        last = None
        for n_blocks in options.blocks:
            cost = measure(n_blocks, enforcement, options.steps, options.penalty)
            rest = cost.total - sum(cost.phases.values())
            line = f"{cost.blocks:6d} {cost.contacts:8d} {cost.total:8.4f} {cost.processor:8.4f}"
            line += "".join(f"{cost.phases[p]:10.4f}" for p in PHASES)
            line += f"{rest:10.4f} {cost.passes:6.1f}  {cost.status}"
            if last is not None:
                growth = np.log(cost.processor / last.processor) / np.log(cost.blocks / last.blocks)
                line += f", grows as N^{growth:.2f}"
            print(line, flush=True)
            last = cost


if __name__ == "__main__":
    main()
