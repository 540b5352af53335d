"""Modified Newton in one compiled loop finds what the plain loop finds, to the last digits."""

import numpy as np
import pytest

from nmm.contact.iteration.memory import Memory
from nmm.contact.iteration.newton.compiled_newton import serves
from nmm.contact.iteration.newton.modified_newton import ModifiedNewton
from nmm.contact.iteration.options.budgets import Patience
from nmm.contact.problem.cut_springs import CutSprings
from nmm.solvers.linear import make_solver
from nmm.testing.contact_oracle import random_problem


def searches(seed, solver="cholesky"):
    springs = CutSprings.of(random_problem(seed))
    factor = Memory().factor_of(springs, make_solver(solver))[0].factor
    start = np.zeros(len(springs.problem.force))
    factor.rough(start)  # a factor that is asked again is inverted: both loops find it so
    made = (ModifiedNewton(springs, factor, start, springs.residual(start)) for _ in range(2))
    return (*made, serves(factor))


@pytest.mark.parametrize("patience", [None, Patience(10.0, 1e-3), Patience(0.5)])
@pytest.mark.parametrize("seed", range(6))
def test_both_loops_take_the_same_passes_to_the_same_unknowns(seed, patience):
    compiled, plain, served = searches(seed)
    assert served
    ends = compiled.run(60, 1e-10, patience), plain._plain(60, 1e-10, patience)
    assert ends[0] == ends[1]
    assert compiled.solves == plain.solves > 0
    np.testing.assert_array_equal(compiled.increment, plain.increment)
    assert compiled.residual.size == plain.residual.size


def test_factors_that_are_not_on_fronts_are_left_to_the_plain_loop():
    compiled, plain, served = searches(0, "superlu")
    assert not served
    assert compiled.run(60, 1e-10) == plain._plain(60, 1e-10, None)
    assert compiled.solves == plain.solves
