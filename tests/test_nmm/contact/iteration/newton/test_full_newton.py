"""Newton's method in full matrices takes the steps of the one by sparse factors, to rounding."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.sparse import csc_array

from nmm.contact.iteration.memory import Memory
from nmm.contact.iteration.newton.full_newton import newton_in_full
from nmm.contact.iteration.newton.semismooth_newton import polish
from nmm.contact.problem.cut_springs import CutSprings
from nmm.solvers.linear import make_solver
from nmm.testing.contact_oracle import random_problem


@pytest.mark.parametrize("seed", range(12))
def test_both_take_the_same_steps_to_the_same_unknowns(seed: int) -> None:
    springs = CutSprings.of(random_problem(seed))
    start = np.random.default_rng(seed).normal(size=len(springs.problem.force)) * 1e-3
    pattern = Memory().pattern_of(springs.problem)
    # A named solver is taken as it is: its matrices are sparse.
    sparse = polish(springs, lambda: pattern, make_solver("superlu").unsymmetric(), start, 1e-13)
    full = newton_in_full(springs, start, 1e-13, 8)
    assert full is not None
    found, size, taken = full
    assert taken == sparse.factorisations
    largest = np.abs(sparse.increment).max()
    # Conditions of these problems are below 1e4.
    np.testing.assert_allclose(found, sparse.increment, atol=1e-11 * largest)
    assert size == pytest.approx(springs.residual(found).size, abs=1e-15)


def test_two_steps_together_may_end_what_the_first_alone_makes_worse() -> None:
    """States that are wrong raise the force when they turn; from where they are right it ends."""
    ended = 0
    for seed in range(30):
        springs = CutSprings.of(random_problem(seed))
        start = np.random.default_rng(seed).normal(size=len(springs.problem.force)) * 1e-3
        found = newton_in_full(springs, start, 1e-13, 8)
        assert found is not None
        ended += found[1] < 1e-12
    # Steps that must halve the force each end 4 of them.
    assert ended >= 20


def test_a_matrix_without_inverse_is_left_to_the_solver() -> None:
    problem = random_problem(1)
    n = len(problem.force)
    open_ = np.full_like(problem.gap, 1e6)
    nothing = csc_array((n, n))
    springs = CutSprings.of(replace(problem, matrix=nothing, gap=open_))
    assert newton_in_full(springs, np.zeros(n), 1e-13, 8) is None


def test_few_unknowns_alone_are_solved_in_full_and_by_no_solver_that_was_named() -> None:
    auto = make_solver("auto").unsymmetric()
    assert auto.in_full(12)
    assert not auto.in_full(600)
    assert not make_solver("superlu").unsymmetric().in_full(12)
