"""Enforcements on problems that can be solved by hand."""

from dataclasses import replace
from itertools import pairwise
from math import cos, radians, sin, tan

import numpy as np
import pytest

from nmm.contact.enforcement.base import ENFORCEMENTS, make_enforcement
from nmm.contact.problem.step_problem import BONDED, BROKEN, OPEN, SLIDE, STICK, Limits, StepProblem
from nmm.errors import FormulationError, SolveError
from nmm.solvers.linear import make_solver
from nmm.testing.contact_oracle import make_problem, random_problem

EXACT = ["augmented", "lagrange", "cone"]
ALL = ENFORCEMENTS.names()
WEIGHT = 1000.0 * 9.81


def resting(contacts: int, penalty: float = 1e8, stiffness: float = 0.0) -> StepProblem:
    """A mass with unknowns x, y on equal contacts, held in x."""
    rows = [[0.0, 1.0]] * contacts
    tangents = [[1.0, 0.0]] * contacts
    matrix = np.diag([1.0, stiffness])
    return make_problem(matrix, [0.0, -WEIGHT], rows, tangents, penalty=penalty)


def incline(angle: float, friction: float, cohesion: float = 0.0) -> StepProblem:
    """A block of 1 kN on two contacts of a plane; x down the plane, inertia in both unknowns."""
    force = [1000 * sin(radians(angle)), -1000 * cos(radians(angle))]
    rows, tangents = [[0.0, 1.0]] * 2, [[1.0, 0.0]] * 2
    return make_problem(
        1e5 * np.eye(2), force, rows, tangents, friction=friction, cohesion=cohesion / 2
    )


@pytest.mark.parametrize("contacts", [1, 2, 5])
@pytest.mark.parametrize("iteration", ["settle", "open_close"])
def test_penetration_is_weight_over_the_springs(contacts: int, iteration: str) -> None:
    problem = resting(contacts)
    answer = make_enforcement("penalty", {"iteration": iteration}).solve(problem, make_solver())
    assert answer.verdict.converged
    # benchmark B11: mg/(n p), to rounding
    np.testing.assert_allclose(-answer.gap, WEIGHT / (contacts * 1e8), rtol=1e-12)
    np.testing.assert_allclose(-answer.normal_force, WEIGHT / contacts, rtol=1e-12)


@pytest.mark.parametrize("name", EXACT)
@pytest.mark.parametrize("contacts", [1, 2, 5])
def test_exact_enforcements_leave_no_gap_and_share_the_weight(name: str, contacts: int) -> None:
    answer = make_enforcement(name).solve(resting(contacts, stiffness=1e6), make_solver())
    assert answer.verdict.converged, answer.verdict.sentence
    assert np.abs(answer.gap).max() < 1e-10
    assert -answer.normal_force.sum() == pytest.approx(WEIGHT, rel=1e-8)


@pytest.mark.parametrize("p_over_k", [0.1, 1.0, 10.0, 1000.0])
@pytest.mark.parametrize("rounds", [1, 2, 3, 6])
def test_augmented_forces_approach_by_one_over_one_plus_pc(p_over_k: float, rounds: int) -> None:
    stiffness = 1e6
    options = {"scale": None, "growth": 1.0, "max_rounds": rounds, "rescue": 0, "tolerance": 1e-15}
    problem = resting(1, penalty=p_over_k * stiffness, stiffness=stiffness)
    answer = make_enforcement("augmented", options).solve(problem, make_solver())
    # benchmark B11: lambda_k = F [1 - (ks/(ks+p))^k]
    expected = WEIGHT * (1 - (1 / (1 + p_over_k)) ** rounds)
    assert -answer.normal_force[0] == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("name", EXACT)
def test_exact_results_do_not_depend_on_the_penalty(name: str) -> None:
    forces = []
    for power in range(7):
        problem = incline(30, 0.7)
        given = replace(
            problem,
            normal_stiffness=1e5 * 10.0**power * np.ones(2),
            shear_stiffness=1e5 * 10.0**power * np.ones(2),
        )
        options = {"scale": None} if name == "augmented" else {}
        answer = make_enforcement(name, options).solve(given, make_solver())
        assert answer.verdict.converged, answer.verdict.sentence
        forces.append([answer.normal_force, answer.shear_force])
    # benchmark B11: 1e-8 for p/E in 1..1e6
    np.testing.assert_allclose(forces, [forces[0]] * 7, rtol=1e-8)


