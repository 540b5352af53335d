"""Lagrange multipliers on an active set."""

from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np
from scipy.sparse import block_array, csc_array, csr_array, diags_array

from integration.arrays import Floats
from nmm.contact.enforcement.iterative import ExactEnforcement
from nmm.contact.enforcement.open_close import ActiveSet, changes, first_active_set
from nmm.contact.iteration.exact import exact_round
from nmm.contact.iteration.interior.interior_point import Goal
from nmm.contact.iteration.multiplier_rounds import (
    MultiplierIterate,
    compliances,
    measured,
    stiff_springs,
)
from nmm.contact.iteration.tools import Tools
from nmm.contact.problem.coulomb import frictionless, shear_bound
from nmm.contact.problem.cut_springs import CutSprings, IterationResult
from nmm.contact.problem.step_problem import StepProblem
from nmm.errors import SolveError
from nmm.registry import above_zero
from nmm.solvers.linear import LinearSolver

SOFT = 1e-10
"""Compliance in the (2,2) block, as a part of the contact's; refinement removes its effect."""
REFINEMENTS = 10
"""Most refinements with the matrix without that compliance."""


@dataclass(frozen=True)
class Lagrange(ExactEnforcement):
    """Contact forces as unknowns: ``[K G; G^T 0] [d; lambda] = [F; -gap]`` (Cai, Liang, Ma 2000).

    A pass solves the system of the closed contacts, with a shear multiplier where they stick and
    the friction of the unknown normal force where they slide; the set is corrected until it
    stands. Gaps of closed contacts are zero to rounding.

    More contacts than unknowns make the matrix singular: a (2,2) block ``-1e-10 c`` with ``c`` the
    contact's compliance keeps it regular, and refinement with the matrix without that block removes
    its effect when the constraints agree with one another. When they do not (a wall whose blocks
    have more contacts than unknowns), when the set cycles, or when it sets a part free, the
    way of `Cone` finds the same exact conditions, and the verdict says so.

    Attributes
    ----------
    max_passes
        Most corrections of the active set.
    rescue
        Most factorisations of the interior point.
    """

    name: ClassVar[str] = "lagrange"
    max_passes: int = above_zero(20)
    rescue: int = 100

    def forces(
        self, problem: StepProblem, tools: Tools, goal: Goal
    ) -> tuple[MultiplierIterate, str]:
        """Correct the active set until it stands."""
        at, how = self._active_set(stiff_springs(problem, 1.0), tools.linear)
        if at is None or not at.meets(goal):
            at, rest = exact_round(problem, tools, goal, self.rescue)
            how = f"{how}, then {rest}"
        return at, how

    def _active_set(
        self, springs: CutSprings, linear: LinearSolver
    ) -> tuple[MultiplierIterate | None, str]:
        problem = springs.problem
        active, seen = first_active_set(problem), set[bytes]()
        for passes in range(1, self.max_passes + 1):
            seen.add(active.code)
            if _constraints(problem, active) > len(problem.force):
                return None, "more contacts than unknowns"
            try:
                increment, normal, shear = _saddle(problem, active, linear)
            except SolveError:
                if passes == 1 and not active.closed.all():
                    active = replace(active, closed=np.ones_like(active.closed))
                    continue
                return None, f"a singular active set in pass {passes}"
            found = _corrected(problem, active, increment, normal, shear)
            if not changes(problem, active, found).any():
                forces = np.stack([normal, shear])
                shifted = springs.shifted(np.where(problem.own_stiffness, 0.0, forces))
                size = shifted.residual(increment).size
                result = IterationResult(shifted, increment, size, passes, passes, "")
                return measured(result, passes), f"{passes} active sets"
            if found.code in seen:
                return None, f"an active set that cycled after {passes} passes"
            active = found
        return None, f"{self.max_passes} active sets"


def _constraints(problem: StepProblem, active: ActiveSet) -> int:
    sharp = active.closed & ~problem.own_stiffness
    return int(sharp.sum() + (sharp & ~active.sliding).sum())


