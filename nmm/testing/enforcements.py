"""What every contact enforcement is held to: the enumeration of all contact states."""

from collections.abc import Callable, Iterable
from dataclasses import replace

import numpy as np

from integration.arrays import Floats
from nmm.contact.enforcement.base import Enforcement
from nmm.contact.iteration.memory import Memory
from nmm.contact.problem.step_problem import StepAnswer, StepProblem
from nmm.solvers.linear import make_solver
from nmm.testing.claims import claim, close, finite
from nmm.testing.contact_oracle import (
    Solution,
    all_solutions,
    is_one_of,
    make_problem,
    obeys,
    random_problem,
)

# Forces are of order one and meet the law to 1e-8: a condition of 100 between out-of-balance force
# and contact force is left.
FORCE, BALANCE = 1e-6, 1e-8
# Load (N) over which the answer is differenced; what `FORCE` leaves of it over compliances of 100.
NUDGE, SLOPE = 1e-3, 1e-2
# Stiffness of the random matrices is below 30, in each of up to eight directions, half a width off.
WIDTHS_OFF = 120.0


def check_enforcement(
    enforcement: Enforcement, exact: bool | None = None, seeds: Iterable[int] = range(25)
) -> None:
    """Hold an enforcement to the law of contact, on small problems that are solved by enumeration.

    Where there is a solution one of them is found, and none is claimed where there is none; forces
    are in balance, no contact pulls beyond its strength and no shear beyond friction; bonds and
    joints of their own stiffness obey the law; the answer moves with the load as the enumerated one
    does (its tangent, by central differences); memory and a warm start change no answer; free
    parts are named, and steps without contacts need none.

    Parameters
    ----------
    enforcement
        With its options.
    exact
        Whether gaps are closed exactly, else by the springs of the problem; as it says itself when
        not given. One that smooths the law over a width: `check_smooth_enforcement`.
    seeds
        Of the random problems.

    Raises
    ------
    AssertionError
        Naming the property that is not kept, the problem, by how much, and what was tolerated.
    """
    sharp = enforcement.exact if exact is None else exact
    for seed in seeds:
        _one_of_all(enforcement, seed, sharp)
    for seed in range(100, 115):
        _bonds(enforcement, seed, sharp)
    _memory(enforcement)
    _free(enforcement)
    _no_contacts(enforcement)


def check_smooth_enforcement(
    make: Callable[[float], Enforcement], seeds: Iterable[int] = range(6)
) -> None:
    """Hold an enforcement that smooths the law over a width (m) to tending to the law with it.

    Parameters
    ----------
    make
        From a width to the enforcement.

    Raises
    ------
    AssertionError
        Naming the property that is not kept, the problem, by how much, and what was tolerated.
    """
    for seed in seeds:
        _tends(make, seed)
    _free(make(1e-3))
    _no_contacts(make(1e-3))


def balance(problem: StepProblem, answer: StepAnswer) -> float:
    """Return the force out of balance over the load and the inner force."""
    rest = problem.out_of_balance(answer.increment, answer.normal_force, answer.shear_force)
    size = np.linalg.norm(problem.force) + np.linalg.norm(problem.matrix @ answer.increment)
    return float(np.linalg.norm(rest) / size)


def distance(answer: StepAnswer, solutions: list[Solution]) -> float:
    """Return how far the forces are from the nearest solution (N)."""
    return min((_off(answer, one) for one in solutions), default=np.inf)


def _off(answer: StepAnswer, one: Solution) -> float:
    normal = np.abs(answer.normal_force - one.normal_force).max(initial=0.0)
    return float(max(normal, np.abs(answer.shear_force - one.shear_force).max(initial=0.0)))


def _answer(enforcement: Enforcement, problem: StepProblem, where: str) -> StepAnswer:
    answer = enforcement.solve(problem, make_solver())
    claim(answer.verdict.converged, f"{where}: not solved: {answer.verdict.sentence}")
    _balanced(problem, answer, where, BALANCE)
    return answer


def _balanced(problem: StepProblem, answer: StepAnswer, where: str, tolerance: float) -> None:
    finite(f"{where}: increment", answer.increment)
    left = balance(problem, answer)
    claim(
        left < tolerance, f"{where}: {left:.3g} of the load out of balance, tolerance {tolerance:g}"
    )
    gap = problem.gaps(answer.increment)
    close(f"{where}: gaps of the answer against its increment", answer.gap, gap, 1e-9)