@pytest.mark.parametrize("name", ALL)
@pytest.mark.parametrize("power", range(0, 7, 2))
def test_resultants_do_not_depend_on_the_penalty(name: str, power: int) -> None:
    problem = resting(3, penalty=1e6 * 10.0**power, stiffness=1e2)
    answer = make_enforcement(name).solve(problem, make_solver())
    assert answer.verdict.converged, answer.verdict.sentence
    assert answer.residual < 1e-8
    # what the spring of 1e2 N/m beside the contacts carries is left out
    carried = -answer.normal_force.sum() - 1e2 * answer.increment[1]
    assert carried == pytest.approx(WEIGHT, rel=1e-6)


@pytest.mark.parametrize("name", ALL)
@pytest.mark.parametrize(
    ("angle", "friction", "cohesion", "sticks"),
    [
        (30, tan(radians(30.5)), 0.0, True),
        (30, tan(radians(29.5)), 0.0, False),
        (30, 0.0, 501.0, True),
        (30, 0.0, 499.0, False),
        (45, 0.5, 354.0, True),  # W (sin 45 - 0.5 cos 45) = 353.6 N
        (45, 0.5, 353.0, False),
    ],
)
def test_block_slides_when_friction_and_cohesion_are_spent(
    name: str, angle: float, friction: float, cohesion: float, sticks: bool
) -> None:
    problem = incline(angle, friction, cohesion)
    answer = make_enforcement(name).solve(problem, make_solver())
    assert answer.verdict.converged, answer.verdict.sentence
    normal, along = 1000 * cos(radians(angle)), 1000 * sin(radians(angle))
    assert -answer.normal_force.sum() == pytest.approx(normal, rel=2e-2)
    bound = friction * -answer.normal_force.sum() + cohesion
    if sticks:
        assert set(answer.state) == {STICK}
        assert answer.shear_force.sum() < bound
    else:
        assert set(answer.state) == {SLIDE}
        assert answer.shear_force.sum() == pytest.approx(bound, rel=1e-8)
        assert answer.shear_force.sum() < along


@pytest.mark.parametrize("iteration", ["settle", "open_close"])
def test_cyclic_shear_saturates_at_the_cone_and_unloads_along_the_spring(iteration: str) -> None:
    # benchmark B10: N = 1e5, mu = .3, kt = 1e8, +-1e-3 m
    solver, enforcement = make_solver(), make_enforcement("penalty", {"iteration": iteration})
    problem = make_problem(
        np.diag([1e14, 0.0]), [0.0, -1e5], [[0.0, 1.0]], [[1.0, 0.0]], friction=0.3
    )
    slip, force, path, work = 0.0, 0.0, [0.0], 0.0
    position = (
        np.concatenate([np.linspace(0, 1, 11), np.linspace(0.9, -1, 20), np.linspace(-0.9, 1, 20)])
        * 1e-3
    )
    for last, now in pairwise(position):
        # the matrix 1e14 N/m prescribes the motion to 1e-9 of it
        load = np.array([1e14 * (now - last) + force, -1e5])
        step = replace(problem, force=load, slip=np.array([slip]), shear_force=np.array([force]))
        step = replace(
            step, normal_force=np.array([-1e5]), gap=np.array([-1e-3]), force=load - [0, 0]
        )
        answer = enforcement.solve(replace(step, gap=np.array([0.0])), solver)
        assert answer.verdict.converged, answer.verdict.sentence
        slip, new = answer.slip[0], answer.shear_force[0]
        if path[-1] >= 3e4 - 1 and now < last and new > -3e4:
            assert (path[-1] - new) / (last - now) == pytest.approx(1e8, rel=1e-6)
        work += (new + path[-1]) / 2 * (now - last) if len(path) > 11 else 0.0
        path.append(new)
        force = new
    assert max(path) == pytest.approx(3e4, rel=1e-9)
    assert min(path) == pytest.approx(-3e4, rel=1e-9)
    # the loop: height 2 mu N, width 2 (1e-3 - mu N / kt) = 84 J; corners cut by the trapezium rule
    # at steps of 1e-4 m cost 2 x 3e4 x 2e-4 / 2 at most
    assert work == pytest.approx(84.0, abs=6.0)


