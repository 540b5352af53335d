"""Every enforcement on the same contact problems: errors, passes, factorisations, seconds.

Walls of bricks, a pile of Voronoi cells, a block that slides down a slope and a beam on two flat
supports start to move under gravity and a lateral acceleration that grows by 0.05 m/s2 a step
(blocks of six unknowns, dt 1 ms, friction 0.6). No search, no scene: the contact solution alone.

    python benchmarks/enforcement.py                     # the table
    python benchmarks/enforcement.py --page              # and docs/enforcements.md with its records
    python benchmarks/enforcement.py --solvers --blocks 100 1000 10000

``force error`` is that of the contact resultants on the blocks in the last step, relative, in the
norm weighted with the diagonal, against the same law solved to 1e-12 (springs) or 1e-10 (exact).
It is left out beyond 500 blocks. ``gap error`` is the deepest penetration over the compliance of
its contact times the largest force. Rows that do not converge are printed as they are.
"""

import argparse
import os

os.environ.setdefault("OMP_NUM_THREADS", "1")

import json
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from time import process_time

import numpy as np
from block_scenes import Motion, Scene, incline, pile, supports, wall
from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.contact.enforcement import Enforcement, make_enforcement
from nmm.contact.memory import Memory
from nmm.contact.pattern import SpringPattern
from nmm.contact.problem import StepAnswer, StepProblem
from nmm.contact.rounds import compliances
from nmm.contact.springs import CutSprings
from nmm.solvers.linear import make_solver

RECORDS = Path(__file__).parents[1] / "docs" / "enforcements"
SCENES = {"slope": incline, "supports": supports, "wall": wall, "pile": pile}
SIZES = (("slope", 1), ("supports", 1), ("wall", 100), ("pile", 100), ("wall", 1000))
LARGE = ("open-close 10 E", "penalty 1 E", "penalty 10 E", "cone")
"""What is measured beyond `MANY` blocks."""
MANY = 500
TIGHT = {"tolerance": 1e-12}
EXACT = {"tolerance": 1e-10, "gap_tolerance": 1e-9}


@dataclass(frozen=True)
class Kind:
    """An enforcement with its options and penalty (in Young's moduli), and what it is held to."""

    name: str
    penalty: float
    options: dict[str, object]
    reference: tuple[str, dict[str, object]]


KINDS = {
    "open-close 10 E": Kind(
        "penalty", 10.0, {"iteration": "open_close", "max_passes": 40}, ("penalty", TIGHT)
    ),
    "penalty 1 E": Kind("penalty", 1.0, {}, ("penalty", TIGHT)),
    "penalty 10 E": Kind("penalty", 10.0, {}, ("penalty", TIGHT)),
    "penalty 100 E": Kind("penalty", 100.0, {}, ("penalty", TIGHT)),
    "augmented": Kind("augmented", 10.0, {}, ("cone", EXACT)),
    "lagrange": Kind("lagrange", 10.0, {}, ("cone", EXACT)),
    "cone": Kind("cone", 10.0, {}, ("cone", EXACT)),
    "barrier": Kind("barrier", 10.0, {}, ("cone", EXACT)),
}


@dataclass(frozen=True)
class Row:
    """One enforcement on one scene: medians over the steps after the first."""

    scene: str
    blocks: int
    contacts: int
    enforcement: str
    converged: int
    steps: int
    force_error: float
    gap_error: float
    penetration: float
    passes: float
    factorisations: float
    seconds: float
    seconds_largest: float


