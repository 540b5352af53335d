"""Forces on every body where statics ends, asked of what was found."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import nmm
from nmm.contact.solution import driver
from nmm.scene import parse_scene
from nmm.stepping.step.linear.equations import Equations
from nmm.stepping.step.linear.linear_system import LinearSolution, LinearSystem
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
# Two halves whose bond of 1 MPa and 100 J/m2 is torn to 1.3 times the width at which it is lost.
TORN = text.scene(
    'plane = "stress"\nduration = 1.0\n[contact]\n[formulation.integrator]\nstep = 0.05\n',
    [
        text.material("m", modulus=1e10, poisson=0.0, density=None),
        text.interface("joint", 30.0, more={"cohesion": 2e6, "tensile_strength": 1e6})
        + 'bonded = true\nlaw = "linear_softening"\nfracture_energy = 100.0\n',
        text.block("low", "m", text.rectangle((0, 0), (1, 0.1))),
        text.block("up", "m", text.rectangle((0, 0.1), (1, 0.2))),
        text.fixed_edge("base", [[0, 0], [1, 0]]),
        text.fixed_edge("head", [[0, 0.2], [1, 0.2]])
        + "displacement = [0.0, 2.6e-4]\nhistory = [[0, 0], [1, 1]]\n",
        '[formulation.cover]\ntype = "triangles"\nsize = 0.2\ndegree = 1\n',
    ],
)
# A block of 10 kN, dragged 2 m along a floor.
SLID = text.scene(
    'plane = "stress"\nduration = 1.0\n[gravity]\n[contact]\n'
    '[formulation.rotation]\nupdate = "small"\n[formulation.integrator]\nstep = 0.05\n',
    [
        text.material("rock", modulus=1e10, density=1e3),
        *text.floor(),
        text.box("light", (-1.9, 0), (1, 1)),
        text.fixed_edge("rope", [[-1.9, 0], [-1.9, 1]], "x")
        + "displacement = [2.0, 0.0]\nhistory = [[0, 0], [1, 1]]\n",
    ],
)
METHODS = ["penalty", "augmented", "lagrange", "cone", "barrier"]


def boasting(honest: Callable[..., Any], missed: float) -> Callable[..., Any]:
    """Return a solver that finds contact forces too large by a share."""

    def solve(*given: Any) -> Any:
        answer = honest(*given)
        return replace(answer, normal_force=(1 + missed) * answer.normal_force)

    return solve


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
    monkeypatch.setattr(driver, "solve_rebalanced", boasting(driver.solve_rebalanced, missed))
    run = nmm.run(parse_scene(STACK))
    assert run.summary.equilibrium_residual < 1e-8
    # On the upper block, of two forces as large as its weight.
    assert run.summary.audits["force_balance"] == pytest.approx(missed / 2, rel=0.05)
    assert any("force_balance" in one for one in run.summary.warnings)
    assert run.summary.status == ("unbalanced" if missed > 1e-3 else "converged")


def test_a_run_that_was_stopped_is_not_asked() -> None:
    """It may have the contacts of a step half done beside its last state."""
    load = '[[loads]]\nname = "down"\nkind = "point"\npoint = [0, 1.6]\nforce = [0, -1e3]\n'
    steps = "[loading]\nuntil = 1.0\n[formulation.loading]\nincrement = 0.5\nmax_steps = 1\n"
    run = nmm.run(parse_scene(STACK + load + steps))
    assert run.summary.status == "budget_spent"
    assert "force_balance" not in run.summary.audits


def test_meshes_that_were_torn_apart_bear_nothing_that_could_be_out_of_balance() -> None:
    """Solutions leave 1e-8 of what moves them, 0.3 N; a megapascal of bond was 76 % off by that."""
    run = nmm.run(parse_scene(TORN))
    assert run.summary.status == "converged"
    assert not run.summary.warnings
    assert run.history["friction_loss"][-1] == pytest.approx(100.0, rel=1e-5)
    assert (
        np.abs(run.history["reaction:head:y"]).max()
        > 9e5
        > 1e6 * abs(run.history["reaction:head:y"][-1])
    )


def test_a_body_that_slid_far_under_a_tiny_load_is_still_asked(monkeypatch) -> None:
    """Its own stiffness would ask for 7e13 N; 1e-7 of that is 670 times its weight."""
    monkeypatch.setattr(driver, "solve_rebalanced", boasting(driver.solve_rebalanced, 1e-2))
    run = nmm.run(parse_scene(SLID))
    # Weight and reaction, friction of 30 degrees and pull.
    assert run.summary.audits["force_balance"] == pytest.approx(0.01 * np.sqrt(0.75) / 2, rel=0.02)


# A column of 2 x 1 m on a foot that springs hold, without contact.
COLUMN = text.scene(
    'plane = "stress"\n[gravity]\n',
    [
        text.material("rock"),
        text.box("column", (0, 0), (1, 2)),
        text.fixed_edge("foot", [[0, 0], [1, 0]]),
        '[formulation.supports]\nmethod = "penalty"\n',
    ],
)


def test_statics_without_contact_are_asked_too(monkeypatch) -> None:
    assert nmm.run(parse_scene(COLUMN)).summary.audits["force_balance"] < 1e-12
    honest = LinearSystem.solve

    def boast(system: LinearSystem, equations: Equations) -> LinearSolution:
        found = honest(system, equations)
        return replace(found, increment=1.01 * found.increment, apart=None)

    monkeypatch.setattr(LinearSystem, "solve", boast)
    run = nmm.run(parse_scene(COLUMN))
    # Of the weight and of what the foot bears, as large.
    assert run.summary.audits["force_balance"] == pytest.approx(0.01 / 2.01, rel=1e-6)
    assert run.summary.status == "unbalanced"


def test_forces_below_rounding_of_a_place_are_told_and_are_no_failure() -> None:
    """A block of 1 g/m2 and 10 TPa, dragged 0.5 m: 1e-16 m are tens of newtons of its supports.

    Beside matter that may yield steps do not begin where the ground has carried the block.
    """
    light = text.scene(
        text.weighty(),
        [
            text.material("rock") + 'law = "von_mises"\nyield_stress = 1e9\n',
            text.material("light", modulus=1e13, density=1e-2),
            *text.floor(),
            text.box("heavy", (-1.9, 0), (1, 1)),
            text.block("dragged", "light", text.rectangle((0, 0), (1, 1))),
            '[[supports]]\nname = "rope"\nblock = "dragged"\nfix = ["x"]\n'
            "displacement = [0.5, 0.0]\n[loading]\nuntil = 1.0\n"
            "[formulation.loading]\nincrement = 0.25\n",
        ],
    )
    summary = nmm.run(parse_scene(light)).summary
    assert summary.status == "converged"
    assert summary.audits["force_balance"] > 1e-4
    assert any("smaller than rounding of its place" in one for one in summary.warnings)
