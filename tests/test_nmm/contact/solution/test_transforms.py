"""Transforms of the contact problem: each gives the answer that its closed form asks for."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from scipy.sparse import csc_array, csr_array

from nmm.contact.enforcement.base import make_enforcement
from nmm.contact.enforcement.null_space import NullSpace
from nmm.contact.laws.dashpots import Dashpots
from nmm.contact.laws.tension_compression import AsymmetricSprings
from nmm.contact.laws.time_weighting import RaisedFaces, TimeWeighting
from nmm.contact.problem.step_problem import BONDED, STICK, Limits, StepProblem
from nmm.contact.problem.transform import Transform, solve_through
from nmm.solvers.linear import make_solver

SPRING, MATRIX = 7.0, 2.0


def pressed(force, gap=-0.1, tension=0.0):
    """One unknown on one contact that resists below; nothing along it."""
    one = np.ones(1)
    return StepProblem(
        csc_array([[MATRIX]]),
        np.array([force]),
        csr_array([[1.0]]),
        csr_array([[0.0]]),
        gap=gap * one,
        slip=0 * one,
        normal_stiffness=SPRING * one,
        shear_stiffness=one,
        limits=Limits(tension * one, 0 * one, 0 * one),
        state=np.array([STICK if tension == 0 else BONDED]),
        normal_force=0 * one,
        shear_force=0 * one,
        compliant=np.ones(1, dtype=bool),
    )


def solved(problem, *transforms):
    linear = make_solver()
    answer = solve_through(
        transforms, problem, lambda last: make_enforcement("penalty").solve(last, linear)
    )
    assert answer.verdict.converged
    return answer


def balance(problem, answer):
    """What is left of ``K d + N = F`` with the one contact."""
    return MATRIX * answer.increment[0] + answer.normal_force[0] - problem.force[0]


def test_raised_faces_press_as_if_they_had_begun_nearer():
    """``N = k (g - lift)``: d = (F - k (g0 - lift)) / (K + k)."""
    problem = pressed(-3.0)
    answer = solved(problem, RaisedFaces(np.array([0.05])))
    expected = (-3.0 - SPRING * (-0.1 - 0.05)) / (MATRIX + SPRING)
    assert answer.increment[0] == pytest.approx(expected, rel=1e-12)
    assert answer.gap[0] == pytest.approx(-0.1 + expected, rel=1e-12)


def test_a_damper_pushes_by_its_rate():
    """``N = k g1 + c (g1 - g0) / dt`` with c / dt = 4."""
    problem = pressed(-3.0)
    answer = solved(problem, Dashpots(np.array([4.0]), problem.gap))
    expected = (-3.0 - SPRING * -0.1) / (MATRIX + SPRING + 4.0)
    assert answer.increment[0] == pytest.approx(expected, rel=1e-12)
    assert answer.normal_force[0] == pytest.approx(
        SPRING * answer.gap[0] + 4.0 * (answer.gap[0] + 0.1), rel=1e-12
    )


def test_a_spring_weighted_in_time_takes_the_mean_of_both_ends():
    """``N = k (g0 + g1) / 2``, after a damper and a lift as before them."""
    problem = pressed(-3.0)
    mean = TimeWeighting(np.array([0.5]), np.zeros(1), np.zeros(1, dtype=bool))
    answer = solved(problem, mean)
    assert answer.normal_force[0] == pytest.approx(SPRING * (answer.gap[0] - 0.1) / 2, rel=1e-12)
    assert balance(problem, answer) == pytest.approx(0.0, abs=1e-12)
    damper = Dashpots(np.array([4.0]), problem.gap)
    answer = solved(problem, mean, damper, RaisedFaces(np.array([0.05])))
    gap = answer.gap[0]
    want = SPRING * (gap - 0.05 - 0.1) / 2 + 4.0 * (gap - 0.05 + 0.1)
    assert answer.normal_force[0] == pytest.approx(want, rel=1e-12)
    assert balance(problem, answer) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("force", [-3.0, 3.0])
def test_an_asymmetric_spring_is_softer_open_than_pressed(force):
    """``k g`` pressed, ``k g / 4`` open."""
    problem = pressed(force, gap=0.0, tension=np.inf)
    answer = solved(problem, AsymmetricSprings(np.array([0]), np.array([0.25])))
    stiffness = SPRING * (1.0 if force < 0 else 0.25)
    assert answer.increment[0] == pytest.approx(force / (MATRIX + stiffness), rel=1e-12)
    assert len(answer.normal_force) == 1
    assert balance(problem, answer) == pytest.approx(0.0, abs=1e-12)


def test_transforms_of_fewer_unknowns_give_the_start_of_the_search_in_them():
    """d_0 = 2 d_1 by a null space: the start keeps the unknown that is free."""
    rows = csr_array([[1.0, -2.0]])
    space = NullSpace.of(rows, np.zeros(1))
    whole = np.array([2.0, 1.0])
    kept = space.of_unknowns(whole)
    assert space.basis @ kept + space.start == pytest.approx(whole)


def test_forces_that_cancel_are_as_large_in_fewer_unknowns_as_what_may_be_left_of_them():
    """d_0 = 2 d_1: forces of 3 and 5 N come to 2 * 3 + 5 N on what is free, or to -1 N."""
    space = NullSpace.of(csr_array([[1.0, -2.0]]), np.zeros(1))
    problem = replace(pressed(-3.0), among=np.array([3.0]))
    rows = csr_array((1, 2))
    problem = replace(
        problem,
        matrix=csc_array(np.eye(2)),
        force=np.array([-3.0, 5.0]),
        normal_rows=rows,
        tangent_rows=rows,
        among=np.array([3.0, 5.0]),
    )
    free = np.abs(space.basis.toarray()).T
    assert space.apply(problem).among == pytest.approx(free @ [3.0, 5.0])


@dataclass(frozen=True)
class Suction(Transform):
    """A pressure in the contact that pulls its sides together, of a third party."""

    pull: float

    def apply(self, problem):
        return replace(problem, force=problem.force - problem.normal_rows.T @ [self.pull])

    def undo(self, answer, problem):
        return replace(answer, normal_force=answer.normal_force + self.pull)


def test_a_transform_of_ones_own_stands_in_the_list():
    """Suction of 1 N in a contact that is pressed: N counts both, in balance with the load."""
    problem = pressed(-3.0)
    answer = solved(problem, RaisedFaces(np.array([0.05])), Suction(1.0))
    assert answer.increment[0] == pytest.approx(
        (-4.0 - SPRING * (-0.1 - 0.05)) / (MATRIX + SPRING), rel=1e-12
    )
    assert balance(problem, answer) == pytest.approx(0.0, abs=1e-12)


def test_a_bond_that_is_spent_rubs_under_its_whole_pressure():
    """Friction of 0.5 under N = -3 N of a spring without tension: it holds 1.4 N, and not 1.6 N."""
    for pull, slides in ((1.4, False), (1.6, True)):
        one = np.ones(1)
        problem = StepProblem(
            csc_array(np.diag([0.1, 0.1])),
            np.array([-3.0, pull]),
            csr_array([[1.0, 0.0]]),
            csr_array([[0.0, 1.0]]),
            gap=0 * one,
            slip=0 * one,
            normal_stiffness=SPRING * one,
            shear_stiffness=SPRING * one,
            limits=Limits(0 * one, 0 * one, 0.5 * one),
            state=np.array([STICK]),
            normal_force=-3 * one,
            shear_force=0 * one,
            compliant=np.ones(1, dtype=bool),
        )
        answer = solved(problem, AsymmetricSprings(np.array([0]), np.zeros(1)))
        pressure = 3 * SPRING / (SPRING + 0.1)
        assert answer.normal_force[0] == pytest.approx(-pressure, rel=1e-9)
        stuck, limit = pull * SPRING / (SPRING + 0.1), 0.5 * pressure
        held = min(stuck, limit)
        assert abs(answer.shear_force[0]) == pytest.approx(held, rel=1e-6)
        assert (stuck > limit) == slides
