"""Forces on every body where statics with contact ends, asked of what was found."""

from dataclasses import replace

import pytest

import nmm
from nmm.contact.solution import driver
from nmm.scene import parse_scene
from nmm.stepping.step.budget import Budget, BudgetSpentError
from nmm.stepping.step.nonlinear.inner import InternalForces
from nmm.verification import text

STACK = text.scene(
    text.weighty(),
    [
        text.material("rock"),
        *text.floor(),
        text.box("low", (-0.5, 0), (1, 1)),
        text.box("top", (-0.3, 1), (0.6, 0.6)),
    ],
)
METHODS = ["penalty", "augmented", "lagrange", "cone", "barrier"]


@pytest.mark.parametrize("enforcement", METHODS)
def test_blocks_at_rest_are_in_balance_to_rounding(enforcement: str) -> None:
    given = f'normal_penalty = 100.0\nenforcement = "{enforcement}"'
    run = nmm.run(parse_scene(STACK.replace("normal_penalty = 100.0", given)))
    assert run.summary.status == "converged"
    # The barrier's iterations end at 1e-8 of the load.
    assert run.summary.audits["force_balance"] < 1e-7


@pytest.mark.parametrize("missed", [1e-5, 1e-2])
def test_a_solver_that_says_it_has_found_what_it_has_not_is_found_out(monkeypatch, missed) -> None:
    """Forces of contacts that are said to be larger than they are are no equilibrium."""
    honest = driver.solve_rebalanced

    def boasting(*given):
        answer = honest(*given)
        return replace(answer, normal_force=(1 + missed) * answer.normal_force)

    monkeypatch.setattr(driver, "solve_rebalanced", boasting)
    run = nmm.run(parse_scene(STACK))
    assert run.summary.equilibrium_residual < 1e-8
    # On the upper block, of two forces as large as its weight.
    assert run.summary.audits["force_balance"] == pytest.approx(missed / 2, rel=0.05)
    assert any("force_balance" in one for one in run.summary.warnings)
    assert run.summary.status == ("unbalanced" if missed > 1e-3 else "converged")


SLACK = text.scene(
    'plane = "strain"\n',
    [
        text.material("rock"),
        text.block("plate", "rock", text.rectangle((-1, 0), (1, 1))),
        '[[supports]]\nname = "pin"\npoint = [-1, 0]\nfix = ["x", "y"]\n',
        *(
            f'[[springs]]\nname = "at {x}"\npoints = [[{x}, {y}], [{x}, {y + way}]]\n'
            f'blocks = ["plate", "ground"]\nstiffness = 1e6\ncarries = "tension"\n'
            for x, y, way in ((0, 1, 1), (1, 0, -1))
        ),
        '[[loads]]\nname = "down"\nkind = "point"\npoint = [1, 1]\nforce = [0, -1e3]\n',
    ],
)


def test_a_first_iteration_that_is_taken_for_the_answer_is_found_out_without_contact(monkeypatch):
    """It counts with both springs, of which one goes slack and holds nothing."""
    assert nmm.run(parse_scene(SLACK)).summary.audits["force_balance"] < 1e-8
    monkeypatch.setattr(InternalForces, "imbalance", lambda *given: 0.0)
    run = nmm.run(parse_scene(SLACK))
    assert run.summary.status == "unbalanced"
    assert run.summary.audits["force_balance"] > 0.1


@pytest.mark.parametrize("solutions", range(3, 12))
def test_of_a_step_that_a_budget_has_broken_off_nothing_is_left(monkeypatch, solutions) -> None:
    """Corrections for the moved place are accepted before it is known where the step ends.

    Increments take two or three solutions each: some budgets end between two of them.
    """
    left = iter(range(solutions))

    def check(budget: Budget) -> None:
        if next(left, None) is None:
            raise BudgetSpentError("the budget was spent")

    monkeypatch.setattr(Budget, "check", check)
    load = '[[loads]]\nname = "down"\nkind = "point"\npoint = [0, 1.6]\nforce = [2e2, -1e6]\n'
    steps = "[loading]\nuntil = 1.0\n[formulation.loading]\nincrement = 0.1\n"
    run = nmm.run(parse_scene(STACK + load + steps))
    assert run.summary.status == "budget_spent"
    contact = run.stepper.plan.contact
    assert contact.standing.normal_force.tolist() == run.contact_forces[:, 0].tolist()
    assert run.summary.audits.get("force_balance", 0.0) < 1e-7
