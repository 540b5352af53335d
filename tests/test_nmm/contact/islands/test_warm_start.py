"""Where the search for a step's unknowns starts, and when a slow one is broken off."""

from dataclasses import replace

import numpy as np
import pytest

from nmm.contact.islands.warm_start import start_from
from nmm.contact.iteration.memory import Memory
from nmm.contact.iteration.newton.compiled_newton import lost as forecast
from nmm.contact.iteration.newton.compiled_newton import terms
from nmm.contact.iteration.options.budgets import Patience
from nmm.contact.problem.cut_springs import CutSprings
from nmm.testing.contact_oracle import random_problem

LOADS = np.random.default_rng(0).normal(size=(2, 6))


def apart(load: np.ndarray) -> CutSprings:
    """A step whose contacts are far from closing, so that it is linear."""
    problem = random_problem(3)
    gap = np.full_like(problem.gap, 1e6)
    size = len(problem.force)
    return CutSprings.of(replace(problem, gap=gap, force=np.resize(load, size)))


def solution(springs: CutSprings) -> np.ndarray:
    return np.linalg.solve(springs.problem.matrix.toarray(), springs.problem.force)


def test_a_linear_step_starts_at_its_solution_if_that_is_a_mix_of_the_last_two() -> None:
    known = [solution(apart(load)) for load in LOADS]
    now = apart(0.3 * LOADS[0] + 0.9 * LOADS[1])
    # least squares with a ridge of 1e-10 of the trace leave about that of the unknowns
    np.testing.assert_allclose(start_from(now, known, mixes=True), solution(now), rtol=1e-6)


def test_without_inertia_a_step_starts_from_rest_or_as_the_last_one_ended() -> None:
    known = [solution(apart(load)) for load in LOADS]
    along, across = apart(1.1 * LOADS[0]), apart(-LOADS[0])
    np.testing.assert_array_equal(start_from(along, known, mixes=False), known[0])
    assert not start_from(across, known, mixes=False).any()


def test_a_second_solution_of_a_step_takes_the_place_of_the_first() -> None:
    memory, load = Memory(), np.ones(3)
    for found, under in ((1.0, load), (2.0, load + 1), (3.0, (load + 1).copy())):
        memory.keep(np.full(3, found), under)
    assert [float(one[0]) for one in memory.found] == [3.0, 1.0]


@pytest.mark.parametrize(("ahead", "lost"), [(19, True), (21, False)])
def test_a_search_that_halves_its_error_is_given_up_when_too_many_halves_lie_ahead(
    ahead: float, lost: bool
) -> None:
    sizes = 2.0 ** (20 - np.arange(6))  # 2^15 left above a tolerance of 2^-5
    assert forecast(sizes, terms(Patience(ahead)), 2.0**-5) is lost
    assert not forecast(sizes, terms(Patience(ahead, below=1.0)), 2.0**-5)