def _one_of_all(enforcement: Enforcement, seed: int, exact: bool) -> None:
    where = f"{type(enforcement).__name__}, random problem {seed}"
    problem = random_problem(seed)
    solutions = all_solutions(problem, exact)
    if not solutions:
        verdict = enforcement.solve(problem, make_solver()).verdict
        claim(not verdict.converged, f"{where}: a solution is claimed where there is none")
        return
    answer = _answer(enforcement, problem, where)
    pull = float(answer.normal_force.max())
    claim(pull <= FORCE, f"{where}: an unbonded contact pulls with {pull:.3g} N")
    off = distance(answer, solutions)
    claim(off <= FORCE, f"{where}: forces {off:.3g} N off every solution, tolerance {FORCE:g}")
    if len(solutions) == 1:
        _tangent(enforcement, problem, exact, where)


def _tangent(enforcement: Enforcement, problem: StepProblem, exact: bool, where: str) -> None:
    """Central differences of the answer by the load, where contact states stay on both sides."""
    way = np.random.default_rng(1).normal(size=len(problem.force))
    ends = [replace(problem, force=problem.force + sign * NUDGE * way) for sign in (1, -1)]
    enumerated = [all_solutions(one, exact) for one in ends]
    if any(len(found) != 1 for found in enumerated):
        return
    answers = [enforcement.solve(one, make_solver()) for one in ends]
    found = (answers[0].increment - answers[1].increment) / (2 * NUDGE)
    expected = (enumerated[0][0].increment - enumerated[1][0].increment) / (2 * NUDGE)
    close(
        f"{where}: change of the increment with the load", found, expected, SLOPE * _size(expected)
    )


def _size(values: Floats) -> float:
    return max(float(np.abs(values).max(initial=0.0)), 1.0)


def _bonds(enforcement: Enforcement, seed: int, exact: bool) -> None:
    where = f"{type(enforcement).__name__}, bonded problem {seed}"
    problem = random_problem(seed, bonded=True, own=True)
    answer = _answer(enforcement, problem, where)
    claim(
        obeys(problem, answer, exact, FORCE),
        f"{where}: forces do not fit gaps, slips and limits within {FORCE:g}",
    )


def _memory(enforcement: Enforcement) -> None:
    name = type(enforcement).__name__
    problem, solver, memory = random_problem(7), make_solver(), Memory()
    cold = enforcement.solve(problem, solver)
    warm = replace(
        problem, normal_force=cold.normal_force, shear_force=cold.shear_force, state=cold.state
    )
    for turn in ("a warm start", "what memory keeps"):
        again = enforcement.solve(warm, solver, memory)
        what = f"{name}: normal forces after {turn}"
        close(what, again.normal_force, cold.normal_force, FORCE)


def _free(enforcement: Enforcement) -> None:
    problem = make_problem(np.zeros((2, 2)), [0.0, 5.0], [[0.0, 1.0]], [[1.0, 0.0]])
    verdict = enforcement.solve(problem, make_solver()).verdict
    claim(
        not verdict.converged and verdict.code == "singular",
        f"{type(enforcement).__name__}: a free block that is pulled off: {verdict.code}, "
        f'"{verdict.sentence}": expected the code "singular"',
    )


def _no_contacts(enforcement: Enforcement) -> None:
    none = np.zeros((0, 3))
    problem = make_problem(2 * np.eye(3), [1.0, 2.0, 3.0], none, none)
    answer = enforcement.solve(problem, make_solver())
    close(
        f"{type(enforcement).__name__}: step without contacts",
        answer.increment,
        [0.5, 1, 1.5],
        1e-9,
    )


def _tends(make: Callable[[float], Enforcement], seed: int) -> None:
    problem = random_problem(seed)
    problem = replace(problem, gap=np.abs(problem.gap))  # nothing begins overlapping
    solutions, errors = all_solutions(problem, exact=True), []
    for width in (1e-2, 1e-4):
        enforcement = make(width)
        where = f"{type(enforcement).__name__} of width {width:g}, random problem {seed}"
        answer = enforcement.solve(problem, make_solver())
        claim(answer.verdict.converged, f"{where}: not solved: {answer.verdict.sentence}")
        _balanced(problem, answer, where, 10 * BALANCE)
        depth = -float(answer.gap.min())
        claim(depth < width / 2 * (1 + 1e-9), f"{where}: an overlap of {depth:.3g} m")
        claim(
            is_one_of(answer, solutions, WIDTHS_OFF * width),
            f"{where}: forces {distance(answer, solutions):.3g} N off, tolerance "
            f"{WIDTHS_OFF * width:g}",
        )
        errors.append(min(np.abs(answer.normal_force - s.normal_force).max() for s in solutions))
    claim(
        errors[1] < 0.1 * errors[0] + 1e-9,
        f"problem {seed}: a hundredth of the width leaves {errors[1]:.3g} N of {errors[0]:.3g} N: "
        "expected a tenth at most",
    )
