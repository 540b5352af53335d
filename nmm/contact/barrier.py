"""Incremental potential contact on the linearised gaps of a step."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from integration.arrays import Bools, Floats
from nmm.contact.alternation import Budget
from nmm.contact.answer import free_part, singular_answer, worst_contacts
from nmm.contact.balance import relative_residual
from nmm.contact.enforcement import Enforcement
from nmm.contact.law import label
from nmm.contact.memory import Memory
from nmm.contact.pattern import SpringPattern
from nmm.contact.problem import StepAnswer, StepProblem, Verdict
from nmm.contact.rounds import compliances, stiff_springs
from nmm.contact.settle import settle
from nmm.contact.springs import CutSprings, Settled
from nmm.errors import SolveError
from nmm.solvers.linear import LinearSolver

NEAR = 0.9
"""Part of the distance to a wall that a step may use up."""
PLAIN = 10
"""Updates of the friction bound before they are halved."""


@dataclass(frozen=True)
class Barrier(Enforcement):
    """A smooth barrier in place of the constraint (Li et al. 2020, equations 5, 6, 11, 14).

    Normal forces follow ``b(x) = -(x - w)^2 ln(x / w)``, ``x = gap + w/2``: they act within
    half a width ``w`` of touching and grow without bound at ``gap = -w/2``, which no step reaches.
    Friction is a smooth function of the slip that meets Coulomb's bound at a slip of ``w/2``; the
    bound is that of the last normal force, and is updated until both agree. The potential is
    convex for a given bound, so Newton's method with a line search finds its minimum.

    Gaps are wrong by up to ``w/2`` and sticking slips by up to ``w/2``: these are the numbers to
    choose ``w`` by. Contacts with a tension limit or a stiffness of their own are springs.

    Attributes
    ----------
    width
        ``w`` (m); None takes a thousandth of what the largest contact force of the first step
        would press into its contact (compliance times force).
    max_passes
        Most Newton steps for one bound, and most updates of the bound.
    tolerance
        Largest relative out-of-balance force (-).
    """

    name: ClassVar[str] = "barrier"
    width: float | None = None
    max_passes: int = 100
    tolerance: float = 1e-7

    def solve(
        self, problem: StepProblem, linear_solver: LinearSolver, memory: Memory | None = None
    ) -> StepAnswer:
        """Minimise the potential, then update the friction bound, until both stand."""
        problem.check()
        memory = memory or Memory()
        springs = stiff_springs(problem, 1.0)
        try:
            rough = settle(springs, linear_solver, memory, 1e-2, budget=Budget(20, 2, 0))
        except SolveError as fault:
            return singular_answer(springs, linear_solver, fault)
        force = max(float(np.abs(f).max(initial=0.0)) for f in springs.forces(rough.increment))
        ease = float(np.mean(compliances(problem)[0])) if problem.n_contacts else 1.0
        width = self.width or memory.barrier_width or 1e-3 * force * ease or 1e-3 * ease
        memory.barrier_width = width
        well = _Potential(problem, memory.pattern_of(problem), width, max(force, width / ease))
        return _Descent(self, well, linear_solver).run(rough, memory)


class _Potential:
    """Energy, forces and curvatures of a step for a given bound of the friction."""

    def __init__(
        self, problem: StepProblem, pattern: SpringPattern, width: float, force: float
    ) -> None:
        self.problem, self.pattern, self.width = problem, pattern, width
        self.scale = force / width
        self.spring = problem.own_stiffness | (problem.limits.tension > 0)
        self.offset = width / 2 + np.maximum(-problem.gap - 0.49 * width, 0.0) * ~self.spring
        self.deep = int((self.offset > width / 2).sum())
        self.stretch = np.where(np.isfinite(problem.limits.tension), problem.limits.tension, np.inf)
        self.stretch = self.stretch / problem.normal_stiffness

    def distance(self, increment: Floats) -> Floats:
        """(m,) ``x / w``; infinite for springs."""
        x = (self.problem.gaps(increment) + self.offset) / self.width
        return np.where(self.spring, np.inf, x)

    def normal(self, increment: Floats) -> tuple[Floats, Floats, Floats]:
        """Energy, force and stiffness of every contact in its normal direction."""
        gap, k = self.problem.gaps(increment), self.problem.normal_stiffness
        x = np.clip(self.distance(increment), 1e-300, 1.0)
        log, rest = np.log(x), x - 1
        factor = self.scale * self.width
        held = gap <= self.stretch
        pull = np.minimum(gap, self.stretch)
        energy = np.where(
            self.spring, k * pull * (gap - pull / 2), -factor * self.width * rest**2 * log
        )
        force = np.where(self.spring, k * pull, -factor * (2 * rest * log + rest**2 / x))
        curve = self.scale * (-2 * log - 4 * rest / x + (rest / x) ** 2)
        return energy, force, np.where(self.spring, k * held, curve)

    def shear(self, increment: Floats, bound: Floats) -> tuple[Floats, Floats, Floats]:
        """Energy, force and stiffness of every contact along its tangent."""
        slip, k = self.problem.slips(increment), self.problem.shear_stiffness
        far = np.abs(slip)
        reach = np.where(self.spring, bound / k, self.width / 2)
        inside = far < reach
        y = np.minimum(far / np.where(self.spring, 1.0, reach), 1.0)
        beyond = np.where(inside, 0.0, far - np.where(self.spring, reach / 2, reach / 3))
        cap = np.where(inside | (bound == 0), 0.0, bound)
        ramp = np.where(self.spring, 0.0, bound)  # springs have no smooth ramp, nor a finite one
        smooth = ramp * self.width / 2 * (y**2 - y**3 / 3)
        spring_force, smooth_force = k * far, ramp * y * (2 - y)
        slope = ramp / (self.width / 2) * (2 - 2 * y)
        force = np.where(self.spring, spring_force, smooth_force)
        return (
            np.where(inside, np.where(self.spring, k * far**2 / 2, smooth), cap * beyond),
            np.sign(slip) * np.where(inside, force, cap),
            np.where(inside, np.where(self.spring, k, slope), 0.0),
        )

    def bound(self, normal: Floats) -> Floats:
        """Bound of the shear force that belongs to a normal force."""
        limits = self.problem.limits
        touches = (normal < 0) | (limits.tension > 0)
        return np.where(touches, limits.cohesion, 0.0) - limits.friction * np.minimum(normal, 0.0)

    def energy(self, increment: Floats, bound: Floats) -> float:
        """Potential of the step (J)."""
        problem = self.problem
        elastic = increment @ (problem.matrix @ increment) / 2 - problem.force @ increment
        parts = self.normal(increment)[0] + self.shear(increment, bound)[0]
        return float(elastic + parts.sum())


class _Descent:
    """Newton's method for the minimum, and the updates of the bound."""

    def __init__(self, options: Barrier, well: _Potential, linear: LinearSolver) -> None:
        self.options, self.well, self.linear = options, well, linear
        self.factorisations = 0
        self.weight = CutSprings.of(well.problem).weight

    def run(self, rough: Settled, memory: Memory) -> StepAnswer:
        well, problem = self.well, self.well.problem
        increment = np.zeros_like(problem.force)
        bound = well.bound(well.normal(increment)[1])
        residual, updates = np.inf, 0
        while updates < self.options.max_passes and np.isfinite(increment).all():
            updates += 1
            increment = self._minimum(increment, bound)
            normal, shear = self._forces(increment)
            residual = relative_residual(problem, self.weight, increment, normal, shear)
            hopeless = updates >= 3 and residual > 0.1
            if residual <= self.options.tolerance or hopeless:
                break
            share = 1.0 if updates <= PLAIN else 0.5
            bound = share * well.bound(normal) + (1 - share) * bound
        return self._answer(increment, residual, f"{updates} friction bounds", memory)

    def _minimum(self, increment: Floats, bound: Floats) -> Floats:
        well, problem = self.well, self.well.problem
        energy = well.energy(increment, bound)
        for _ in range(self.options.max_passes):
            _, normal, stiff_n = well.normal(increment)
            _, shear, stiff_t = well.shear(increment, bound)
            rest = problem.out_of_balance(increment, normal, shear)
            size = relative_residual(problem, self.weight, increment, normal, shear)
            if size <= 0.1 * self.options.tolerance:
                break
            matrix = well.pattern.matrix(problem, stiff_n, stiff_t)
            step = -self.linear.factorise(matrix).refined(rest)
            self.factorisations += 1
            length = longest = self._longest(increment, step)
            slope = float(rest @ step)
            found = well.energy(increment + length * step, bound)
            while found > energy + 1e-4 * length * slope and length > 1e-8 * longest:
                length /= 2
                found = well.energy(increment + length * step, bound)
            if not slope < 0 or length <= 1e-8 * longest:
                break
            increment, energy = increment + length * step, found
        return increment

    def _longest(self, increment: Floats, step: Floats) -> float:
        well = self.well
        now = well.problem.gaps(increment) + well.offset
        change = np.asarray(well.problem.normal_rows @ step)
        near: Bools = (change < 0) & ~well.spring
        if not near.any():
            return 1.0
        return min(1.0, NEAR * float((-now[near] / change[near]).min()))

    def _forces(self, increment: Floats) -> tuple[Floats, Floats]:
        """Forces under the bound of their own normal force."""
        normal = self.well.normal(increment)[1]
        return normal, self.well.shear(increment, self.well.bound(normal))[1]

    def _answer(
        self, increment: Floats, residual: float, updates: str, memory: Memory
    ) -> StepAnswer:
        well, problem = self.well, self.well.problem
        normal, shear = self._forces(increment)
        slip, bound = problem.slips(increment), well.bound(normal)
        reach = np.where(well.spring, bound / problem.shear_stiffness, well.width / 2)
        is_open = np.where(
            well.spring, problem.gaps(increment) > well.stretch, well.distance(increment) >= 1
        )
        loose = is_open & (problem.limits.tension <= 0)
        return StepAnswer(
            increment=increment,
            normal_force=normal,
            shear_force=shear,
            gap=problem.gaps(increment),
            slip=np.where(loose, 0.0, np.clip(slip, -reach, reach)),
            state=label(problem, is_open, np.abs(slip) > reach),
            passes=self.factorisations,
            residual=residual,
            verdict=self._verdict(increment, residual, updates, memory),
            factorisations=self.factorisations,
            solver=self.linear.name,
        )

    def _verdict(self, increment: Floats, residual: float, updates: str, memory: Memory) -> Verdict:
        how = f"{self.factorisations} Newton steps and {updates}"
        half = self.well.width / 2
        if residual <= self.options.tolerance:
            deep = f"; {self.well.deep} contacts began deeper than that" if self.well.deep else ""
            sentence = f"settled by {how}, gaps and slips within {half:.1e} m{deep}"
            return Verdict(True, "converged", sentence)
        springs = CutSprings.of(self.well.problem)
        found = Settled(springs, increment, residual, 0, 0, how)
        free = free_part(found, self.linear, memory)
        if free is not None:
            return free
        worst = worst_contacts(springs, increment)
        named = ", ".join(str(i) for i in worst[:5])
        sentence = (
            f"out of balance by {residual:.1e} after {how}, most at contacts {named}; "
            "shorten the step or widen the barrier"
        )
        return Verdict(False, "stalled", sentence, worst)
