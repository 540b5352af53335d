"""The exact solver on walls and piles: Coulomb's conditions hold, and few factorisations do."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from nmm.contact.enforcement.base import make_enforcement
from nmm.contact.iteration.memory import Memory
from nmm.contact.problem.step_problem import StepAnswer, StepProblem
from nmm.solvers.linear import make_solver

BENCHMARKS = str(Path(__file__).parents[4] / "benchmarks")


def violations(problem: StepProblem, answer: StepAnswer) -> dict[str, float]:
    """What Coulomb's conditions lack: forces over the largest, lengths over what it presses in."""
    normal, shear = answer.normal_force, answer.shear_force
    largest = np.abs(normal).max()
    # compliance of a contact between rigid bodies and their own strain, from the diagonal alone
    ease = (problem.normal_rows.multiply(problem.normal_rows)) @ (1 / problem.matrix.diagonal())
    depth = problem.gap + problem.normal_rows @ answer.increment
    slip = problem.slip + problem.tangent_rows @ answer.increment
    spare = problem.limits.friction * np.maximum(-normal, 0.0) - np.abs(shear)
    rest = problem.matrix @ answer.increment - problem.force
    rest += problem.normal_rows.T @ normal + problem.tangent_rows.T @ shear
    unit = largest * ease.mean()
    return {
        "balance": float(np.abs(rest).max() / np.abs(problem.force).max()),
        "pull": float(np.maximum(normal, 0.0).max() / largest),
        "shear over its bound": float(np.maximum(-spare, 0.0).max() / largest),
        "penetration": float(np.maximum(-depth, 0.0).max() / unit),
        "force at a gap": float(np.minimum(-normal / largest, depth / unit).max()),
        "slip within the cone": float(np.minimum(spare / largest, np.abs(slip) / unit).max()),
        "shear along its slip": float(np.minimum(-shear / largest, slip / unit).max()),
    }


@pytest.mark.parametrize(("name", "most"), [("wall", 20), ("pile", 30)])
def test_coulombs_conditions_hold_on_a_hundred_blocks_in_few_factorisations(
    monkeypatch: pytest.MonkeyPatch, name: str, most: int
) -> None:
    monkeypatch.syspath_prepend(BENCHMARKS)
    from block_scenes import Motion, pile, wall

    # Impulsive loads: waves change the states of a tenth of the contacts in every step.
    motion = Motion({"wall": wall, "pile": pile}[name](100))
    memory, solver, problem = Memory(), make_solver(), motion.problem
    for _ in range(3):
        answer = make_enforcement("cone").solve(problem, solver, memory)
        assert answer.verdict.converged, answer.verdict.sentence
        assert answer.factorisations <= most
        # 1e-7 is what the solver promises of lengths; its unit here is coarser by up to ten
        for lacks, size in violations(problem, answer).items():
            assert size <= (1e-8 if lacks in ("balance", "pull") else 1e-6), lacks
        problem = motion.next_problem(answer)


def test_a_step_solved_again_with_turned_rows_takes_hardly_a_factorisation(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.syspath_prepend(BENCHMARKS)
    from block_scenes import Motion, wall

    problem, memory, solver = Motion(wall(100)).problem, Memory(), make_solver()
    cone = make_enforcement("cone")
    first = cone.solve(problem, solver, memory)
    memory.answered = (problem, first)
    turn = 1e-7  # rad, what bricks turn by in a step of a millisecond
    normal = problem.normal_rows + turn * problem.tangent_rows
    tangent = problem.tangent_rows - turn * problem.normal_rows
    turned = replace(problem, normal_rows=normal.tocsr(), tangent_rows=tangent.tocsr())
    again = cone.solve(memory.started(turned), solver, memory)
    assert again.verdict.converged
    # a fresh search takes twelve at least
    assert again.factorisations <= 6 < first.factorisations


def test_a_pile_with_steep_friction_converges_or_says_that_it_did_not(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.syspath_prepend(BENCHMARKS)
    from block_scenes import Motion, pile

    problem = Motion(pile(30, step=1e-2, friction=1.2)).problem
    answer = make_enforcement("cone").solve(problem, make_solver())
    if answer.verdict.converged:
        assert max(violations(problem, answer).values()) <= 1e-6
    else:
        assert "interior point" in answer.verdict.sentence
