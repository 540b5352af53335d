"""Contact solution alone: seconds, passes, errors of every enforcement; and of linear solvers.

A wall of bricks and a pile of Voronoi cells, six unknowns a block, start to fall under gravity and
a lateral acceleration that grows by 0.05 m/s2 a step (dt 1 ms, friction 0.6, penalty 1 E):

    python benchmarks/enforcement.py --blocks 100 1000 --scenes wall pile --steps 6
    python benchmarks/enforcement.py --solvers --blocks 100 1000 10000

``error`` is that of the contact resultants on the blocks in the last step, relative, in the norm
weighted with the diagonal. Springs are measured against springs settled to 1e-12, the exact
enforcements against the cone at 1e-10: where blocks have more contacts than unknowns single forces
are not determined, resultants nearly are. Rows that do not converge are printed as they are.
"""

import argparse
import os

os.environ.setdefault("OMP_NUM_THREADS", "1")

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from time import perf_counter, process_time

import numpy as np
from block_scenes import Motion, Scene, pile, wall
from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.contact.enforcement import Enforcement, make_enforcement
from nmm.contact.memory import Memory
from nmm.contact.pattern import SpringPattern
from nmm.contact.problem import StepAnswer, StepProblem
from nmm.contact.springs import CutSprings
from nmm.solvers.linear import make_solver

SCENES = {"wall": wall, "pile": pile}
KINDS: dict[str, tuple[str, dict[str, object], bool]] = {
    "open-close": ("penalty", {"iteration": "open_close", "max_passes": 40}, False),
    "penalty": ("penalty", {}, False),
    "augmented": ("augmented", {}, True),
    "lagrange": ("lagrange", {}, True),
    "cone": ("cone", {}, True),
    "barrier": ("barrier", {}, True),
}
CHEAP = ("penalty",)
"""Enforcements that are measured beyond ``MANY`` blocks unless others are asked for."""
MANY = 2000


@dataclass(frozen=True)
class Row:
    """One enforcement on one scene: medians over the steps after the first."""

    scene: str
    blocks: int
    contacts: int
    enforcement: str
    seconds: float
    busy: float
    passes: float
    factorisations: float
    converged: int
    steps: int
    penetration: float
    error: float


def measured(name: str, n_blocks: int, kind: str, steps: int, penalty: float) -> Row:
    """Run ``steps`` steps; what the first one compiles and lays out is left out."""
    scene = SCENES[name](n_blocks, penalty)
    enforcement, options, exact = KINDS[kind]
    done = list(_run(scene, make_enforcement(enforcement, options), steps))
    answers = [answer for _, answer, _, _ in done]
    return Row(
        name,
        len(scene.volume),
        scene.problem.n_contacts,
        kind,
        float(np.median([seconds for _, _, seconds, _ in done[1:]])),
        float(np.median([busy for _, _, _, busy in done[1:]])),
        float(np.median([answer.passes for answer in answers[1:]])),
        float(np.median([answer.factorisations for answer in answers[1:]])),
        sum(answer.verdict.converged for answer in answers),
        steps,
        float(-answers[-1].gap.min()),
        _error(done[-1][0], answers[-1], exact),
    )


def _run(
    scene: Scene, method: Enforcement, steps: int
) -> Iterator[tuple[StepProblem, StepAnswer, float, float]]:
    solver, memory, motion = make_solver(), Memory(), Motion(scene)
    problem = motion.problem
    for _ in range(steps):
        began, worked = perf_counter(), process_time()
        answer = method.solve(problem, solver, memory)
        yield problem, answer, perf_counter() - began, process_time() - worked
        problem = motion.next_problem(answer)


def _error(problem: StepProblem, answer: StepAnswer, exact: bool) -> float:
    if exact and len(problem.force) > 6 * MANY:
        return np.nan
    name, options = ("cone", {"tolerance": 1e-10}) if exact else ("penalty", {"tolerance": 1e-12})
    reference = make_enforcement(name, options).solve(problem, make_solver())
    weight = CutSprings.of(problem).weight
    expected = weight * _resultants(problem, reference)
    found = weight * _resultants(problem, answer)
    return float(np.linalg.norm(found - expected) / np.linalg.norm(expected))


def _resultants(problem: StepProblem, answer: StepAnswer) -> Floats:
    normal = problem.normal_rows.T @ answer.normal_force
    return np.asarray(normal + problem.tangent_rows.T @ answer.shear_force)


def table(rows: list[Row]) -> str:
    """Rows as text."""
    head = (
        f"{'scene':6}{'blocks':>7}{'contacts':>9} {'enforcement':12}{'seconds':>9}{'cpu':>9}"
        f"{'passes':>8}{'factors':>8}{'converged':>10}{'penetration':>12}{'error':>9}"
    )
    lines = [
        f"{r.scene:6}{r.blocks:7d}{r.contacts:9d} {r.enforcement:12}{r.seconds:9.4f}{r.busy:9.4f}"
        f"{r.passes:8.0f}{r.factorisations:8.0f}{r.converged:6d} / {r.steps:1d}"
        f"{r.penetration:12.1e}{r.error:9.1e}"
        for r in rows
    ]
    return "\n".join([head, *lines])


def solvers(sizes: list[int], names: list[str]) -> str:
    """Milliseconds of linear solvers on the matrix of a wall with all springs acting."""
    lines = [f"{'blocks':>7}{'unknowns':>9} {'solver':10}{'first':>9}{'again':>9}{'solve':>9}"]
    for size in sizes:
        problem = wall(size).problem
        springs = (problem.normal_stiffness, problem.shear_stiffness)
        matrix = SpringPattern.of(problem).matrix(problem, *springs)
        rhs = np.random.default_rng(0).random(matrix.shape[0])
        for name in names:
            if size <= MANY or name != "qdldl":
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
    """Measure and print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--blocks", type=int, nargs="+", default=[100, 1000, 10000])
    parser.add_argument("--scenes", nargs="+", default=list(SCENES), choices=SCENES)
    parser.add_argument("--enforcement", nargs="+", choices=KINDS)
    parser.add_argument("--steps", type=int, default=6)
    parser.add_argument("--penalty", type=float, default=1.0, help="in Young's moduli")
    parser.add_argument("--solvers", action="store_true", help="linear solvers instead")
    chosen = parser.parse_args()
    if chosen.solvers:
        print(solvers(chosen.blocks, ["cholesky", "superlu", "qdldl"]))
        return
    rows = []
    for scene in chosen.scenes:
        for blocks in chosen.blocks:
            for kind in chosen.enforcement or (KINDS if blocks <= MANY else CHEAP):
                rows.append(measured(scene, blocks, kind, chosen.steps, chosen.penalty))
                print(table(rows[-1:]).splitlines()[1], flush=True)
    print("\n" + table(rows))


if __name__ == "__main__":
    main()
