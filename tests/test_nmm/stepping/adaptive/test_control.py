"""The control of steps alone: bounds, growth, and errors that steps must not exceed."""

import pytest

from nmm.formulation import IntegratorTable
from nmm.stepping.adaptive.control import StepChoice, StepControl


def control(order=2, **keys):
    return StepControl.of(IntegratorTable(step="auto", **keys), order, duration=10.0)


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("start", [1e-4, 0.9])
def test_lengths_settle_where_the_error_is_what_is_aimed_at(order, start):
    """Errors ``(h / 0.1)^(p + 1)`` over the bound: the controller settles within 30 steps."""
    asked = control(order)
    length, last = start, None
    for _ in range(30):
        ratio = (length / 0.1) ** (order + 1)
        length, last = asked.after(length, ratio, last), ratio
    # A step that would grow by less than 15 % stays: so far below what is aimed at it may end.
    assert 0.1 * 0.7 ** (1 / (order + 1)) / 1.3 < length < 0.1


def test_steps_stay_between_their_bounds_and_grow_by_three_at_most():
    asked = control(shortest=1e-3, longest=0.5)
    assert asked.after(0.4, 0.0, None) == 0.5
    assert asked.after(2e-3, 1e9, None) == 1e-3
    assert asked.after(0.01, 0.0, None) == pytest.approx(0.03, rel=1e-12)


def test_a_step_that_would_grow_by_little_stays_as_its_matrix_is_known():
    assert control().after(0.1, 0.6, 0.6) == 0.1


def test_a_record_bounds_the_steps():
    asked = StepControl.of(IntegratorTable(step="auto"), 2, 10.0, resolves=0.02)
    assert asked.longest == 0.02
    assert asked.first <= 0.02


@pytest.mark.parametrize("order", [1, 2])
def test_an_error_that_is_halvings_above_the_bound_is_halved_so_often(order):
    for count in (1, 2, 3):
        ratio = 0.7 * 2.0 ** (count * (order + 1)) * 0.99
        assert control(order).halvings(ratio) == count


def test_places_and_speeds_are_shares_of_the_largest():
    seen = StepChoice().seen(2.0, 10.0).seen(1.0, 30.0)
    asked = control(error=0.01)
    assert asked.bound == pytest.approx(1e-3, rel=1e-12)
    assert asked.ratio(seen, 2e-3, 0.0, 1.0) == pytest.approx(1.0, rel=1e-12)
    assert asked.ratio(seen, 0.0, 6e-2, 1.0) == pytest.approx(2.0, rel=1e-12)


def test_with_order_one_speeds_count_by_what_places_are_off():
    seen = StepChoice().seen(1.0, 1.0)
    assert control(1, error=0.1).ratio(seen, 1e-3, 0.0, 1e-2) == pytest.approx(10.0, rel=1e-12)


def test_nothing_that_moves_errs_by_nothing():
    assert control().ratio(StepChoice(), 0.0, 0.0, 1.0) == 0.0
    # An error of nothing lets a step grow as much as any may: by three.
    assert control().after(0.1, 0.0, 0.0) == pytest.approx(0.3, rel=1e-12)
