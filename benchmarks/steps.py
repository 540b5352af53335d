"""Seconds a step of whole runs, by phase, number of blocks and enforcement, with growth.

A wall of bricks and a pile of Voronoi cells begin to move under gravity (friction 0.6, no bond,
steps of 1 ms); search, assembly, contact, update and output are counted.

    python benchmarks/steps.py --blocks 100 1000 --enforcement "penalty 1 E" cone
    python benchmarks/steps.py --page                      # all that docs/enforcements.md shows
    python benchmarks/steps.py --page --resume --blocks 100000 --budget 900

With ``--page`` each row goes to docs/enforcements/steps.jsonl as soon as it is measured, and the
page is written from the records. A row that spends its budget is stopped and says so; one that is
expected to need more is not run.
"""

import argparse
import os

os.environ.setdefault("OMP_NUM_THREADS", "1")

import resource
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from time import perf_counter, process_time
from typing import Any

import numpy as np
from budget import Overtime, apart, limit
from kinds import KINDS, USUAL
from records import RECORDS, add_options, keep, load, read, stamp, standing, write_page
from step_rows import DT, PHASES, StepRow, expected, line, table
from whole_scenes import SCENES

from nmm.formulation import Formulation
from nmm.results.sink import MemorySink
from nmm.stepping.drive.verdict import FAILED
from nmm.stepping.simulation import Simulation, prepare

PATH = RECORDS / "steps.jsonl"
SIZES = (100, 1000, 10_000, 100_000)
# Steps left out of means: the list of neighbours and the factor are made, nothing is known yet.
WARM = 3
# A run of 1 s is begun, so that frames are written as often as in one: every 17th step.
DURATION = 1.0


class _Enough(BaseException):
    """All steps are done."""


class _Clock:
    """Takes times after every accepted step, and ends the run after enough of them."""

    def __init__(self, simulation: Simulation, steps: int) -> None:
        self.spent, self.memory, self.steps = simulation.stepper.seconds, MemorySink(), steps
        self.elapsed, self.own = [perf_counter()], [process_time()]
        self.phases = [dict(self.spent)]
        self.time = [0.0]

    def __call__(self, share: float, text: str) -> None:
        self.elapsed.append(perf_counter())
        self.own.append(process_time())
        self.phases.append(dict(self.spent))
        self.time.append(self.memory.rows[-1]["time"])
        if self.time[-1] > (self.steps - 0.5) * DT:
            raise _Enough

    def figures(self) -> dict[str, Any]:
        """Means over the steps after the first ones, as fields of a row."""
        done = len(self.time) - 1
        if not done:
            return {}
        lengths = np.diff(self.time)
        first = min(WARM, done - 1)
        share = DT / (self.time[-1] - self.time[first])
        elapsed = (self.elapsed[-1] - self.elapsed[first]) * share
        last, before = self.phases[-1], self.phases[first]
        phases = {n: (last.get(n, 0.0) - before.get(n, 0.0)) * share for n in PHASES[:-1]}
        return {
            "done": done,
            "left_out": first,
            "cut": int((lengths < 0.999 * DT).sum()),
            "seconds": (self.own[-1] - self.own[first]) * share,
            "elapsed": elapsed,
            "phases": phases | {"rest": elapsed - sum(phases.values())},
            "passes": float(np.mean([row["passes"] for row in self.memory.rows[first:]])),
            "contacts": int(sum(self.memory.rows[-1][s] for s in ("open", "stick", "slide"))),
        }


def measure(scene: str, size: int, enforcement: str, steps: int, budget: float) -> StepRow:
    """Run one scene with one enforcement for a number of steps, or until the budget is spent."""
    busy, clock = load(), None
    _warm(enforcement)
    began = process_time()
    row = StepRow(scene=scene, enforcement=enforcement, size=size, status="stopped", asked=steps)
    try:
        with limit(budget):
            simulation = _simulation(scene, size, enforcement)
            clock = _Clock(simulation, steps)
            row = replace(row, **_prepared(simulation), prepared=clock.own[0] - began)
            simulation.run([clock.memory], clock)
        # neither the last step asked for was reached nor the budget spent: it gave up
        row = replace(row, status=FAILED, sentence=clock.memory.summary.sentence)
    except _Enough:
        row = replace(row, status="converged")
    except Overtime:
        row = replace(row, **_stopped(clock, budget))
    if clock:
        row = replace(row, **clock.figures())
    if row.status == "converged" and row.cut:
        row = replace(row, status="cut")
    used = process_time() - began
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
    return replace(row, budget=budget, used=used, memory=memory, **stamp(busy))


