"""Every enforcement on the same contact problems: errors, passes, factorisations, seconds.

Walls of bricks, a pile of Voronoi cells, a block that slides down a slope and a beam on two flat
supports start to move under gravity and a lateral acceleration that grows by 0.05 m/s2 a step
(blocks of six unknowns, dt 1 ms, friction 0.6). No search, no scene: the contact solution alone.

    python benchmarks/enforcement.py                     # the table of small scenes
    python benchmarks/enforcement.py --page              # all, and docs/enforcements.md
    python benchmarks/enforcement.py --page --resume --blocks 1000 --budget 900
    python benchmarks/enforcement.py --solvers --blocks 100 1000 10000

``force error`` is that of the contact resultants on the blocks in the last step, relative, in the
norm weighted with the diagonal, against the same law solved to 1e-12 (springs) or 1e-10 (exact).
Where that does not converge it is solved less tightly, which the row says, and where it spends the
budget itself the error is left out. ``gap error`` is the deepest penetration over the compliance of
its contact times the largest force. Rows that do not converge are printed as they are, rows that
spend their budget are stopped and say so.
"""

import argparse
import os

os.environ.setdefault("OMP_NUM_THREADS", "1")

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from time import process_time

import numpy as np
from block_scenes import Motion, Scene, incline, pile, supports, wall
from budget import Overtime, apart, limit
from kinds import KINDS, Reference
from records import RECORDS, add_options, keep, load, read, stamp, standing, write_page
from records import Row as Measurement
from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.contact.enforcement.base import Enforcement, make_enforcement
from nmm.contact.iteration.memory import Memory
from nmm.contact.iteration.multiplier_rounds import compliances
from nmm.contact.problem.cut_springs import CutSprings
from nmm.contact.problem.matrix_pattern import SpringPattern
from nmm.contact.problem.step_problem import StepAnswer, StepProblem
from nmm.solvers.linear import make_solver

PATH = RECORDS / "enforcement.jsonl"
SCENES = {"slope": incline, "supports": supports, "wall": wall, "pile": pile}
SMALL = (("slope", 1), ("supports", 1), ("wall", 100), ("pile", 100))
SIZES = (*SMALL, ("wall", 1000), ("pile", 1000))


@dataclass(frozen=True, kw_only=True)
class Row(Measurement):
    """One enforcement on one scene: medians over the steps after the first.

    ``force_error`` is negative where it was not measured. ``sentence`` says what did not end as
    asked for.
    """

    scene: str
    size: int
    enforcement: str
    sentence: str = ""
    blocks: int = 0
    contacts: int = 0
    converged: int = 0
    steps: int = 0
    asked: int = 0
    force_error: float = -1.0
    gap_error: float = 0.0
    penetration: float = 0.0
    passes: float = 0.0
    factorisations: float = 0.0
    seconds: float = 0.0
    seconds_largest: float = 0.0

    @property
    def key(self) -> tuple[str, int, str]:
        """Scene, size and enforcement."""
        return self.scene, self.size, self.enforcement


_Step = tuple[StepProblem, StepAnswer, float]


def measured(name: str, size: int, kind: str, steps: int, budget: float) -> Row:
    """Run ``steps`` steps, or what the budget allows; then look for the force error."""
    busy, began, said = load(), process_time(), []
    chosen, done = KINDS[kind], []
    row = Row(scene=name, size=size, enforcement=kind, asked=steps, budget=budget)
    scene = SCENES[name](size, chosen.penalty)
    try:
        with limit(budget):
            for one in _run(scene, make_enforcement(chosen.name, chosen.options), steps):
                done += [one]
    except Overtime:
        said.append(f"stopped after {len(done)} of {steps} steps: the budget was spent")
    if done:
        missed = [answer.verdict for _, answer, _ in done if not answer.verdict.converged]
        said += [f"{len(missed)} of {len(done)} steps: {missed[-1].sentence}"] if missed else []
        row = _figures(row, scene, done)
        error, why = _error(*done[-1][:2], chosen.reference, budget)
        row, said = replace(row, force_error=error), said + why
    used = process_time() - began
    return replace(row, sentence="; ".join(said), used=used, **stamp(busy))


