"""Multifrontal Cholesky factorisation in compiled code, the order kept while the pattern stands."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.solvers import fronts
from nmm.solvers.blas import addresses, one_thread, words
from nmm.solvers.elimination import Fronts
from nmm.solvers.linear import Decomposition, LinearSolver, sorted_rows
from nmm.solvers.loan import Loan
from nmm.solvers.lu import FrontalLU
from nmm.solvers.plans import symmetric_plan
from nmm.solvers.superlu import SuperLU


@dataclass(frozen=True)
class Factorised:
    """Panels of a factor and the plan they belong to."""

    plan: Fronts
    panels: Loan

    def solve(self, rhs: Floats) -> Floats:
        """Return the solution of one right-hand side (n,) or of several (n, k)."""
        if rhs.ndim == 2:
            return np.stack([self.solve(column) for column in rhs.T], axis=1)
        p, x = self.plan, np.empty(len(rhs))
        one = np.ascontiguousarray(rhs, dtype=np.float64)
        outside = addresses(*fronts.KERNELS), *words()
        with one_thread():
            fronts.solve(*outside, one, p.order, *p.shape, self.panels.numbers, x)
        return x


@dataclass(frozen=True)
class Cholesky(LinearSolver):
    """``A = L L^T`` by dense fronts (Duff, Reid 1983; LAPACK within a front).

    A matrix that is not positive definite is left to `FrontalLU`, one that is not symmetric to
    rounding to SuperLU. On walls of bricks a factorisation takes a fifth of SuperLU's time once
    the pattern is known (benchmark `benchmarks/enforcement.py`).
    """

    name: ClassVar[str] = "cholesky"

    def decompose(self, matrix: csc_array) -> Decomposition:
        """Factorise a scaled matrix; `RankDeficientError` at a zero pivot."""
        matrix = sorted_rows(matrix)
        plan = symmetric_plan(matrix)
        if plan is None:
            return SuperLU(self.refinements, self.shift).decompose(matrix)
        panels, stack = Loan(plan.panel_start[-1]), Loan(plan.stack_size)
        with one_thread():
            bad = fronts.factorise(
                addresses(*fronts.KERNELS),
                *words(),
                matrix.data,
                plan.source,
                plan.target,
                plan.n_children,
                *plan.shape,
                panels.numbers,
                stack.numbers,
            )
        if bad >= 0:
            return self.unsymmetric().decompose(matrix)
        return Factorised(plan, panels)

    def indefinite(self) -> SuperLU:
        """SuperLU, which searches pivots."""
        return SuperLU(self.refinements, self.shift).indefinite()

    def unsymmetric(self) -> FrontalLU:
        """LU on the same fronts, refined twice."""
        return FrontalLU(max(self.refinements, 2), self.shift)
