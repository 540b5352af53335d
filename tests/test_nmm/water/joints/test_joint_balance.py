"""What joints store above the water, by their shape."""

import numpy as np
import pytest

from nmm.water.joints.balance import JointBalance
from nmm.water.joints.network import JointNetwork


@pytest.mark.parametrize("drawn", [0.0, 1e-3])
def test_a_level_slit_stores_its_length_above_the_water_closed_or_open(drawn):
    # Of height w and length 2, a half of which is a node's: w 2 / 2 / w.
    slit = JointNetwork(np.array([[0, 1]]), np.array([2.0]), 2)
    balance = JointBalance(slit, np.zeros(2), np.array([drawn]), 1.0, 1e-5)
    joints = balance.opened(np.full((1, 2), 1e-3))
    stored = balance.matrix(joints, np.array([-1e-9, -1e-9]), joints.volume, 0.0)
    np.testing.assert_allclose(stored, np.eye(2), rtol=1e-12)


WIDE, TALL, CELLS = 1e-3, 10.0, 40
"""A vertical slit: its width and height (m), links between its nodes."""


def upright():
    """Return the balance of a vertical slit, and its joints."""
    ends = np.stack([np.arange(CELLS), np.arange(CELLS) + 1], axis=1)
    slit = JointNetwork(ends, np.full(CELLS, TALL / CELLS), CELLS + 1)
    level, drawn = np.linspace(0.0, TALL, CELLS + 1), np.full(CELLS, WIDE)
    balance = JointBalance(slit, level, drawn, 1.0, 9810 / 2.2e9)
    return balance, balance.opened(np.full((CELLS, 2), WIDE))


def over(balance, joints, head, foot, step, steps):
    """Return heads after steps with a head at the foot, and what came in there and all in all."""
    came, still = np.zeros(len(head)), (joints.volume, joints.volume)
    for _ in range(steps):
        given = np.array([0]), np.array([foot])
        head, inflow = balance.heads(joints, head, still, given, step)
        came += inflow
    return head, came


def test_an_empty_slit_that_stands_takes_the_water_that_fills_it():
    """``w (9 - 1)``: nodes far above the water, once empty, take no more than they hold."""
    balance, joints = upright()
    begun = np.full(CELLS + 1, 1.0)
    head, came = over(balance, joints, begun, 9.0, 1e3, 5)
    np.testing.assert_allclose(head, 9.0, rtol=1e-8)
    # Water is compressed by 9 kPa to 88 kPa, to 4e-5 of it.
    assert came[0] == pytest.approx(WIDE * 8.0, rel=1e-4)
    assert np.abs(came[1:]).max() < 1e-10 * came[0]
    head, back = over(balance, joints, head, 1.0, 1e3, 5)
    # An empty node keeps storing 1e-9 of what it drains by.
    assert came[0] + back[0] == pytest.approx(0.0, abs=1e-7 * came[0])
    assert np.abs(back[1:]).max() < 1e-10 * came[0]


def test_a_slit_fills_from_its_foot_as_fast_as_the_cubic_law_lets_it():
    """``w dL/dt = T (H - L) / L``: L to M takes ``w / T (H ln((H - L) / (H - M)) - M + L)``."""
    balance, joints = upright()
    high, first, last = 9.0, 1.0, 5.0
    let_through = 9810 * WIDE**3 / 12e-3
    lasts = WIDE / let_through * (high * np.log((high - first) / (high - last)) + first - last)
    came = over(balance, joints, np.full(CELLS + 1, first), high, lasts / 400, 400)[1]
    # Cells of 0.25 m of 4 m that fill, of order 1 in both.
    assert came[0] == pytest.approx(WIDE * (last - first), rel=0.03)