@pytest.mark.parametrize("name", EXACT)
def test_exact_cyclic_shear_turns_from_bound_to_bound_at_once(name: str) -> None:
    # benchmark B10 without a spring: N = 1e5, mu = .3, +-1e-3 m
    solver, enforcement = make_solver(), make_enforcement(name)
    problem = make_problem(
        np.diag([1e14, 1e6]), [0.0, -1e5], [[0.0, 1.0]], [[1.0, 0.0]], friction=0.3
    )
    force, work = 0.0, 0.0
    path = np.concatenate([np.linspace(0, 1, 3), np.linspace(0.5, -1, 4), np.linspace(-0.5, 1, 4)])
    for last, now in pairwise(path * 1e-3):
        # the matrix 1e14 N/m prescribes the motion to 3e-10 m
        load = np.array([1e14 * (now - last) + force, -1e5])
        step = replace(problem, force=load, shear_force=np.array([force]))
        answer = enforcement.solve(step, solver)
        assert answer.verdict.converged, answer.verdict.sentence
        force = answer.shear_force[0]
        assert force == pytest.approx(np.sign(now - last) * 3e4, rel=1e-6)
        work += force * (now - last)
    # the way to the first end and a whole loop of height 2 mu N and width 2e-3 m
    assert work == pytest.approx(30.0 + 120.0, rel=1e-6)


@pytest.mark.parametrize("name", ALL)
def test_contact_in_the_air_carries_nothing(name: str) -> None:
    problem = make_problem(np.eye(2), [0.0, 5.0], [[0.0, 1.0]], [[1.0, 0.0]], state=[OPEN])
    answer = make_enforcement(name).solve(problem, make_solver())
    assert answer.verdict.converged
    assert answer.state[0] == OPEN
    assert answer.normal_force[0] == answer.shear_force[0] == answer.slip[0] == 0.0
    assert answer.gap[0] == pytest.approx(5.0, rel=1e-6)


@pytest.mark.parametrize("name", ALL)
@pytest.mark.parametrize(("pull", "state"), [(0.9, BONDED), (1.1, BROKEN)])
def test_bond_holds_up_to_its_tension(name: str, pull: float, state: int) -> None:
    problem = make_problem(
        np.eye(2), [0.0, pull], [[0.0, 1.0]], [[1.0, 0.0]],
        penalty=1e4, tension=1.0, cohesion=1.0, state=[BONDED],
    )  # fmt: skip
    answer = make_enforcement(name).solve(problem, make_solver())
    assert answer.verdict.converged, answer.verdict.sentence
    assert answer.state[0] == state
    # the unit spring of the block carries 1e-4 of the pull at most
    assert answer.normal_force[0] == pytest.approx(min(pull, 1.0), rel=2e-4)


@pytest.mark.parametrize("name", ALL)
def test_unlimited_bond_never_opens_or_slides(name: str) -> None:
    endless = Limits(np.array([np.inf]), np.array([np.inf]), np.array([0.3]))
    problem = make_problem(
        np.eye(2), [1e3, 1e3], [[0.0, 1.0]], [[1.0, 0.0]], limits=endless, state=[BONDED],
        compliant=[True], penalty=1e6,
    )  # fmt: skip
    answer = make_enforcement(name).solve(problem, make_solver())
    assert answer.verdict.converged, answer.verdict.sentence
    assert answer.state[0] == BONDED
    # force of a spring 1e6 beside a spring 1: 1e3 (1 - 1e-6)
    np.testing.assert_allclose(answer.normal_force, 1e3 / (1 + 1e-6), rtol=1e-7)
    np.testing.assert_allclose(answer.shear_force, 1e3 / (1 + 1e-6), rtol=1e-7)


