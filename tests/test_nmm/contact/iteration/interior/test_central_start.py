"""Where the interior point starts about unknowns that are known."""

import numpy as np
import pytest

from nmm.contact.iteration.interior.central_start import central_start
from nmm.contact.iteration.interior.complementarity import Complementarity
from nmm.contact.problem.cut_springs import CutSprings
from nmm.testing.contact_oracle import random_problem


def sides_and_unknowns(seed):
    """Sides of a random problem, and unknowns that open some contacts and slide others."""
    springs = CutSprings.of(random_problem(seed))
    increment = np.random.default_rng(seed).normal(size=len(springs.problem.force)) * 1e-3
    exact = np.zeros(springs.problem.n_contacts, dtype=bool)
    return Complementarity(springs, exact, 1 / springs.stiffness), increment


@pytest.mark.parametrize("seed", range(8))
def test_all_products_are_the_one_asked_for_and_slack_and_flow_positive(seed):
    sides, increment = sides_and_unknowns(seed)
    found = central_start(sides, increment, 3.0)
    np.testing.assert_allclose((found.slack * found.flow)[sides.active], 3.0, rtol=1e-14)
    assert min(found.slack.min(), found.flow.min()) > 0


@pytest.mark.parametrize("seed", range(8))
def test_the_normal_force_is_that_of_the_spring_that_gives_way_by_force_and_flow(seed):
    sides, increment = sides_and_unknowns(seed)
    found, springs = central_start(sides, increment, 3.0), sides.springs
    gap = found.normal / springs.stiffness[0] + found.flow[0]
    # To rounding of the gap, which is a sum.
    expected = springs.problem.gaps(increment)
    np.testing.assert_allclose(gap, expected, atol=1e-12 * np.abs(gap).max())


@pytest.mark.parametrize("seed", range(8))
def test_forces_are_those_of_the_cut_springs_but_for_the_root_of_the_product(seed):
    sides, increment = sides_and_unknowns(seed)
    springs = sides.springs
    # A force is off by at most that of a spring of this energy, shear by both and the friction.
    product = 1e-12 * float(np.square(springs.forces(increment)).max() / springs.stiffness.max())
    found = central_start(sides, increment, product)
    most = 4 * np.sqrt(product * springs.stiffness.max())
    for one, other in zip((found.normal, found.shear), springs.forces(increment), strict=True):
        assert np.abs(one - other).max() <= most
