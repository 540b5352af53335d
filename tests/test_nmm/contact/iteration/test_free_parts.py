"""A search that ends out of balance says whether a part came free, or the search stalled."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.sparse import csc_array, csr_array

from nmm.contact.iteration.answers import unsettled
from nmm.contact.iteration.memory import Memory
from nmm.contact.iteration.options import DEFAULT
from nmm.contact.iteration.tools import Tools
from nmm.contact.problem.cut_springs import CutSprings, IterationResult
from nmm.contact.problem.step_problem import OPEN, Limits, StepProblem
from nmm.solvers.linear import make_solver


def one_contact(force: float) -> CutSprings:
    """One unknown, which nothing but a contact of 10 N/m resists; it opens as the unknown grows."""
    one, none = np.ones(1), np.zeros(1)
    return CutSprings.of(
        StepProblem(
            matrix=csc_array((1, 1)),
            force=np.array([force]),
            normal_rows=csr_array([[1.0]]),
            tangent_rows=csr_array([[0.0]]),
            gap=none,
            slip=none,
            normal_stiffness=10 * one,
            shear_stiffness=10 * one,
            limits=Limits(none, none, none),
            state=np.array([int(OPEN)]),
            normal_force=none,
            shear_force=none,
        )
    )


@pytest.mark.parametrize(("force", "code"), [(1.0, "singular"), (-1.0, "stalled")])
def test_what_is_pulled_off_its_only_contact_is_free_and_what_is_pressed_on_is_not(force, code):
    springs = one_contact(force)
    # Pressed by 2 N whatever the load: a step of Newton's method goes to balance, or off.
    found = IterationResult(springs, np.array([-0.2]), 1.0, 5, 1, "5 solves")
    verdict = unsettled(found, Tools(make_solver("superlu"), Memory(), DEFAULT), "soften it")
    assert not verdict.converged
    assert verdict.code == code


def test_functions_that_depend_on_one_another_are_no_free_part():
    """Both unknowns move the same held body: how far they cancel is left to rounding."""
    functions, stiff, apart = np.array([1.0, 1 / 3]), 1e10, 1e3
    held = replace(
        one_contact(-1.0).problem,
        matrix=csc_array(stiff * np.outer(functions, functions)),
        force=-1e2 * functions,
        normal_rows=csr_array(functions[None]),
        tangent_rows=csr_array(0 * functions[None]),
    )
    # Forces of 1e13 N cancel but for 1e-3 N, which does work on the motion that moves nothing.
    still = apart * np.array([1 / 3, -1.0])
    found = IterationResult(CutSprings.of(held), still, 1.0, 5, 1, "5 solves")
    verdict = unsettled(found, Tools(make_solver("superlu"), Memory(), DEFAULT), "soften it")
    assert verdict.code == "stalled"


def test_contacts_most_out_of_balance_are_named_first():
    springs = one_contact(-1.0)
    problem = springs.problem
    two = replace(
        problem,
        matrix=csc_array(np.eye(2)),
        force=np.array([-1.0, -5.0]),
        **{name: np.tile(getattr(problem, name), 2) for name in ("gap", "slip", "state")},
        **{f"{way}_stiffness": np.full(2, 10.0) for way in ("normal", "shear")},
        **{f"{way}_force": np.zeros(2) for way in ("normal", "shear")},
        limits=Limits(*np.zeros((3, 2))),
        normal_rows=csr_array(np.eye(2)),
        tangent_rows=csr_array(np.zeros((2, 2))),
    )
    found = IterationResult(CutSprings.of(two), np.zeros(2), 1.0, 5, 1, "5 solves")
    verdict = unsettled(found, Tools(make_solver("superlu"), Memory(), DEFAULT), "soften it")
    assert verdict.contacts == (1, 0)
