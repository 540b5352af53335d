"""Newton's method with the tangent of the last solution."""

import numpy as np
import pytest

from nmm.contact.iteration.memory import Memory
from nmm.contact.iteration.newton.semismooth_newton import chords, polish
from nmm.contact.problem.cut_springs import CutSprings, IterationResult
from nmm.solvers.linear import make_solver
from nmm.testing.contact_oracle import random_problem

SOLVED = [0, 1, 2, 4, 6, 7, 8, 9, 11]
"""Problems that Newton's method solves from a random start; it does not solve each."""


def solved(seed):
    """A problem, the solution of Newton's method and its last factor."""
    springs, kept = CutSprings.of(random_problem(seed)), []
    pattern, solver = Memory().pattern_of(springs.problem), make_solver("superlu").unsymmetric()
    start = np.random.default_rng(seed).normal(size=len(springs.problem.force)) * 1e-3
    found = polish(springs, lambda: pattern, solver, start, 1e-13, keep=kept.append)
    return springs, found, kept[-1]


def ended(springs, increment, factor):
    size = springs.residual(increment).size
    given = IterationResult(springs, increment, size, 0, 0, "")
    return given, chords(given, factor, 1e-10)


@pytest.mark.parametrize("seed", SOLVED)
def test_beside_the_solution_they_lead_back_in_a_solve_or_two(seed):
    springs, solution, factor = solved(seed)
    beside = solution.increment * (1 + 1e-7)
    _, found = ended(springs, beside, factor)
    assert found.size <= 1e-10
    assert found.solves <= 2
    largest = np.abs(solution.increment).max()
    # Conditions of these problems are below 1e4.
    np.testing.assert_allclose(found.increment, solution.increment, atol=1e-6 * 1e-4 * largest)


def test_each_but_the_last_leaves_at_most_a_tenth_of_the_force_wherever_they_begin():
    springs, solution, factor = solved(0)
    far = solution.increment + np.random.default_rng(1).normal(size=len(solution.increment))
    given, found = ended(springs, far, factor)
    assert found.size <= 0.1 ** (found.solves - 1) * given.size
    assert found.solves >= 1
