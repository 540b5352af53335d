"""What flows into running tips, and what would if they stood."""

import numpy as np
import pytest

from nmm.fracture.growth.motion.inflow import EnergyInflow

BOUND, PIECE = 100.0, np.array([2.0])
FIRST = np.array([0])


def run_on(tip: EnergyInflow, part: float, rate: float) -> EnergyInflow:
    """Return a tip after a piece at a part of the bound, with a sawtooth that flows in."""
    span, start = PIECE[0] / (part * BOUND), tip.time
    for share in np.linspace(0, 1, 401)[1:]:  # steps
        tip = tip.after(start + share * span, np.array([2 * rate * share]))
    return tip.cut(FIRST, PIECE, BOUND)


@pytest.mark.parametrize("part", [0.2, 0.5, 0.8])
def test_what_would_flow_into_a_tip_at_rest_follows_from_the_mean_of_a_piece(part: float) -> None:
    at_rest = 3.0
    tip = EnergyInflow.none(1, 0.0).after(1.0, np.array([2.5])).cut(FIRST, PIECE, BOUND)
    # Until its first piece is cut the tip has stood.
    assert tip.driving == pytest.approx([2.5])
    tip = run_on(tip, part, at_rest * (1 - part))  # Freund: G (1 - v / c_R)
    # A step of a four-hundredth; the sawtooth falls to its start within the first.
    assert tip.at_rest == pytest.approx([at_rest], rel=0.01)


def test_what_is_seen_to_flow_in_counts_where_it_is_more() -> None:
    tip = EnergyInflow.none(1, 0.0).after(1.0, np.array([2.5])).cut(FIRST, PIECE, BOUND)
    assert tip.after(1.1, np.array([4.0])).driving == pytest.approx([4.0])
    assert tip.after(1.1, np.array([0.5])).driving == pytest.approx([2.5])


def test_a_tip_into_which_nothing_flows_over_a_piece_stops() -> None:
    tip = EnergyInflow.none(1, 0.0).after(1.0, np.array([2.5])).cut(FIRST, PIECE, BOUND)
    assert run_on(tip, 0.6, 0.1).at_rest[0] < 1.0


def test_branches_go_on_with_what_their_tip_had() -> None:
    tip = EnergyInflow.none(1, 0.0).after(1.0, np.array([2.5])).cut(FIRST, PIECE, BOUND)
    assert tip.divided(FIRST).driving == pytest.approx([2.5, 2.5])
    assert tip.joined(EnergyInflow.none(1, tip.time)).driving == pytest.approx([2.5, 0.0])
