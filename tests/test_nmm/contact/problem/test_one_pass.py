"""What is compiled into one pass over a contact problem says what its definition says."""

from dataclasses import replace

import numpy as np
import pytest

from nmm.contact.enforcement.rebalanced import FLOOR, imbalance_of_bodies
from nmm.contact.iteration.answers import answer
from nmm.contact.problem.coulomb import label
from nmm.contact.problem.cut_springs import CutSprings, IterationResult
from nmm.contact.problem.refusal import refuse
from nmm.contact.problem.step_problem import StepProblem, Verdict
from nmm.errors import SolveError
from nmm.solvers.linear import make_solver
from nmm.testing.contact_oracle import random_problem

SEEDS = range(8)
COLUMNS = ("gap", "slip", "normal_stiffness", "shear_stiffness", "normal_force", "shear_force")


def unknowns(problem: StepProblem, seed: int) -> np.ndarray:
    return 1e-2 * np.random.default_rng(seed).normal(size=len(problem.force))


@pytest.mark.parametrize("seed", SEEDS)
def test_an_answer_is_what_coulombs_law_makes_of_the_unknowns(seed: int) -> None:
    problem = random_problem(seed)
    problem = replace(problem, state=np.arange(problem.n_contacts) % 5)
    springs, d = CutSprings.of(problem), unknowns(problem, seed)
    found = answer(
        IterationResult(springs, d, 0.0, 1, 1, ""), make_solver("auto"), Verdict(True, "", "")
    )
    gap = problem.gap + problem.normal_rows @ d
    normal, shear = springs.forces(d)
    np.testing.assert_allclose(found.gap, gap, rtol=1e-13)
    np.testing.assert_allclose(found.normal_force, normal, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(found.shear_force, shear, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(found.slip, shear / problem.shear_stiffness, rtol=1e-12, atol=1e-15)
    np.testing.assert_array_equal(found.state, label(problem, *springs.states(d)))


@pytest.mark.parametrize("seed", SEEDS)
def test_unevenness_is_the_largest_share_of_what_meets_in_a_body(seed: int) -> None:
    problem, rng = random_problem(seed), np.random.default_rng(seed)
    n, d = len(problem.force), unknowns(problem, seed)
    body = np.sort(rng.integers(0, 3, n))
    found = answer(
        IterationResult(CutSprings.of(problem), d, 0.0, 1, 1, ""),
        make_solver("auto"),
        Verdict(True, "", ""),
    )
    matrix = problem.matrix.toarray()
    rows = problem.normal_rows.toarray(), problem.tangent_rows.toarray()
    forces = found.normal_force, found.shear_force
    pressed = np.abs(forces[0]) + np.abs(forces[1])
    rest = matrix @ d - problem.force + rows[0].T @ forces[0] + rows[1].T @ forces[1]
    whole = np.abs(matrix) @ np.abs(d) + np.abs(problem.force)
    whole += sum(np.abs(one).T @ pressed for one in rows)
    weight = problem.weight
    rest, whole = weight * np.abs(rest), weight * whole
    counts = rest > FLOOR * np.linalg.norm(whole)
    largest = np.array([whole[body == b].max(initial=0.0) for b in range(3)])
    expected = (rest[counts] / largest[body[counts]]).max(initial=0.0)
    assert imbalance_of_bodies(problem, found, body) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("name", COLUMNS)
def test_a_column_of_another_length_or_that_is_no_number_is_refused_by_name(name: str) -> None:
    problem = random_problem(0)
    refuse(problem)
    column = getattr(problem, name)
    with pytest.raises(SolveError):
        refuse(replace(problem, **{name: column[:-1]}))
    if name.endswith("force"):
        return  # where the search starts: any number will do
    with pytest.raises(SolveError, match=name):
        refuse(replace(problem, **{name: np.where(np.arange(len(column)) == 1, np.nan, column)}))