def _warm(enforcement: str) -> None:
    """Have compiled code loaded before anything is timed."""
    simulation = _simulation("wall", 12, enforcement)
    clock = _Clock(simulation, 2)
    with suppress(_Enough):
        simulation.run([clock.memory], clock)


def _simulation(scene: str, size: int, enforcement: str) -> Simulation:
    kind = KINDS[enforcement]
    contact = {"enforcement": kind.name, "normal_penalty": kind.penalty, "options": kind.options}
    formulation = Formulation.model_validate({"contact": contact, "integrator": {"step": DT}})
    return prepare(SCENES[scene](size, DURATION), formulation)


def _prepared(simulation: Simulation) -> dict[str, Any]:
    parts = {name: simulation.stepper.seconds[name] for name in ("covers", "effects")}
    return {"blocks": len(simulation.regions), "prepare": parts}


def _stopped(clock: _Clock | None, budget: float) -> dict[str, Any]:
    if clock is None:
        return {"sentence": f"{budget:g} s were spent before the first step"}
    since = process_time() - clock.own[-1]
    done = f"{len(clock.time) - 1} of {clock.steps} steps"
    sentence = f"stopped after {done}, {since:.3g} s into the next: the budget was spent"
    return {"sentence": sentence, "unfinished": since}


def row_of(
    scene: str, size: int, enforcement: str, steps: int, budget: float, known: list[StepRow]
) -> StepRow:
    """Measure in a process of its own; what is expected to need more than the budget is not run."""
    empty = StepRow(scene=scene, enforcement=enforcement, size=size, status="not run", asked=steps)
    empty = replace(empty, budget=budget)
    seconds, reason = expected(empty, known, WARM + 2)
    if seconds > budget:
        return replace(empty, sentence=f"not run: {reason}, budget {budget:g} s", **stamp())
    found, fault = apart(measure, scene, size, enforcement, steps, budget)
    return found or replace(empty, status="broken", sentence=fault, **stamp())


def main() -> None:
    """Print the table, or keep the rows and write the page."""
    options = _options()
    rows: list[StepRow] = read(PATH, StepRow) if options.page else []
    done: list[StepRow] = []
    for scene, size, kind in _wanted(options):
        old = next((row for row in rows if row.key == (scene, kind, size)), None)
        if old is not None and _stands(old, options):
            continue
        row = row_of(scene, size, kind, options.steps, options.budget, rows)
        print(f"{scene:5}{line(row, [*rows, row])} {row.sentence}", flush=True)
        if row.status == "not run" and old is not None and old.seconds:
            continue  # a measurement with more budget is worth more
        rows = [one for one in rows if one.key != row.key] + [row]
        done.append(row)
        if options.page:
            keep(PATH, row)
            write_page()
    if options.page:
        write_page()
    else:
        print("\n" + table(done))


def _wanted(options: argparse.Namespace) -> list[tuple[str, int, str]]:
    """Rows from small to large: what a large one will cost is then known before."""
    return [
        (scene, size, kind)
        for size in sorted(options.blocks)
        for scene in options.scenes
        for kind in options.enforcement
    ]


def _stands(old: StepRow, options: argparse.Namespace) -> bool:
    if old.status in ("not run", "broken"):
        return False
    return standing(old, options.resume, options.budget, old.ended)


def _options() -> argparse.Namespace:
    form: Callable[..., Any] = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=form)
    parser.add_argument("--scenes", nargs="+", choices=SCENES, default=list(SCENES))
    parser.add_argument("--blocks", type=int, nargs="+", help="sizes")
    parser.add_argument("--enforcement", nargs="+", choices=KINDS)
    parser.add_argument("--steps", type=int, default=12)
    parser.add_argument("--budget", type=float, default=300.0, help="processor seconds a row")
    add_options(parser)
    options = parser.parse_args()
    options.blocks = options.blocks or (SIZES if options.page else SIZES[:2])
    options.enforcement = options.enforcement or (list(KINDS) if options.page else USUAL)
    return options


if __name__ == "__main__":
    main()
