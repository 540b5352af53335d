"""From where gaps count: what a spring may store that appears, goes on or is handed on."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nmm.contact.points.contact_points import PARTS, ContactPoints
from nmm.contact.points.continued.predecessors import Predecessors
from nmm.contact.points.continued.reference_gap import counted

BODY = np.array([0, 0, 1, 1, 2, 2])
GAP = st.floats(-1e-2, 1e-2)


def points(gap, key=0, reference=0.0, length=0.0, edges=(0, 2), force=0.0):
    """One contact point."""
    arrays = {name: np.zeros(1) for name in PARTS}
    found = {"gap": [gap], "reference": [reference], "length": [length]}
    found |= {"key": [key], "edge_a": [edges[0]], "edge_b": [edges[1]], "normal_force": [force]}
    arrays |= {name: np.array(value) for name, value in found.items()}
    return ContactPoints(**arrays, history={})


def follow(new, old=None, continues=False, stiffness=(1.0, 1.0), left=None, ahead=False):
    """The new point, continuing the old one or not; ``left`` is of joints that came apart."""
    predecessor = np.array([0 if continues else -1])
    new_stiffness, old_stiffness = stiffness
    none = points(0.0).take(np.zeros(0, dtype=int))
    before = Predecessors(none if old is None else old, predecessor, np.zeros(1, dtype=bool))
    return counted(
        new,
        before,
        lambda part: np.where(part.key == 0, old_stiffness, new_stiffness),
        BODY,
        none if left is None else left,
        ahead,
    )


@given(GAP)
def test_an_overlap_that_no_step_made_is_no_stretch(gap):
    found = follow(points(gap))
    assert found.gap[0] == max(gap, 0.0)
    assert found.reference[0] == min(gap, 0.0)


@given(GAP, GAP, st.floats(-1e-2, 0.0))
def test_gap_and_reference_always_add_up_to_what_is_measured(gap, last, reference):
    old = points(last, reference=reference)
    for new, continues in ((points(gap), True), (points(gap, key=1), True), (points(gap), False)):
        found = follow(new, old, continues)
        # One rounding of numbers of a centimetre.
        assert found.gap[0] + found.reference[0] == pytest.approx(gap, abs=1e-17)
        assert found.reference[0] <= 0.0


@given(GAP, st.floats(-1e-2, 0.0))
def test_a_reference_recovers_when_the_contact_opens_and_never_grows(gap, reference):
    found = follow(points(gap), points(0.0, reference=reference), continues=True)
    assert found.reference[0] >= reference
    if gap >= reference:
        assert found.gap[0] >= 0.0
        assert found.reference[0] == min(gap, 0.0)
    else:
        assert found.reference[0] == reference


@given(st.floats(0.0, 1e-2), st.floats(-1e-2, -1e-6))
def test_what_pushes_before_its_sides_touch_keeps_its_gap_and_so_its_force(gap, reference):
    # The force of a barrier is a function of this gap alone.
    old = points(gap, reference=reference, force=-1.0)
    found = follow(points(gap + reference), old, continues=True, ahead=True)
    assert found.gap[0] == pytest.approx(gap, abs=1e-17)  # one rounding of a centimetre


@given(GAP, st.floats(-1e-2, 0.0), st.floats(1e-3, 1e3))
def test_a_spring_handed_on_has_neither_more_force_nor_more_energy(gap, stretch, ratio):
    found = follow(points(gap, key=1), points(stretch), continues=True, stiffness=(ratio, 1.0))
    pressed = min(found.gap[0], 0.0)
    # Gap and reference of a centimetre leave 2e-18 m of their difference.
    allowed = 1e-17
    assert -pressed <= -stretch / ratio + allowed
    assert -pressed <= -stretch / np.sqrt(ratio) + allowed


def test_a_spring_handed_on_to_one_as_stiff_and_as_deep_keeps_its_force():
    found = follow(points(-3e-3, key=1), points(-1e-6, reference=-1e-3), continues=True)
    assert found.gap[0] == pytest.approx(-1e-6, rel=1e-9)


def test_a_new_stretch_of_faces_in_touch_is_pressed_as_its_neighbour_and_no_deeper():
    neighbour = points(-2e-6, length=0.5)
    beside = follow(points(-5e-6, key=1, length=0.1, edges=(1, 3)), neighbour)
    np.testing.assert_allclose(beside.gap, -2e-6)
    shallow = follow(points(-1e-6, key=1, length=0.1, edges=(1, 3)), neighbour)
    np.testing.assert_allclose(shallow.gap, -1e-6)
    elsewhere = follow(points(-5e-6, key=1, length=0.1, edges=(1, 4)), neighbour)
    assert elsewhere.gap[0] == 0.0


@given(st.floats(-1e-2, -1e-6), st.floats(-1e-2, -1e-6))
def test_what_is_found_in_place_of_a_joint_holds_no_more_energy_than_the_joint(gap, last):
    found = follow(points(gap, key=1), left=points(last, key=-1, length=1.0))
    # One rounding of the square and of its root.
    assert abs(found.gap[0]) == pytest.approx(min(abs(gap), abs(last)), rel=1e-12)


def test_a_joint_between_other_bodies_leaves_nothing_behind():
    found = follow(points(-1e-3, key=1), left=points(-1e-3, key=-1, length=1.0, edges=(2, 4)))
    assert found.gap[0] == 0.0
