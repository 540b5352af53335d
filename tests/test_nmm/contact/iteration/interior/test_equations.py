"""Steps of the interior point fulfil Newton's equations, which say themselves what they should."""

import numpy as np
import pytest

from nmm.contact.iteration.interior.complementarity import Complementarity, InteriorIterate
from nmm.contact.iteration.interior.equations import Linearised
from nmm.contact.problem.cut_springs import CutSprings
from nmm.contact.problem.matrix_pattern import SpringPattern
from nmm.solvers.linear import make_solver
from nmm.testing.contact_oracle import random_problem


@pytest.fixture(params=range(8))
def stepped(request):
    """Sides of a problem, a point far from balance, targets, and the point after a whole step."""
    springs = CutSprings.of(random_problem(request.param))
    problem, draw = springs.problem, np.random.default_rng(request.param)
    n, m = len(problem.force), problem.n_contacts
    sides = Complementarity(springs, np.zeros(m, dtype=bool), 1 / springs.stiffness)
    size = float(np.abs(problem.force).max())
    forces, slack = size * draw.normal(size=(2, m)), size * draw.uniform(0.1, 1.0, (3, m))
    flow = draw.uniform(0.1, 1.0, (3, m)) * size / springs.stiffness.max()
    at = InteriorIterate(1e-3 * draw.normal(size=n), *forces, slack, flow)
    laid, solver = SpringPattern.of(problem).laid(problem), make_solver("superlu").unsymmetric()
    targets = -draw.uniform(0.1, 0.9, (3, m)) * slack * flow
    step = Linearised(sides, laid, solver, at, soft=1e-3).step(targets)
    return sides, at, targets, step, at.moved(step, 1.0)


# Of one solution without refinement, relative to what is summed up.
ROUNDING = 1e-9


def test_forces_are_in_balance_after_a_whole_step(stepped):
    sides, _, _, _, end = stepped
    problem = sides.springs.problem
    rest = problem.out_of_balance(end.increment, end.normal, end.shear)
    parts = abs(problem.normal_rows).T @ np.abs(end.normal) + np.abs(problem.force)
    assert np.abs(rest).max() < ROUNDING * parts.max()


def test_products_of_slack_and_flow_change_by_their_targets_to_first_order(stepped):
    sides, at, targets, step, _ = stepped
    change = at.slack * step.flow + at.flow * step.slack
    size = np.abs(at.slack * step.flow) + np.abs(at.flow * step.slack)
    assert (np.abs(change - targets) <= ROUNDING * size)[sides.active].all()


def test_gaps_and_slips_are_those_of_forces_and_flow_after_a_whole_step(stepped):
    sides, _, _, _, end = stepped
    flow = np.where(sides.active, end.flow, 0.0)
    normal, shear = np.stack((end.normal, end.shear)) * sides.give
    gap, slip = sides.springs.problem.jumps(end.increment)
    size = ROUNDING * (np.abs(normal) + np.abs(shear) + flow.max()).max()
    np.testing.assert_allclose(gap, normal + flow[0], rtol=0, atol=size)
    glides = ~sides.smooth
    expected = (shear + flow[1] - flow[2])[glides]
    np.testing.assert_allclose(slip[glides], expected, rtol=0, atol=size)


def test_slack_is_what_normal_forces_lack_to_their_limit_after_a_whole_step(stepped):
    sides, _, _, _, end = stepped
    limit = sides.springs.problem.limits.tension
    active = sides.active[0]
    left = (limit - end.normal)[active]
    size = ROUNDING * np.abs(end.normal).max()
    np.testing.assert_allclose(end.slack[0][active], left, rtol=0, atol=size)
