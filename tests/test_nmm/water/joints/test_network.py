"""Flow in networks of joints against closed forms, and what is singular in them."""

import numpy as np
import pytest

from nmm.errors import SolveError
from nmm.water.joints.network import JointNetwork


def even(apertures):
    return np.repeat(np.asarray(apertures)[:, None], 2, axis=1)


def chain(cells, length, apertures):
    ends = np.stack([np.arange(cells), np.arange(cells) + 1], axis=1)
    network = JointNetwork(ends, np.full(cells, length / cells), cells + 1)
    return network, np.array([0, cells]), even(np.broadcast_to(apertures, cells))


def test_joints_in_series_share_the_head_and_a_dead_end_has_that_of_its_root():
    network = JointNetwork(np.array([[0, 1], [1, 2], [1, 3]]), np.array([4.0, 1.0, 2.0]), 4)
    conductance = network.conductance(even([2e-4, 1e-4, 3e-4]))
    heads = network.heads(conductance, np.array([0, 2]), np.array([12.0, 0.0]))
    assert heads == pytest.approx([12.0, 8.0, 0.0, 8.0], rel=1e-14)
    assert network.flows(conductance, heads)[2] == pytest.approx(0.0, abs=1e-18)


def test_uplift_below_a_dam_follows_from_the_apertures_and_a_drain():
    network, fixed, _ = chain(2, 2.0, 1e-4)
    network = JointNetwork(network.ends, np.array([8.0, 16.0]), 3)
    conductance = network.conductance(even([2e-4, 4e-4]))
    heads = network.heads(conductance, fixed, np.array([28.0, 0.0]))
    assert heads[1] == pytest.approx(5.6, rel=1e-13)
    assert network.flows(conductance, heads) == pytest.approx([1.8312e-5] * 2, rel=1e-12)
    means = (heads[:-1] + heads[1:]) / 2
    assert 9810 * means @ network.length == pytest.approx(1757952.0, rel=1e-12)
    drained = JointNetwork(network.ends, np.array([6.0, 18.0]), 3)
    conductance = drained.conductance(even([2e-4, 2e-4]))
    heads = drained.heads(conductance, np.arange(3), np.array([28.0, 28.0 / 3, 0.0]))
    means = (heads[:-1] + heads[1:]) / 2
    # The published head of the drain is rounded to 9.33 m: the uplift to four digits.
    assert 9810 * means @ drained.length == pytest.approx(1922367.6, rel=1e-3)


def test_a_square_network_conducts_as_its_continuum():
    n, spacing, aperture = 6, 0.5, 1e-4
    number = np.arange((n + 1) ** 2).reshape(n + 1, n + 1)
    along = np.stack([number[:, :-1].ravel(), number[:, 1:].ravel()], axis=1)
    up = np.stack([number[:-1].ravel(), number[1:].ravel()], axis=1)
    ends = np.concatenate([along, up])
    network = JointNetwork(ends, np.full(len(ends), spacing), number.size)
    conductance = network.conductance(even(np.full(len(ends), aperture)))
    fixed = np.concatenate([number[:, 0], number[:, -1]])
    heads = network.heads(conductance, fixed, np.repeat([1.0, 0.0], n + 1))
    flow = network.inflow(conductance, heads)[number[:, 0]].sum()
    # n + 1 rows of joints over n spacings; K = w^3 g / (12 mu s).
    assert flow * n * spacing / ((n + 1) * spacing) == pytest.approx(1.635e-6, rel=1e-12)


@pytest.mark.parametrize("wide", [1e-6, 1e-4, 1e-2, 1e-1])
def test_heads_keep_their_digits_among_apertures_of_all_sizes(wide):
    # A wide joint between two narrow ones: both its ends have half the head.
    network, fixed, _ = chain(3, 3.0, 1e-4)
    conductance = network.conductance(even([1e-6, wide, 1e-6]))
    heads = network.heads(conductance, fixed, np.array([2.0, 0.0]))
    narrow, between = 1 / conductance[0], 1 / conductance[1]
    drop = 2.0 * between / (2 * narrow + between)
    assert heads[1] == pytest.approx(1 + drop / 2, rel=1e-13)
    assert heads[2] == pytest.approx(1 - drop / 2, rel=1e-13)


def test_parts_that_no_head_reaches_are_named_and_closed_joints_are_dry():
    ends = np.array([[0, 1], [1, 2], [3, 4], [2, 3]])
    network = JointNetwork(ends, np.ones(4), 6)
    conductance = network.conductance(even([1e-4, 1e-4, 1e-4, 0.0]))
    fixed = np.array([0])
    assert network.isolated(conductance, fixed).tolist() == [False, False, False, True, True, False]
    with pytest.raises(SolveError, match="node 3 first"):
        network.heads(conductance, fixed, np.array([5.0]))
    closed = network.conductance(even([1e-4, 1e-4, 0.0, 0.0]))
    heads = network.heads(closed, fixed, np.array([5.0]))
    assert heads[:3] == pytest.approx([5.0, 5.0, 5.0], rel=1e-14)
    assert np.isnan(heads[3:]).all()
