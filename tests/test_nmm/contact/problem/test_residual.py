"""The compiled out-of-balance force is that of whole arrays, however rows are stored."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.sparse import csr_array

from nmm.contact.problem.cut_springs import CutSprings
from nmm.testing.contact_oracle import random_problem


@pytest.mark.parametrize("shifted", [False, True])
@pytest.mark.parametrize("paired", [True, False])
@pytest.mark.parametrize("seed", range(6))
def test_out_of_balance_force_is_that_of_matrix_and_rows(
    seed: int, paired: bool, shifted: bool
) -> None:
    problem = random_problem(seed, bonded=True)
    if not paired:  # a tangent row with an unknown less
        dense = problem.tangent_rows.toarray()
        dense[0, 2] = 0.0
        problem = replace(problem, tangent_rows=csr_array(dense))
    assert problem.paired is paired
    rng = np.random.default_rng(seed)
    increment, springs = rng.normal(size=len(problem.force)), CutSprings.of(problem)
    if shifted:  # forces of the last round, of the size of those of the springs
        normal, shear = springs.trial(increment)
        springs = springs.shifted(np.stack([normal, shear]) * rng.normal(size=(2, len(normal))))
    expected = problem.out_of_balance(increment, *springs.forces(increment))
    found = springs.residual(increment).force
    np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-12 * np.abs(expected).max())
