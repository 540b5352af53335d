"""Multifrontal Cholesky factorisation in compiled code, the order kept while the pattern stands."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.solvers import fronts
from nmm.solvers.blas import addresses, one_thread
from nmm.solvers.elimination import Fronts, skew
from nmm.solvers.linear import Decomposition, LinearSolver
from nmm.solvers.superlu import SuperLU

_PLANS: list[Fronts] = []
_KEPT = 4
SKEW = 1e-12
"""Part of the largest entry by which a symmetric matrix and its mirror image may differ."""


@dataclass(frozen=True)
class Factorised:
    """Panels of a factor and the plan they belong to."""

    plan: Fronts
    panels: Floats

    def solve(self, rhs: Floats) -> Floats:
        """Return the solution of one right-hand side (n,) or of several (n, k)."""
        if rhs.ndim == 2:
            return np.stack([self.solve(column) for column in rhs.T], axis=1)
        p = self.plan
        one = np.ascontiguousarray(rhs, dtype=np.float64)
        x = fronts.solve(one, p.order, self.panels, p.first, p.row_start, p.rows, p.panel_start)
        return np.asarray(x)


@dataclass(frozen=True)
class Cholesky(LinearSolver):
    """``A = L L^T`` by dense fronts (Duff, Reid 1983; LAPACK within a front).

    A matrix that is not positive definite, or not symmetric to rounding, goes to SuperLU. On
    walls of bricks a factorisation takes a quarter of SuperLU's time once the pattern is known
    (benchmark `benchmarks/enforcement.py`).
    """

    name: ClassVar[str] = "cholesky"

    def decompose(self, matrix: csc_array) -> Decomposition:
        """Factorise a scaled matrix; `RankDeficientError` at a zero pivot."""
        if not matrix.has_sorted_indices:
            matrix = matrix.sorted_indices()
        plan = _plan(matrix)
        if plan is None:
            return SuperLU(self.refinements, self.shift).decompose(matrix)
        with one_thread():
            panels, bad = fronts.factorise(
                addresses(),
                matrix.data,
                plan.source,
                plan.target,
                plan.first,
                plan.row_start,
                plan.rows,
                plan.panel_start,
                plan.n_children,
                np.empty(plan.stack_size),
                np.frombuffer(b"LNRT", dtype=np.uint8),
                np.zeros(4, dtype=np.int32),
                np.array([1.0, -1.0]),
            )
        if bad >= 0:
            return self.indefinite().decompose(matrix)
        return Factorised(plan, panels)

    def indefinite(self) -> SuperLU:
        """SuperLU, which searches pivots."""
        return SuperLU(self.refinements, self.shift).indefinite()

    def unsymmetric(self) -> SuperLU:
        """SuperLU, which searches pivots."""
        return SuperLU(self.refinements, self.shift).unsymmetric()


def _plan(matrix: csc_array) -> Fronts | None:
    """Plan of the pattern, kept from the last few; None where the matrix is not symmetric."""
    plan = next((one for one in _PLANS if one.fits(matrix)), None)
    if plan is not None and plan.mirrored:
        return plan
    off, mirrored = skew(matrix.indptr, matrix.indices, matrix.data)
    if off > SKEW * np.abs(matrix.data).max(initial=0.0):
        return None
    if plan is None:
        plan = Fronts.of(matrix, mirrored)
        _PLANS.insert(0, plan)
        del _PLANS[_KEPT:]
    return plan
