"""Parts that pass everything on to built-in ones, under names of their own."""

from dataclasses import dataclass, field
from typing import ClassVar

from nmm.contact.enforcement.base import Enforcement
from nmm.contact.enforcement.cone import Cone
from nmm.contact.enforcement.penalty import Penalty
from nmm.integrators.base import Integrator
from nmm.integrators.newmark import Newmark
from nmm.solvers.libraries.superlu import SuperLU
from nmm.solvers.linear import LinearSolver


@dataclass(frozen=True)
class Exact(Enforcement):
    name: ClassVar[str] = "mine"
    multipliers: ClassVar[bool] = True

    def solve(self, problem, linear_solver, memory=None):
        return Cone().solve(problem, linear_solver, memory)


@dataclass(frozen=True)
class Springs(Enforcement):
    name: ClassVar[str] = "mine too"
    exact: ClassVar[bool] = False

    def solve(self, problem, linear_solver, memory=None):
        return Penalty().solve(problem, linear_solver, memory)


@dataclass(frozen=True)
class Rule(Integrator):
    inner: Newmark = field(default_factory=Newmark, init=False)

    def mass_factor(self, step):
        return self.inner.mass_factor(step)

    def momentum(self, velocity, acceleration, step):
        return self.inner.momentum(velocity, acceleration, step)

    def rates(self, increment, velocity, acceleration, step):
        return self.inner.rates(increment, velocity, acceleration, step)

    @property
    def end_weight(self):
        return self.inner.end_weight

    @property
    def contact_weight(self):
        return self.inner.contact_weight

    @property
    def contact_factor(self):
        return self.inner.contact_factor

    @property
    def contact_kick(self):
        return self.inner.contact_kick

    @property
    def carries(self):
        return self.inner.carries


@dataclass(frozen=True)
class Solver(LinearSolver):
    name: ClassVar[str] = "mine"
    inner: SuperLU = field(default_factory=SuperLU)

    def decompose(self, matrix):
        return self.inner.decompose(matrix)

    def indefinite(self):
        return self.by(self.inner.indefinite())

    def unsymmetric(self):
        return self.by(self.inner.unsymmetric())

    def by(self, inner):
        # A solver of dependent functions refines more often, whatever its settings.
        return Solver(max(self.refinements, inner.refinements), self.shift, inner)

    def scaling(self, matrix):
        return self.inner.scaling(matrix)
