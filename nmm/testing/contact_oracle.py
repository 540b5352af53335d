"""Small contact problems and all their solutions, by enumeration: what enforcements are held to.

Dense algebra on the words of the law; shares nothing with the enforcements.
"""

from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.sparse import csc_array, csr_array

from integration.arrays import Floats
from nmm.contact.problem.step_problem import STICK, Limits, StepAnswer, StepProblem


@dataclass(frozen=True)
class Solution:
    """Unknowns (n,) and forces (m,) that meet every condition."""

    increment: Floats
    normal_force: Floats
    shear_force: Floats


def make_problem(
    matrix: npt.ArrayLike,
    force: npt.ArrayLike,
    normal_rows: npt.ArrayLike,
    tangent_rows: npt.ArrayLike,
    penalty: float = 1e8,
    friction: float = 0.5,
    cohesion: float = 0.0,
    tension: float = 0.0,
    **columns: Any,
) -> StepProblem:
    """Return a problem of equal contacts that touch; ``columns`` replaces fields of the problem."""
    normal, tangent = np.atleast_2d(normal_rows), np.atleast_2d(tangent_rows)
    zero, one = np.zeros(len(normal)), np.ones(len(normal))
    fields: dict[str, Any] = {
        "gap": zero,
        "slip": zero,
        "normal_stiffness": penalty * one,
        "shear_stiffness": penalty * one,
        "limits": Limits(tension * one, cohesion * one, friction * one),
        "state": np.full(len(normal), int(STICK)),
        "normal_force": zero,
        "shear_force": zero,
    }
    given = {k: v if isinstance(v, Limits) else np.asarray(v) for k, v in columns.items()}
    return StepProblem(
        csc_array(np.asarray(matrix, dtype=float)),
        np.asarray(force, dtype=float),
        csr_array(normal.astype(float)),
        csr_array(tangent.astype(float)),
        **(fields | given),
    )


def random_problem(seed: int, bonded: bool = False, own: bool = False) -> StepProblem:
    """Return one to four contacts on six unknowns, forces of order one, stiffness 100.

    ``bonded`` gives some contacts tension and cohesion, ``own`` some a stiffness of their own.
    """
    rng = np.random.default_rng(seed)
    n, m = 6, int(rng.integers(1, 5))
    root = rng.normal(size=(n, n))
    rows = rng.normal(size=(2, m, n)) / np.sqrt(n)
    pull = rng.choice([0.0, 0.3], m) if bonded else np.zeros(m)
    cohesion = rng.choice([0.0, 0.2], m) if bonded else np.zeros(m)
    return make_problem(
        root @ root.T + 0.1 * np.eye(n),
        rng.normal(size=n),
        rows[0],
        rows[1],
        penalty=100.0,
        limits=Limits(pull, cohesion, rng.choice([0.0, 0.3, 0.6], m)),
        gap=rng.normal(size=m) * rng.choice([0.0, 0.05], m),
        compliant=(rng.random(m) < 0.5) & own,
    )


def all_solutions(problem: StepProblem, exact: bool, tolerance: float = 1e-9) -> list[Solution]:
    """Solve for every combination of contact states and keep what obeys the law.

    States are open, sticking, and sliding either way; contacts with a tension limit also slide
    under pull, and open at the limit sticking or sliding. ``exact`` replaces penalties by
    ``gap >= 0``. The number of combinations is 4^m to 8^m.
    """
    kinds = ["op+-><OQ" if pull > 0 else "op+-" for pull in problem.limits.tension]
    found = []
    for states in product(*kinds):  # every one is a linear system of its own
        solution = _solve(problem, states, exact)
        if solution is not None and obeys(problem, solution, exact, tolerance):
            found.append(solution)
    return found


def obeys(
    problem: StepProblem,
    found: Solution | StepAnswer,
    exact: bool,
    tolerance: float,
    gap_tolerance: float | None = None,
) -> bool:
    """Whether forces are admissible and fit gaps and slips.

    ``tolerance`` is for forces (N), ``gap_tolerance`` for lengths (m), the same number by default.
    """
    limits, normal, shear = problem.limits, found.normal_force, found.shear_force
    soft = ~(exact & ~problem.own_stiffness)
    opening = problem.gaps(found.increment) - soft * normal / problem.normal_stiffness
    sliding = problem.slips(found.increment) - soft * shear / problem.shear_stiffness
    length = tolerance if gap_tolerance is None else gap_tolerance
    is_open = opening > length
    lost = is_open & (limits.tension == 0)
    bound = np.where(lost, 0.0, limits.cohesion + limits.friction * np.maximum(-normal, 0))
    slides = (np.abs(sliding) > length) & ~lost
    conditions = (
        normal <= limits.tension + tolerance,
        np.abs(shear) <= bound + tolerance,
        opening >= -length,
        ~is_open | (np.abs(normal - limits.tension) <= tolerance),
        ~slides | (np.abs(np.abs(shear) - bound) <= tolerance),
        ~slides | (sliding * shear >= -tolerance),
    )
    return all(bool(condition.all()) for condition in conditions)


def is_one_of(answer: StepAnswer, solutions: list[Solution], tolerance: float) -> bool:
    """Whether the forces of ``answer`` are those of one of ``solutions``."""
    return any(
        np.allclose(answer.normal_force, solution.normal_force, rtol=0, atol=tolerance)
        and np.allclose(answer.shear_force, solution.shear_force, rtol=0, atol=tolerance)
        for solution in solutions
    )


def _solve(problem: StepProblem, states: tuple[str, ...], exact: bool) -> Solution | None:
    """Linear system of d, N, T with one row for each force that its state fixes."""
    n, m = len(problem.force), problem.n_contacts
    gn, gt = problem.normal_rows.toarray(), problem.tangent_rows.toarray()
    pull, cohesion = problem.limits.tension, problem.limits.cohesion
    soft = ~(exact & ~problem.own_stiffness)
    a, b = np.zeros((n + 2 * m, n + 2 * m)), np.zeros(n + 2 * m)
    a[:n] = np.hstack([problem.matrix.toarray(), gn.T, gt.T])
    b[:n] = problem.force
    for i, state in enumerate(states):
        normal, shear = n + i, n + m + i
        if state in "oOQ":
            a[normal, normal], b[normal] = 1.0, pull[i]
        else:
            a[normal, :n], b[normal] = -gn[i], problem.gap[i]
            a[normal, normal] = soft[i] / problem.normal_stiffness[i]
        if state == "p" or (state == "o" and pull[i] > 0):
            a[shear, :n], b[shear] = -gt[i], problem.slip[i]
            a[shear, shear] = soft[i] / problem.shear_stiffness[i]
            continue
        sign = {"o": 0.0, "+": 1.0, ">": 1.0, "O": 1.0}.get(state, -1.0)
        a[shear, shear], b[shear] = 1.0, sign * cohesion[i]
        if state in "+-":
            a[shear, normal] = sign * problem.limits.friction[i]
    try:
        x: Floats = np.linalg.solve(a, b).astype(np.float64)
    except np.linalg.LinAlgError:
        return None
    return Solution(x[:n], x[n : n + m], x[n + m :])