def _figures(row: Row, scene: Scene, done: list[_Step]) -> Row:
    later = done[1:] or done
    problem, answer, _ = done[-1]
    depth = np.maximum(-answer.gap, 0.0)
    force = float(np.abs(answer.normal_force).max(initial=0.0))
    pressed = float((depth / compliances(problem)[0]).max(initial=0.0))
    return replace(
        row,
        blocks=len(scene.volume),
        contacts=scene.problem.n_contacts,
        converged=sum(one.verdict.converged for _, one, _ in done),
        steps=len(done),
        gap_error=pressed / force if force > 0 else 0.0,
        penetration=float(depth.max(initial=0.0)),
        passes=float(np.median([one.passes for _, one, _ in later])),
        factorisations=float(np.median([one.factorisations for _, one, _ in later])),
        seconds=float(np.median([busy for _, _, busy in later])),
        seconds_largest=float(np.max([busy for _, _, busy in later])),
    )


def _run(scene: Scene, method: Enforcement, steps: int) -> Iterator[_Step]:
    solver, memory, motion = make_solver(), Memory(), Motion(scene)
    problem = motion.problem
    for _ in range(steps):
        began = process_time()
        answer = method.solve(problem, solver, memory)
        yield problem, answer, process_time() - began
        problem = motion.next_problem(answer)


def _error(
    problem: StepProblem, answer: StepAnswer, reference: Reference, budget: float
) -> tuple[float, list[str]]:
    """Force error, -1 where it is not known, and what is to be said of that."""
    said: list[str] = []
    try:
        with limit(budget):
            for name, options in reference:
                tight = make_enforcement(name, options).solve(problem, make_solver())
                if tight.verdict.converged:
                    return _distance(problem, answer, tight), said
                told = ", ".join(f"{key} = {value}" for key, value in options.items())
                other = f"force error against {reference[-1][0]}"
                said = [f"{other}, as {name} did not converge with {told}"]
    except Overtime:
        return -1.0, ["no force error: the tight solution spent the budget too"]
    return -1.0, [f"no force error: the tight solution: {tight.verdict.sentence}"]


def _distance(problem: StepProblem, answer: StepAnswer, tight: StepAnswer) -> float:
    """Distance of the resultants of two answers over the size of the second's."""
    weight = CutSprings.of(problem).weight
    expected, found = (weight * _resultants(problem, one) for one in (tight, answer))
    return float(np.linalg.norm(found - expected) / np.linalg.norm(expected))


def _resultants(problem: StepProblem, answer: StepAnswer) -> Floats:
    normal = problem.normal_rows.T @ answer.normal_force
    return np.asarray(normal + problem.tangent_rows.T @ answer.shear_force)


def table(rows: list[Row]) -> str:
    """Rows as a table in Markdown."""
    head = (
        "| scene | blocks | contacts | enforcement | converged | force error | gap error | "
        "penetration (m) | passes | factors | ms a step | ms, largest |"
    )
    return "\n".join([head, "|" + "---|" * 12, *map(line, rows)])


def line(r: Row) -> str:
    """One row of the table."""
    if not r.steps:
        return f"| {r.scene} | {r.size} | | {r.enforcement} | 0 of {r.asked} | | | | | | | |"
    return (
        f"| {r.scene} | {r.blocks} | {r.contacts} | {r.enforcement} | {r.converged} of {r.steps} | "
        f"{_power(r.force_error)} | {r.gap_error:.0e} | {r.penetration:.0e} | {r.passes:.0f} | "
        f"{r.factorisations:.0f} | {1e3 * r.seconds:.1f} | {1e3 * r.seconds_largest:.1f} |"
    )


