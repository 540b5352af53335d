"""Seconds a step of a brick wall, by phase, number of blocks and enforcement, with growth.

Staggered bricks of 0.5 m x 0.25 m on a held base, friction 0.6, no bond, gravity and inertia:

    python benchmarks/steps.py --blocks 100 1000 10000 --enforcement penalty cone --steps 20
    python benchmarks/steps.py --page           # what docs/enforcements.md shows, and its records
"""

import argparse
import os

os.environ.setdefault("OMP_NUM_THREADS", "1")

import json
from dataclasses import asdict, dataclass, replace
from itertools import pairwise
from pathlib import Path
from time import perf_counter, process_time

import numpy as np

from nmm.formulation import Formulation
from nmm.results.sink import MemorySink
from nmm.scene.model import Scene
from nmm.stepping.simulation import prepare

PHASES = ("search", "assembly", "solve", "update")
RECORDS = Path(__file__).parents[1] / "docs" / "enforcements"
# Enforcement, penalty (E t), numbers of blocks and steps of the page.
RUNS = (
    ("penalty", 1.0, (100, 1000, 10000), 8),
    ("penalty", 10.0, (100, 1000, 10000), 8),
    ("penalty", 100.0, (100,), 8),
    ("cone", 10.0, (100, 1000), 6),
    ("augmented", 10.0, (100,), 6),
    ("lagrange", 10.0, (100,), 6),
    ("barrier", 10.0, (100,), 6),
)
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

    ``growth`` is the exponent of processor seconds over blocks since the size before (0: none).
    ``processor`` counts the seconds of this process alone, on a machine that others share.
    """

    enforcement: str
    penalty: float
    blocks: int
    contacts: int
    status: str
    total: float
    processor: float
    phases: dict[str, float]
    passes: float
    growth: float = 0.0


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
        none = dict.fromkeys(PHASES, 0.0)
        return Cost(enforcement, penalty, len(scene.blocks), 0, "failed", 0.0, 0.0, none, 0.0)
    count = len(stamps) - 1 - WARM
    return Cost(
        enforcement,
        penalty,
        len(scene.blocks),
        len(memory.frames[-1].contact_gap),
        "all converged" if len(stamps) == steps else f"stopped after {len(stamps)}",
        (stamps[-1] - stamps[WARM]) / count,
        (own[-1] - own[WARM]) / count,
        {name: (marks[-1][name] - marks[WARM][name]) / count for name in PHASES},
        float(np.mean(memory.history["passes"][WARM:])),
    )


def grown(costs: list[Cost]) -> list[Cost]:
    """Costs of one enforcement with their growth from size to size."""
    found = costs[:1]
    for last, cost in pairwise(costs):
        known = last.processor > 0 and cost.processor > 0
        times = np.log(cost.processor / last.processor) if known else 0.0
        found.append(replace(cost, growth=float(times / np.log(cost.blocks / last.blocks))))
    return found


def table(costs: list[Cost]) -> str:
    """Costs as a table in Markdown; milliseconds, phases as parts of the whole."""
    head = "| enforcement | penalty | blocks | contacts | ms a step | grows as | "
    head += " | ".join(f"{phase} %" for phase in (*PHASES, "rest")) + " | passes | steps |"
    lines = [head, "|" + "---|" * (8 + len(PHASES) + 1)]
    for c in costs:
        whole = c.total or 1.0
        parts = [100 * c.phases[phase] / whole for phase in PHASES]
        shares = " | ".join(f"{part:.0f}" for part in (*parts, 100 - sum(parts)))
        growth = f"N^{c.growth:.2f}" if c.growth else ""
        lines.append(
            f"| {c.enforcement} | {c.penalty:g} E | {c.blocks} | {c.contacts} | "
            f"{1e3 * c.processor:.1f} | {growth} | {shares} | {c.passes:.1f} | {c.status} |"
        )
    return "\n".join(lines)


def main() -> None:
    """Print the table, or write the page."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--blocks", type=int, nargs="+", default=[100, 1000, 10000])
    parser.add_argument("--enforcement", nargs="+", default=["penalty"])
    parser.add_argument("--steps", type=int, default=20)
    parser.add_argument("--penalty", type=float, default=1.0, help="normal penalty in E x t")
    parser.add_argument("--page", action="store_true", help="write docs/enforcements.md")
    parser.add_argument("--only", action="store_true", help="with --page: what is named, no more")
    options = parser.parse_args()
    runs = [(name, options.penalty, options.blocks, options.steps) for name in options.enforcement]
    costs: list[Cost] = []
    for name, penalty, sizes, steps in RUNS if options.page and not options.only else runs:
        some = []
        for n_blocks in sizes:
            some.append(measure(n_blocks, name, steps, penalty))
            print(table(grown(some)).splitlines()[-1], flush=True)
            if options.page:
                _write(costs + grown(some))
        costs += grown(some)
    if not options.page:
        print("\n" + table(costs))


def _write(costs: list[Cost]) -> None:
    """Put costs in the place of the same ones in the records, and write the page."""
    from enforcement_page import read, write

    RECORDS.mkdir(exist_ok=True)
    known = {(c.enforcement, c.penalty, c.blocks): c for c in read(RECORDS, "steps", Cost)}
    known |= {(c.enforcement, c.penalty, c.blocks): c for c in costs}
    text = json.dumps([asdict(cost) for cost in known.values()], indent=1)
    (RECORDS / "steps.json").write_text(text + "\n")
    write(RECORDS)


if __name__ == "__main__":
    main()