def _saddle(
    problem: StepProblem, active: ActiveSet, linear: LinearSolver
) -> tuple[Floats, Floats, Floats]:
    """Unknowns, normal and shear forces of an active set."""
    limits, own = problem.limits, problem.own_stiffness
    closed = np.flatnonzero(active.closed)
    stuck = np.flatnonzero(active.sticks(limits))
    normal_rows, shear_rows = problem.normal_rows[closed], problem.tangent_rows[stuck]
    drag = np.where(active.sliding, active.sign * limits.friction, 0.0)[closed]
    pressing = normal_rows.T - problem.tangent_rows[closed].T @ diags_array(drag)
    soft = np.where(own, 1 / problem.stiffness, 0.0)
    compliance = np.concatenate([soft[0][closed], soft[1][stuck]])
    normal_part, shear_part = compliances(problem)
    regular = compliance + SOFT * np.concatenate([normal_part[closed], shear_part[stuck]])

    pull = np.where(active.closed, 0.0, limits.tension)
    # Without the friction of the unknown normal force: the bound under no pressure.
    bound = shear_bound(np.zeros_like(pull), active.closed, limits)
    constant = active.sign * np.where(active.sliding, bound, 0.0)
    load = problem.force - problem.normal_rows.T @ pull - problem.tangent_rows.T @ constant
    rhs = np.concatenate([load, -problem.gap[closed], -problem.slip[stuck]])
    size, matrix = len(problem.force), _matrix(problem, pressing, normal_rows, shear_rows, regular)
    x = _refined(linear, matrix, regular - compliance, rhs)
    normal, shear = pull.copy(), constant.copy()
    normal[closed] = x[size : size + len(closed)]
    shear[closed] -= drag * normal[closed]
    shear[stuck] = x[size + len(closed) :]
    return x[:size], normal, shear


def _matrix(
    problem: StepProblem,
    pressing: csc_array,
    normal_rows: csr_array,
    shear_rows: csr_array,
    compliance: Floats,
) -> csc_array:
    """Matrix of unknowns and forces; ``pressing`` is what normal forces do, with their friction."""
    n, corner = normal_rows.shape[0], diags_array(-compliance).tocsr()
    parts: list[list[Any]] = [
        [problem.matrix, pressing, shear_rows.T],
        [normal_rows, corner[:n, :n], None],
        [shear_rows, None, corner[n:, n:]],
    ]
    return csc_array(block_array(parts))


def _refined(linear: LinearSolver, regular: csc_array, soft: Floats, rhs: Floats) -> Floats:
    """Solve with the matrix without the compliance ``soft`` of its last unknowns, the forces."""
    factor = linear.indefinite().factorise(regular)
    x = factor.solve(rhs)
    best, least = x, np.inf
    for _ in range(REFINEMENTS):
        rest = rhs - regular @ x
        rest[len(rhs) - len(soft) :] -= soft * x[len(rhs) - len(soft) :]
        size = float(np.linalg.norm(factor.scale * rest))
        if not size < 0.5 * least:
            break
        best, least = x, size
        x = x + factor.apply(rest)
    return best


def _corrected(
    problem: StepProblem, active: ActiveSet, increment: Floats, normal: Floats, shear: Floats
) -> ActiveSet:
    limits, own = problem.limits, problem.own_stiffness
    gap, slip = problem.jumps(increment)
    force = max(float(np.abs(normal).max(initial=0.0)), float(np.abs(shear).max(initial=0.0)))
    compliance = compliances(problem)
    near_force, near_gap, near_slip = (
        1e-12 * force,
        1e-10 * force * compliance[0],
        1e-10 * force * compliance[1],
    )
    stretch = np.where(own, limits.tension / problem.normal_stiffness, 0.0)
    stretch = np.where(np.isfinite(stretch), stretch, 0.0)
    opens = normal > limits.tension + near_force
    closes = gap < stretch - near_gap
    is_open = np.where(active.closed, opens, ~closes)
    bound = shear_bound(np.minimum(normal, limits.tension), ~is_open, limits)
    smooth = frictionless(limits)
    elastic = np.where(own, shear / problem.shear_stiffness, 0.0)
    stays = active.sliding & (active.sign * (slip - elastic) >= -near_slip)
    resists = active.closed | (limits.tension > 0)
    turned = ~active.sliding & resists & (np.abs(shear) > bound + near_force)
    sliding = stays | turned | smooth
    sign = np.where(stays, active.sign, np.sign(shear))
    return ActiveSet(~is_open, sliding, np.where(smooth, 0.0, sign) * sliding)
