"""Which way goes first: by counted cost, tried again at intervals that double."""

import numpy as np

from nmm.contact.iteration.options.budgets import IterationBudget
from nmm.contact.iteration.options.springs import WayOptions
from nmm.contact.iteration.ways import Ways
from nmm.contact.problem.cut_springs import IterationResult

OPTIONS = WayOptions()
WHOLE = IterationBudget()


INSIDE = IterationResult(None, np.zeros(0), 0.0, 40, 10, "")


def steps(ways, count):
    """Whether the alternation is tried in each of so many steps that the interior point ends."""
    tried = []
    for _ in range(count):
        tried.append(ways.budget(WHOLE, False, OPTIONS) is not None)
        ways.interior_took(INSIDE.cost(OPTIONS.inside), OPTIONS)
    return tried


def test_alternation_goes_first_and_may_cost_what_the_interior_point_is_guessed_to():
    budget = Ways().budget(WHOLE, False, OPTIONS)
    assert budget.cost == OPTIONS.guess
    assert (budget.solves, budget.factors) == (WHOLE.solves, WHOLE.factors)


def test_trials_of_the_loser_come_after_one_two_four_and_at_most_sixteen_steps():
    # by hand: tried at first, then after 1, 2, 4, 8, 16, 16 steps
    expected = np.cumsum([0, 1, 2, 4, 8, 16, 16])
    assert np.flatnonzero(steps(Ways(), 50)).tolist() == expected.tolist()


def test_a_trial_is_cheap_and_its_success_puts_the_alternation_first_again():
    ways = Ways()
    steps(ways, 1)
    assert ways.leads
    budget = ways.budget(WHOLE, False, OPTIONS)
    assert budget.cost == OPTIONS.trial
    ways.alternation_met()
    assert not ways.leads
    # the interior point's cost is known now: 40 solves and 10 steps of 20
    assert ways.budget(WHOLE, False, OPTIONS).cost == 240.0


def test_a_start_near_the_end_is_always_alternated_and_uses_up_no_trial():
    ways = Ways()
    steps(ways, 2)
    for _ in range(5):
        assert ways.budget(WHOLE, True, OPTIONS).cost == OPTIONS.near
    assert steps(ways, 2) == [False, True]


def test_the_first_factor_keeps_the_longer_the_more_often_the_second_did_not_pay():
    ways = Ways()
    stays = []
    for paid in (False, False, False, True, True, True):
        ways.second_factor(paid, 3.0)
        stays.append(ways.stay)
    # by hand: doubled up to 3, halved down to 1
    assert stays == [2.0, 3.0, 3.0, 1.5, 1.0, 1.0]
