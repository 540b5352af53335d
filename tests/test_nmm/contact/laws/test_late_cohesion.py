"""Cohesion of joints that open within a step in time."""

from types import SimpleNamespace

import numpy as np
import pytest

from nmm.contact.laws.late_cohesion import LateCohesion
from nmm.contact.problem.step_problem import Limits


def contacts(gap, force):
    return SimpleNamespace(
        gap=np.array(gap), normal_force=np.array(force), length=np.ones(len(gap))
    )


def limits(cohesion, tension):
    return Limits(np.array(tension), np.array(cohesion), np.full(len(cohesion), 0.5))


def test_only_joints_without_bond_that_have_a_cohesion_are_looked_at():
    at = contacts([0.0, 0.0], [0.0, 0.0])
    assert LateCohesion.of(limits([0.0, 0.0], [0.0, 0.0]), at) is None
    assert LateCohesion.of(limits([5.0, 5.0], [1.0, np.inf]), at) is None
    assert LateCohesion.of(limits([5.0, 0.0], [0.0, 0.0]), at) is not None


@pytest.mark.parametrize(
    ("gap", "force", "kept"),
    [
        (0.0, 0.0, 5.0),  # as it was drawn
        (-1e-3, -7.0, 5.0),
        (1e-13, 0.0, 5.0),  # rounding
        (1e-3, 0.0, 0.0),
        (1e-7, -7.0, 5.0),  # exact contacts press at gaps of their tolerance
    ],
)
def test_a_joint_has_its_cohesion_if_it_is_closed_where_the_step_begins(gap, force, kept):
    found = LateCohesion.of(limits([5.0], [0.0]), contacts([gap], [force]))
    assert found.cohesion[0] == kept
