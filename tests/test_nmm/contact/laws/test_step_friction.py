"""Friction of a corrected step of statics: the force that lasts on the whole slip."""

from dataclasses import replace

import numpy as np
import pytest

from nmm.contact.laws.step_friction import StepFriction


def friction(key: list[int], **given: list[float]) -> StepFriction:
    """Contacts between bodies 1 and 2 that slide from the start."""
    zeros = np.zeros(len(key))
    parts = {"bodies": zeros, "limit": zeros, "force": zeros, "slid": zeros} | given
    acts = np.ones(len(key), dtype=bool)
    arrays = {name: np.array(value, dtype=float) for name, value in parts.items()}
    return StepFriction(key=np.array(key), from_start=acts, counted=0.0, **arrays)


@pytest.mark.parametrize("keys", [[1, 2], [3, 4]], ids=["same contacts", "others"])
def test_a_corrected_step_takes_the_mean_of_its_ends_times_the_way(keys: list[int]) -> None:
    # A block under 6 N at its limit slides by 2 m while its friction grows to 10 N: 16 J. The first
    # solution had found 500 N.
    first = friction([1, 2], limit=[2.0, 4.0], force=[200.0, 300.0], slid=[1.9, 1.9])
    then = friction(keys, limit=[200.0, 300.0], force=[4.0, 6.0], slid=[2.0, 2.0])
    assert first.corrected(then).taken == pytest.approx(16.0, rel=1e-14)


def test_bodies_that_a_correction_finds_apart_have_taken_what_they_did() -> None:
    first = friction([1, 2], limit=[2.0, 4.0], force=[2.0, 4.0], slid=[1.0, 3.0], bodies=[1, 2])
    then = friction([1, 2], force=[0.0, 6.0], slid=[0.0, 4.0], bodies=[1, 2])
    assert first.corrected(then).taken == pytest.approx(2.0 * 1.0 + 5.0 * 4.0, rel=1e-14)


def test_a_correction_without_contacts_keeps_what_was_taken() -> None:
    first = friction([1, 2], limit=[2.0, 4.0], force=[2.0, 4.0], slid=[1.0, 3.0])
    assert first.corrected(friction([])).taken == pytest.approx(14.0, rel=1e-14)


def test_forces_of_rounding_share_the_friction_of_their_bodies() -> None:
    # 3 N on 2 m; shares of 1e-320 N are numbers, where limits over such forces are not.
    first = friction([1, 2], limit=[1.0, 2.0], force=[1.0, 2.0], slid=[0.0, 0.0])
    then = friction([3, 4], force=[1e-320, 0.0], slid=[2.0, 0.0])
    assert first.corrected(then).taken == pytest.approx(3.0, rel=1e-14)


def test_bonds_without_a_limit_take_nothing_where_a_correction_finds_no_force() -> None:
    # 3 N on 2 m at the contact that has the force.
    whole = friction([1, 2], limit=[np.inf, 2.0], force=[1.0, 2.0], slid=[0.0, 0.0])
    whole = replace(whole, from_start=np.zeros(2, dtype=bool))
    then = friction([3, 4], force=[0.0, 3.0], slid=[0.0, 2.0])
    with np.errstate(invalid="raise"):
        assert whole.corrected(then).taken == pytest.approx(6.0, rel=1e-14)
