"""Why the default is what it is: enforcements over whole runs, seconds beside the error of forces.

python benchmarks/default_choice.py  # all scenes, as a table in Markdown
python benchmarks/default_choice.py "wall of 100"  # one

*Force error*: of the blocks' mean stresses, which contact forces make, against a run of the same
steps by `cone`; the root of the mean square over blocks and frames, relative. *Overlap*: the
deepest of the run (m). Milliseconds are processor time of one thread.
"""

import sys
from dataclasses import dataclass
from time import process_time

import numpy as np
from counted_work import run
from enforcements import Variant
from race_scenes import Race, arch, slope, wall
from whole_scenes import pile

from nmm.formulation import Formulation
from nmm.results.sink import MemorySink
from nmm.solvers.threads import OneThread
from nmm.stepping.prepare import prepare
from nmm.stepping.simulation import Simulation

FIXED = {"growth": 1.0, "rescue": 0}
"""Rounds whose springs stay as they are, so that their factor is kept."""
VARIANTS = {
    "cone": Variant("cone"),
    "penalty 1 E": Variant("penalty", 1.0),
    "penalty 10 E": Variant("penalty", 10.0),
    "penalty 100 E": Variant("penalty", 100.0),
    "augmented 1, 1e-2": Variant(
        "augmented", 10.0, {**FIXED, "scale": 1.0, "gap_tolerance": 1e-2, "tolerance": 1e-4}
    ),
    "augmented 10, 1e-2": Variant(
        "augmented", 10.0, {**FIXED, "scale": 10.0, "gap_tolerance": 1e-2, "tolerance": 1e-4}
    ),
    "augmented 10, 1e-3": Variant(
        "augmented", 10.0, {**FIXED, "scale": 10.0, "gap_tolerance": 1e-3, "tolerance": 1e-5}
    ),
}
"""The exact one first: errors are against it. Augmented: `scale`, `gap_tolerance`."""
SCENES = {
    "wall of 100": Race(lambda t: wall(100, t), 1e-3, 40),
    "pile of 100": Race(lambda t: pile(100, t), 1e-3, 30),
    "slope of 40": Race(lambda t: slope(9.0, t), 5e-3, 20),
    "arch of 9": Race(arch, 1e-3, 60),
    "slope of 407": Race(lambda t: slope(2.6, t), 2e-3, 6),
    "wall of 1000": Race(lambda t: wall(1000, t), 1e-3, 10),
    "pile of 1000": Race(lambda t: pile(1000, t), 1e-3, 6),
}
BUDGET = 100.0
"""Seconds by the clock after which a run ends with what it has."""


@dataclass(frozen=True)
class Row:
    """One run.

    Attributes
    ----------
    milliseconds, passes
        A step.
    time, stress
        (frames,) and (frames, blocks, 3): steps may be cut.
    """

    milliseconds: float
    passes: float
    steps: int
    overlap: float
    status: str
    time: np.ndarray
    stress: np.ndarray


def ready(race: Race, variant: Variant) -> Simulation:
    """Return a run that keeps each of its states."""
    scene, _ = race.made()
    scene = scene.model_copy(update={"output": None})
    given = {
        "contact": {
            "enforcement": variant.name,
            "normal_penalty": variant.penalty,
            "options": variant.options,
        },
        "integrator": {"step": race.step},
        "loading": {"budget": BUDGET},
    }
    return prepare(scene, Formulation.model_validate(given))


def raced(race: Race, variant: Variant) -> Row:
    """Run to the end or to the end of the budget."""
    made, begun = ready(race, variant), process_time()
    with OneThread():
        memory: MemorySink = run(made)
    seconds, summary = process_time() - begun, memory.summary
    steps = max(len(memory.rows), 1)
    return Row(
        1e3 * seconds / steps,
        sum(row["passes"] for row in memory.rows) / steps,
        len(memory.rows),
        summary.largest_penetration,
        summary.status,
        np.array([frame.time for frame in memory.frames]),
        np.array([frame.stress for frame in memory.frames]),
    )


def force_error(found: Row, exact: Row) -> float:
    """Return the relative error of stresses over the instants that both have."""
    same = np.abs(found.time[:, None] - exact.time) < 1e-9 * exact.time[-1]
    mine, its = np.nonzero(same)
    one, other = found.stress[mine[1:]], exact.stress[its[1:]]
    return float(np.sqrt(np.sum((one - other) ** 2) / np.sum(other**2)))


def table(names: list[str]) -> None:
    """Print a line for each run as it ends."""
    print("| scene | enforcement | ms a step | passes | force error | overlap (m) | ended |")
    print("|---|---|---|---|---|---|---|", flush=True)
    raced(Race(lambda t: wall(12, t), 1e-3, 3), VARIANTS["cone"])  # loads compiled code
    raced(Race(lambda t: wall(12, t), 1e-3, 3), VARIANTS["penalty 10 E"])
    for name in names:
        rows = {}
        for kind, variant in VARIANTS.items():
            rows[kind] = found = raced(SCENES[name], variant)
            print(
                f"| {name} | {kind} | {found.milliseconds:.3g} | {found.passes:.3g} "
                f"| {force_error(found, rows['cone']):.1e} | {found.overlap:.1e} "
                f"| {found.steps} steps, {found.status} |",
                flush=True,
            )


if __name__ == "__main__":
    table(sys.argv[1:] or list(SCENES))