def sentences(rows: list[Row]) -> str:
    """What is to be said of rows that are not as asked for, one point each."""
    told = [row for row in rows if row.sentence]
    return "\n".join(f"- {r.scene}, {r.size} blocks, {r.enforcement}: {r.sentence}" for r in told)


def _power(error: float) -> str:
    """Error as text; negative where it was not measured."""
    return f"{error:.0e}" if error >= 0 else ""


def solvers(sizes: list[int], names: list[str]) -> str:
    """Milliseconds of linear solvers on the matrix of a wall with all springs acting."""
    lines = [f"{'blocks':>7}{'unknowns':>9} {'solver':10}{'first':>9}{'again':>9}{'solve':>9}"]
    for size in sizes:
        problem = wall(size).problem
        springs = (problem.normal_stiffness, problem.shear_stiffness)
        matrix = SpringPattern.of(problem).matrix(problem, *springs)
        rhs = np.random.default_rng(0).random(matrix.shape[0])
        for name in names:
            if size <= 2000 or name != "qdldl":
                times = "".join(f"{1e3 * t:9.2f}" for t in _costs(name, matrix, rhs))
                lines.append(f"{size:7d}{matrix.shape[0]:9d} {name:10}{times}")
    return "\n".join(lines)


def _costs(name: str, matrix: csc_array, rhs: Floats) -> tuple[float, float, float]:
    solver = make_solver(name)
    solver.factorise(matrix[:60, :60])  # compiled code loaded
    first = _seconds(lambda: solver.factorise(matrix), 1)
    again = _seconds(lambda: solver.factorise(matrix), 3)
    factor = solver.factorise(matrix)
    return first, again, _seconds(lambda: factor.apply(rhs), 5)


def _seconds(work: Callable[[], object], repeats: int) -> float:
    best = np.inf
    for _ in range(repeats):
        began = process_time()
        work()
        best = min(best, process_time() - began)
    return float(best)


def main() -> None:
    """Measure and print, or write."""
    chosen = _options()
    if chosen.solvers:
        print(solvers(chosen.blocks or [100, 1000, 10000], ["cholesky", "lu", "superlu", "qdldl"]))
        return
    usual = SIZES if chosen.page else SMALL
    sizes = [
        (name, size)
        for name, many in usual
        for size in ((chosen.blocks or [many]) if many > 1 else [many])
        if name in (chosen.scenes or (("wall", "pile") if chosen.blocks else SCENES))
    ]
    known = {row.key: row for row in read(PATH, Row)} if chosen.page else {}
    rows: list[Row] = []
    for key in ((*one, kind) for one in dict.fromkeys(sizes) for kind in chosen.enforcement):
        old = known.get(key)
        if old and standing(old, chosen.resume, chosen.budget, old.steps == old.asked):
            continue
        row, fault = apart(measured, *key, chosen.steps, chosen.budget)
        if row is None:
            scene, size, kind = key
            broken = Row(scene=scene, size=size, enforcement=kind, asked=chosen.steps)
            row = replace(broken, sentence=fault, **stamp())
        rows.append(row)
        print(f"{line(row)} {row.sentence}", flush=True)
        if chosen.page:
            keep(PATH, row)
            write_page()
    if chosen.page:
        write_page()
    else:
        print("\n" + table(rows))


def _options() -> argparse.Namespace:
    form: Callable[..., object] = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=form)
    parser.add_argument("--blocks", type=int, nargs="+", help="sizes of walls and piles")
    parser.add_argument("--scenes", nargs="+", choices=SCENES)
    parser.add_argument("--enforcement", nargs="+", choices=KINDS, default=list(KINDS))
    parser.add_argument("--steps", type=int, default=6)
    parser.add_argument("--budget", type=float, default=120.0, help="processor seconds a row")
    add_options(parser)
    parser.add_argument("--solvers", action="store_true", help="linear solvers instead")
    return parser.parse_args()


if __name__ == "__main__":
    main()
