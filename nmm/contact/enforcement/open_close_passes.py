"""Shi's open-close iteration: passes over the states of contacts until none changes."""

from itertools import pairwise

import numpy as np

from integration.arrays import Floats
from nmm.contact.enforcement.open_close import (
    ActiveSet,
    changes,
    first_active_set,
    forces,
    next_active_set,
    words,
)
from nmm.contact.problem.balance import relative_residual
from nmm.contact.problem.coulomb import label, project, shear_bound
from nmm.contact.problem.matrix_pattern import SpringPattern
from nmm.contact.problem.step_problem import StepAnswer, StepProblem, Verdict
from nmm.errors import SolveError
from nmm.solvers.linear import LinearSolver

REMEDY = "allow more passes, shorten the step or use the cone enforcement"


class OpenClosePasses:
    """One run of the iteration: the trail of states and what the last pass found."""

    def __init__(
        self,
        max_passes: int,
        tolerance: float,
        problem: StepProblem,
        linear: LinearSolver,
        pattern: SpringPattern,
    ) -> None:
        self.max_passes, self.tolerance = max_passes, tolerance
        self.problem, self.linear = problem, linear
        self.pattern = pattern
        self.trail: list[ActiveSet] = []
        self.increment = np.zeros_like(problem.force)
        self.factorisations = 0

    def run(self) -> StepAnswer:
        """Pass until no state changes and the step is in balance, or passes are spent."""
        springs = first_active_set(self.problem)
        friction_from = self.problem.normal_force
        factor, stiff = None, b""
        for _ in range(self.max_passes):
            self.trail.append(springs)
            normal, shear = _stiffness(self.problem, springs)
            key = normal.tobytes() + shear.tobytes()
            try:
                if factor is None or key != stiff:
                    matrix = self.pattern.matrix(self.problem, normal, shear)
                    factor, stiff = self.linear.factorise(matrix), key
                    self.factorisations += 1
                constant = _constant_forces(self.problem, springs, friction_from)
                rhs = self._load(normal, shear, *constant)
                self.increment = factor.solve(rhs)
            except SolveError as fault:
                if len(self.trail) == 1 and not springs.closed.all():
                    springs = ActiveSet(np.ones_like(springs.closed), springs.sliding, springs.sign)
                    continue
                return self._answer(springs, self._singular(springs, fault))
            gap, slip = self.problem.jumps(self.increment)
            found = next_active_set(self.problem, springs, gap, slip)
            friction_from = np.minimum(
                self.problem.normal_stiffness * gap, self.problem.limits.tension
            )
            if not changes(self.problem, springs, found).any():
                answer = self._answer(springs, None)
                if answer.verdict.converged:
                    return answer
            springs = found
        self.trail.append(springs)
        return self._answer(self.trail[-2], self._unsettled())

    def _load(self, kn: Floats, kt: Floats, normal: Floats, shear: Floats) -> Floats:
        p = self.problem
        at_normal = p.normal_rows.T @ (kn * p.gap + normal)
        return np.asarray(p.force - at_normal - p.tangent_rows.T @ (kt * p.slip + shear))

    def _answer(self, springs: ActiveSet, verdict: Verdict | None) -> StepAnswer:
        p = self.problem
        gap, slip = p.jumps(self.increment)
        normal, shear = forces(p, springs, gap, slip)
        residual = relative_residual(p, p.weight, self.increment, normal, shear)
        passes = len(self.trail) - (verdict is not None and verdict.code in ("cycle", "passes"))
        if verdict is None:
            good = residual <= self.tolerance and self._admissible(normal, shear, gap, slip)
            verdict = Verdict(good, "converged", f"contact states settled in {passes} passes")
        resists = (springs.closed | (p.limits.tension > 0)) & (p.shear_stiffness > 0)
        elastic = np.divide(shear, p.shear_stiffness, out=np.zeros_like(shear), where=resists)
        return StepAnswer(
            increment=self.increment,
            normal_force=normal,
            shear_force=shear,
            gap=gap,
            slip=elastic,
            state=label(p, ~springs.closed, springs.sliding),
            passes=passes,
            residual=residual,
            verdict=verdict,
            factorisations=self.factorisations,
            solver=self.linear.name,
        )

    def _admissible(self, normal: Floats, shear: Floats, gap: Floats, slip: Floats) -> bool:
        p = self.problem
        meant = project(p.normal_stiffness * gap, p.shear_stiffness * slip, p.limits)
        size = max(float(np.abs(force).max(initial=0.0)) for force in meant)
        miss = np.abs(np.stack(meant) - np.stack([normal, shear])).max(initial=0.0)
        return bool(miss <= 1e-9 * size)

    def _singular(self, springs: ActiveSet, fault: SolveError) -> Verdict:
        n_open = int((~springs.closed).sum())
        sentence = (
            f"pass {len(self.trail)}: {n_open} of {self.problem.n_contacts} contacts open and "
            f"nothing else holds a part: {fault}"
        )
        return Verdict(False, "singular", sentence)

    def _unsettled(self) -> Verdict:
        codes = [springs.code for springs in self.trail]
        last = len(codes) - 1
        first = max((i for i in range(last - 1) if codes[i] == codes[last]), default=None)
        changing = np.flatnonzero(changes(self.problem, self.trail[-2], self.trail[-1]))
        if first is None or not changing.size:
            tail = f"{changing.size} of {self.problem.n_contacts} contacts changed in pass {last}"
            if not changing.size:
                tail = "states stood still but friction had not settled"
            sentence = f"not settled after {last} passes: {tail}; {REMEDY}"
            return Verdict(False, "passes", sentence, tuple(int(i) for i in changing))
        cycle = self.trail[first:]
        moved = np.zeros(self.problem.n_contacts, dtype=bool)
        for old, new in pairwise(cycle):
            moved |= changes(self.problem, old, new)
        who = np.flatnonzero(moved)
        named = "; ".join(f"contact {i} {_story(cycle, int(i))}" for i in who[:5])
        more = f" and {who.size - 5} more" if who.size > 5 else ""
        between = f"the contact state cycled between passes {first + 1} and {last + 1}"
        sentence = f"{between}: {named}{more}; {REMEDY}"
        return Verdict(False, "cycle", sentence, tuple(int(i) for i in who))


def _stiffness(problem: StepProblem, springs: ActiveSet) -> tuple[Floats, Floats]:
    normal = np.where(springs.closed, problem.normal_stiffness, 0.0)
    return normal, np.where(springs.sticks(problem.limits), problem.shear_stiffness, 0.0)


def _constant_forces(
    problem: StepProblem, springs: ActiveSet, normal: Floats
) -> tuple[Floats, Floats]:
    pull = np.where(springs.closed, 0.0, problem.limits.tension)
    bound = shear_bound(np.where(springs.closed, normal, pull), springs.closed, problem.limits)
    return pull, np.where(springs.sliding, springs.sign * bound, 0.0)


def _story(cycle: list[ActiveSet], contact: int) -> str:
    seen = dict.fromkeys(words(springs, contact) for springs in cycle)
    return "/".join(seen)
