"""Whether a part is free is told of loads, not of what rounding leaves of them."""

import numpy as np
import pytest

from nmm.contact.iteration.answers import free_part
from nmm.contact.iteration.memory import Memory
from nmm.contact.problem.cut_springs import CutSprings, IterationResult
from nmm.solvers.linear import make_solver
from nmm.testing.contact_oracle import make_problem

# Two functions that are one, held by a spring, and a third unknown on a contact.
TWICE = np.array([[1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 0.0, 0.0]])


@pytest.mark.parametrize(("beside", "code"), [(1e-15, None), (1e-2, "singular")])
def test_rounding_of_functions_that_depend_on_one_another_is_no_free_part(
    beside: float, code: str | None
) -> None:
    force = [1.0 + beside, 1.0 - beside, -1.0]
    problem = make_problem(TWICE, force, [[0.0, 0.0, 1.0]], [[1.0, 1.0, 0.0]])
    found = IterationResult(CutSprings.of(problem), np.array([0.5, 0.5, 0.0]), 1.0, 0, 1, "")
    verdict = free_part(found, make_solver(), Memory())
    assert (None if verdict is None else verdict.code) == code