@pytest.mark.parametrize("name", ALL)
def test_own_stiffness_of_a_joint_is_honoured(name: str) -> None:
    problem = replace(resting(2, penalty=1e5), compliant=np.array([True, True]))
    answer = make_enforcement(name).solve(problem, make_solver())
    assert answer.verdict.converged, answer.verdict.sentence
    np.testing.assert_allclose(-answer.gap, WEIGHT / 2e5, rtol=1e-8)


@pytest.mark.parametrize("name", ALL)
def test_free_block_in_statics_is_named_and_not_solved(name: str) -> None:
    problem = make_problem(np.zeros((2, 2)), [0.0, 5.0], [[0.0, 1.0]], [[1.0, 0.0]])
    answer = make_enforcement(name).solve(problem, make_solver())
    assert not answer.verdict.converged
    assert answer.verdict.code == "singular"
    assert "unknown 1" in answer.verdict.sentence


@pytest.mark.parametrize("name", EXACT)
def test_more_contacts_than_unknowns_do_no_harm(name: str) -> None:
    # a rigid bar (y, rotation) on five points: pressures not determined, balance is
    x = np.linspace(-1, 1, 5)
    rows = np.stack([np.ones(5), x], axis=1)
    problem = make_problem(1e3 * np.eye(2), [-10.0, 2.0], rows, np.zeros((5, 2)), friction=0.0)
    answer = make_enforcement(name).solve(problem, make_solver())
    assert answer.verdict.converged, answer.verdict.sentence
    np.testing.assert_allclose(rows.T @ -answer.normal_force, [10.0, -2.0], rtol=1e-7)
    assert answer.normal_force.max() <= 0.0


def test_cycle_is_named_with_contacts_states_and_passes() -> None:
    options = {"iteration": "open_close", "max_passes": 30}
    answer = make_enforcement("penalty", options).solve(random_problem(21), make_solver())
    assert not answer.verdict.converged
    assert answer.verdict.code == "cycle"
    assert answer.verdict.contacts == (0, 1)
    assert "cycled between passes" in answer.verdict.sentence
    assert "contact 1 stick/open" in answer.verdict.sentence


def test_malformed_problem_is_refused_by_name() -> None:
    problem = resting(2)
    with pytest.raises(SolveError, match=r"slip \(3,\): expected \(2,\)"):
        make_enforcement("penalty").solve(replace(problem, slip=np.zeros(3)), make_solver())
    nan = np.array([0.0, np.nan])
    with pytest.raises(SolveError, match=r"force\[1\] = nan"):
        make_enforcement("cone").solve(replace(problem, force=nan), make_solver())


def test_unknown_names_and_options_are_refused() -> None:
    with pytest.raises(FormulationError, match="augmented"):
        make_enforcement("augmentd")
    with pytest.raises(FormulationError, match="expected one of"):
        make_enforcement("penalty", {"max_pases": 3})
    with pytest.raises(FormulationError, match="open_close"):
        make_enforcement("penalty", {"iteration": "shi"})


@pytest.mark.parametrize(("name", "passes"), [("penalty", 3), ("lagrange", 2)])
def test_a_block_that_slides_on_and_on_takes_few_passes(name: str, passes: int) -> None:
    from nmm.contact.iteration.memory import Memory

    problem, memory = incline(30, tan(radians(20))), Memory()
    enforcement, solver, speed = make_enforcement(name), make_solver(), np.zeros(2)
    start, taken = problem.force, []
    for _ in range(6):
        answer = enforcement.solve(problem, solver, memory)
        assert answer.verdict.converged, answer.verdict.sentence
        taken.append(answer.passes)
        # inertia 1e5 in both unknowns: the motion of this step is the momentum of the next
        speed = answer.increment
        problem = replace(
            problem,
            force=start + 1e5 * speed,
            gap=answer.gap,
            slip=answer.slip,
            state=answer.state,
            normal_force=answer.normal_force,
            shear_force=answer.shear_force,
        )
    assert max(taken[1:]) <= passes
    assert set(answer.state) == {SLIDE}