def measured(name: str, n_blocks: int, kind: str, steps: int) -> Row:
    """Run ``steps`` steps; what the first one compiles and lays out is left out."""
    chosen = KINDS[kind]
    scene = SCENES[name](n_blocks, chosen.penalty)
    done = list(_run(scene, make_enforcement(chosen.name, chosen.options), steps))
    answers = [answer for _, answer, _ in done]
    problem, answer, _ = done[-1]
    seconds = [busy for _, _, busy in done[1:]]
    depth = np.maximum(-answer.gap, 0.0)
    force = float(np.abs(answer.normal_force).max(initial=0.0))
    pressed = float((depth / compliances(problem)[0]).max(initial=0.0))
    return Row(
        name,
        len(scene.volume),
        scene.problem.n_contacts,
        kind,
        sum(answer.verdict.converged for answer in answers),
        steps,
        _error(problem, answer, *chosen.reference) if n_blocks <= MANY else -1.0,
        pressed / force if force > 0 else 0.0,
        float(depth.max(initial=0.0)),
        float(np.median([answer.passes for answer in answers[1:]])),
        float(np.median([answer.factorisations for answer in answers[1:]])),
        float(np.median(seconds)),
        float(np.max(seconds)),
    )


def _run(
    scene: Scene, method: Enforcement, steps: int
) -> Iterator[tuple[StepProblem, StepAnswer, float]]:
    solver, memory, motion = make_solver(), Memory(), Motion(scene)
    problem = motion.problem
    for _ in range(steps):
        began = process_time()
        answer = method.solve(problem, solver, memory)
        yield problem, answer, process_time() - began
        problem = motion.next_problem(answer)


def _error(problem: StepProblem, answer: StepAnswer, name: str, options: dict) -> float:
    reference = make_enforcement(name, options).solve(problem, make_solver())
    weight = CutSprings.of(problem).weight
    expected = weight * _resultants(problem, reference)
    found = weight * _resultants(problem, answer)
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
    lines = [
        f"| {r.scene} | {r.blocks} | {r.contacts} | {r.enforcement} | {r.converged} of {r.steps} | "
        f"{_power(r.force_error)} | {r.gap_error:.0e} | {r.penetration:.0e} | {r.passes:.0f} | "
        f"{r.factorisations:.0f} | {1e3 * r.seconds:.1f} | {1e3 * r.seconds_largest:.1f} |"
        for r in rows
    ]
    return "\n".join([head, "|" + "---|" * 12, *lines])


def _power(error: float) -> str:
    """Error as text; negative where it was not measured."""
    return f"{error:.0e}" if error >= 0 else ""


def _write(rows: list[Row]) -> None:
    """Put rows in the place of the same ones in the records, and write the page."""
    from enforcement_page import read, write

    RECORDS.mkdir(exist_ok=True)
    known = {(r.scene, r.blocks, r.enforcement): r for r in read(RECORDS, "enforcement", Row)}
    known |= {(r.scene, r.blocks, r.enforcement): r for r in rows}
    text = json.dumps([asdict(row) for row in known.values()], indent=1)
    (RECORDS / "enforcement.json").write_text(text + "\n")
    write(RECORDS)


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
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--blocks", type=int, nargs="+", help="sizes of walls and piles")
    parser.add_argument("--scenes", nargs="+", choices=SCENES)
    parser.add_argument("--enforcement", nargs="+", choices=KINDS, default=list(KINDS))
    parser.add_argument("--steps", type=int, default=6)
    parser.add_argument("--page", action="store_true", help="write docs/enforcements.md")
    parser.add_argument("--solvers", action="store_true", help="linear solvers instead")
    chosen = parser.parse_args()
    if chosen.solvers:
        print(solvers(chosen.blocks or [100, 1000, 10000], ["cholesky", "superlu", "qdldl"]))
        return
    sizes = [
        (name, blocks)
        for name, usual in SIZES
        for blocks in ((chosen.blocks or [usual]) if usual > 1 else [usual])
        if name in (chosen.scenes or SCENES)
    ]
    rows: list[Row] = []
    for name, blocks in dict.fromkeys(sizes):
        for kind in chosen.enforcement:
            if blocks > MANY and kind not in LARGE:
                continue
            rows.append(measured(name, blocks, kind, chosen.steps))
            print(table(rows[-1:]).splitlines()[-1], flush=True)
            if chosen.page:
                _write(rows)
    if not chosen.page:
        print("\n" + table(rows))


if __name__ == "__main__":
    main()
