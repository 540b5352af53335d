"""Cut springs from cell to cell of contact states, held to all solutions by enumeration."""

from dataclasses import replace

import numpy as np
import pytest

from nmm.contact.enforcement.penalty import Penalty
from nmm.contact.iteration.cells import from_cell_to_cell
from nmm.contact.iteration.memory import Memory
from nmm.contact.problem.cut_springs import CutSprings
from nmm.contact.problem.step_problem import Limits, StepProblem
from nmm.solvers.libraries.superlu import SuperLU
from nmm.testing.contact_oracle import Solution, all_solutions, random_problem


def uneven(seed: int, friction: float) -> StepProblem:
    """Up to four contacts, springs from 1 to 1e6 N/m, cohesion beside tensile strength alone."""
    problem, rng = random_problem(seed, bonded=True), np.random.default_rng(seed)
    tension, m = problem.limits.tension, problem.n_contacts
    limits = Limits(tension, np.where(tension > 0, 0.2, 0.0), np.full(m, friction))
    normal, shear = 10.0 ** rng.integers(0, 7, (2, m))
    return replace(problem, limits=limits, normal_stiffness=normal, shear_stiffness=shear)


# On most of these lines the determinant changes its sign, and the share of the way turns round.
@pytest.mark.parametrize("friction", [0.6, 2.0])
@pytest.mark.parametrize("seed", [2, 7, 18, 19, 20, 32, 40, 53, 56, 60])
def test_the_line_ends_in_a_solution_however_uneven_springs_are(seed: int, friction: float) -> None:
    problem = uneven(seed, friction)
    springs = CutSprings.of(problem)
    tools = Penalty().tools(SuperLU(), Memory())
    found = from_cell_to_cell(springs, tools, np.zeros_like(problem.force))
    assert found is not None
    forces = np.stack(springs.forces(found))
    known: list[Solution] = all_solutions(problem, exact=False, tolerance=1e-7)
    off = [np.abs(forces - (one.normal_force, one.shear_force)).max() for one in known]
    # Springs of 1e6 N/m beside 0.1 of the rest: forces are rounded to some 1e-9.
    assert min(off) < 1e-6
