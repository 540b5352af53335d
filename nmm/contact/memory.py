"""What the contact solution keeps from step to step."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.contact.pattern import SpringPattern
from nmm.contact.problem import StepProblem
from nmm.contact.springs import CutSprings
from nmm.solvers.linear import Factor, LinearSolver

DRIFT = 1.25
"""A kept factor serves while no diagonal entry of the matrix has changed by more than this."""
TURN = 1e-3
"""A kept factor is as good as new while the rows have changed by less than this part."""


@dataclass
class KeptFactor:
    """Factor of the matrix with all springs acting, and what it was made of."""

    factor: Factor
    solver: LinearSolver
    springs: CutSprings
    diagonal: Floats
    solves_when_new: int = 0
    stalled: bool = False

    def serves(self, springs: CutSprings, solver: LinearSolver) -> bool:
        """Whether it is near enough to the matrix of ``springs``."""
        same = (
            solver == self.solver
            and np.array_equal(self.springs.normal_stiffness, springs.normal_stiffness)
            and np.array_equal(self.springs.shear_stiffness, springs.shear_stiffness)
        )
        if not same:
            return False
        now = springs.problem.matrix.diagonal()
        floor = 1e-12 * float(np.abs(now).max(initial=0.0))
        return bool(np.all(now <= DRIFT * self.diagonal + floor)) and bool(
            np.all(self.diagonal <= DRIFT * now + floor)
        )

    def as_new(self, problem: StepProblem) -> bool:
        """Whether a new factor would hardly differ."""
        old = self.springs.problem
        pairs = (
            (old.matrix.data, problem.matrix.data),
            (old.normal_rows.data, problem.normal_rows.data),
            (old.tangent_rows.data, problem.tangent_rows.data),
        )
        return all(
            a is b or bool(np.linalg.norm(a - b) <= TURN * np.linalg.norm(b)) for a, b in pairs
        )


@dataclass
class Memory:
    """Pattern and factor of the last step; owned by the step loop, filled by enforcements.

    One memory belongs to one run. Its contents are used only where the problem handed in still
    has the same unknowns at its contacts, and are replaced otherwise.
    """

    pattern: SpringPattern | None = None
    kept: KeptFactor | None = None

    def pattern_of(self, problem: StepProblem) -> SpringPattern:
        """Pattern of ``problem``, laid out anew when it changed."""
        if self.pattern is None or not self.pattern.fits(problem):
            self.pattern, self.kept = SpringPattern.of(problem), None
        return self.pattern

    def factor_of(self, springs: CutSprings, solver: LinearSolver) -> tuple[KeptFactor, bool]:
        """Factor with all springs acting, and whether it was made just now."""
        pattern = self.pattern_of(springs.problem)
        if self.kept is not None and self.kept.serves(springs, solver):
            return self.kept, False
        normal, shear = springs.normal_stiffness, springs.shear_stiffness
        factor = solver.factorise(pattern.matrix(springs.problem, normal, shear))
        diagonal = springs.problem.matrix.diagonal()
        self.kept = KeptFactor(factor, solver, springs, diagonal)
        return self.kept, True

    def forget_factor(self) -> None:
        """Drop the factor: it no longer serves."""
        self.kept = None
