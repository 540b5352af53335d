"""A factorised matrix: what is common to all decompositions.

The matrix is scaled before it is decomposed, solutions are refined with the matrix itself, and
judged by their residual; a matrix without inverse is decomposed again with a shift.
"""

from contextlib import suppress
from dataclasses import dataclass, field
from typing import Protocol, Self

import numpy as np

from integration.arrays import Floats
from integration.sparse import csc_array
from nmm.errors import SolveError
from nmm.solvers.accuracy.known import known_load
from nmm.solvers.accuracy.krylov import minimal_residual
from nmm.solvers.draws import same_draws
from nmm.solvers.norm import norm
from nmm.solvers.scaling import scaled
from nmm.solvers.unchecked import product

ACCEPTED = 1e-8
"""Largest relative residual of a solution; above it a shifted matrix is tried."""
TOLD = 1e-6
"""The same of a shifted matrix; above it the load works on a free motion. Slivers among dependent
functions leave up to 1e-7, which audits tell."""
PIVOT = 1e-15
"""Part of the diagonal added to every matrix: what rounding changes anyway. It keeps a pivot of a
rank-deficient matrix from being exactly zero, over which decompositions trip."""
SETTLED = 4 * PIVOT
"""Largest residual for each unit of the solution that is that of `PIVOT`."""
FLOOR = 1e-14
"""Residual that rounding leaves for each unit of the solution."""
SLOW = 1e-10
"""Residual above which refinement of a shifted matrix is given help."""
GROWTH = 1e13
"""Growth of a scaled solution over its load that only a rank-deficient matrix shows."""


class RankDeficientError(Exception):
    """A decomposition met a pivot that is exactly zero."""


class Decomposition(Protocol):
    """Triangular factors of a matrix with unit diagonal."""

    def solve(self, rhs: Floats) -> Floats:
        """Return the solution of one right-hand side."""


class Decomposer(Protocol):
    """What is asked of a solver, see `nmm.solvers.linear.LinearSolver`."""

    @property
    def refinements(self) -> int:
        """Most steps of refinement after a solution."""

    @property
    def shift(self) -> float:
        """Part of the diagonal added before the decomposition."""

    def decompose(self, matrix: csc_array) -> Decomposition:
        """Factorise a scaled matrix; raise `RankDeficientError` at a zero pivot."""

    def scaling(self, matrix: csc_array) -> Floats:
        """(n,) factors that bring the matrix to entries of about one."""

    def deflated(self) -> Self:
        """Return the solver with the shift for rank-deficient matrices."""


@dataclass
class Factor:
    """A factorised matrix.

    ``matrix = diag(1/scale) S diag(1/scale)``, and ``S`` (unit diagonal) is what was decomposed.

    Attributes
    ----------
    solver
        The solver that made it.
    matrix
        (n, n) as given.
    scale
        (n,) symmetric Jacobi scaling.
    deflated
        True when the matrix was found rank-deficient and is solved with a shift; solutions are
        then one of many, the one of least size, for loads that do no work on free motions.
    """

    solver: Decomposer
    matrix: csc_array
    scale: Floats
    decomposition: Decomposition
    deflated: bool = False
    _fallback: "Factor | None" = field(default=None, repr=False)

    @classmethod
    def of(cls, solver: Decomposer, matrix: csc_array) -> "Factor":
        """Scale and factorise; a zero pivot leads to the shifted matrix.

        Raises
        ------
        SolveError
            When an entry is not finite, or the shifted matrix has a zero pivot too.
        """
        if not np.isfinite(matrix.data).all():
            raise SolveError(
                "linear system: the matrix holds numbers that are not finite: expected finite "
                "stiffnesses and masses: check materials and the size of the step"
            )
        scale = solver.scaling(matrix)
        unit = scaled(matrix, scale, max(solver.shift, PIVOT))
        with suppress(RankDeficientError):
            return cls(solver, matrix, scale, solver.decompose(unit))
        try:
            return cls._shifted(solver, matrix, scale)
        except RankDeficientError as fault:
            raise SolveError(
                f"linear system of {len(scale)} unknowns: {fault}, though shifted by "
                f"{solver.deflated().shift:.0e}: expected a supported system: add supports, "
                "contacts or inertia",
                singular=True,
            ) from fault

    def solve(self, rhs: Floats, among: Floats | None = None) -> Floats:
        """Solve ``matrix @ x = rhs`` with refinement.

        ``among`` (n,) is the size of the forces that the load is the sum of, where these cancel:
        see `relative_residual`.

        Raises
        ------
        SolveError
            When no solution exists: the matrix is singular and the load moves a free part.
        """
        x, residual, growth = self._refined(rhs)
        residual *= self._known(rhs, among)
        if residual <= _limit(growth) and growth < GROWTH:
            return x
        if not self.deflated:
            if self._fallback is None:
                self._fallback = self._shifted(self.solver, self.matrix, self.scale)
            return self._fallback.solve(rhs, among)
        if residual <= max(_limit(growth), TOLD):
            return x
        at = self.weakest_unknown(x)
        raise SolveError(
            f"linear system of {len(rhs)} unknowns: residual {residual:.1e} of the load, largest "
            f"at unknown {at}: expected a supported system: the matrix is singular and the load "
            "moves a free part; add supports, contacts or inertia",
            singular=True,
        )

    def apply(self, rhs: Floats) -> Floats:
        """Return one application of the factors without refinement, for preconditioning."""
        return np.asarray(self.scale * self.decomposition.solve(self.scale * rhs))

    def rough(self, rhs: Floats) -> Floats:
        """Return `apply` in the precision that costs least: for steps that later ones mend."""
        solve = getattr(self.decomposition, "rough", self.decomposition.solve)
        return np.asarray(self.scale * solve(self.scale * rhs))

    def refined(self, rhs: Floats, tolerance: float = 0.0) -> Floats:
        """Return a solution with refinement that is not judged: for steps of an iteration.

        Refinement ends at a residual of ``tolerance`` of the load, or where rounding ends it.
        """
        return self._refined(rhs, tolerance)[0]

    def relative_residual(self, x: Floats, rhs: Floats, among: Floats | None = None) -> float:
        """``|rhs - matrix @ x| / |rhs|`` in scaled quantities.

        A load that is left of forces ``among`` (n,) counts as no less than `known_load` of these.
        """
        size = norm(self.scale * rhs)
        rest = norm(self.scale * (rhs - self.matrix @ x))
        return rest / size * self._known(rhs, among) if size > 0 else rest

    def _known(self, rhs: Floats, among: Floats | None) -> float:
        """Return what a load is of the least that is known among the forces it is the sum of."""
        if among is None:
            return 1.0
        least = known_load(self.scale * among)
        size = norm(self.scale * rhs)
        return 1.0 if size >= least else size / least

    def weakest_unknown(self, x: Floats) -> int:
        """Unknown that moves most in ``x``, scaled: in a free motion if the matrix is singular."""
        return int(np.argmax(np.abs(x / self.scale)))

    def condition(self) -> float:
        """Estimate of the 1-norm condition number of the scaled matrix (Higham, Tisseur 2000)."""
        from scipy.sparse.linalg import LinearOperator, onenormest

        unit = scaled(self.matrix, self.scale, 0.0)
        solve = self.decomposition.solve
        inverse = LinearOperator(unit.shape, matvec=solve, rmatvec=solve, dtype=np.float64)
        with same_draws():
            largest = onenormest(inverse)
        return float(abs(unit).sum(axis=0).max() * largest)

    def _refined(self, rhs: Floats, tolerance: float = 0.0) -> tuple[Floats, float, float]:
        load = self.scale * rhs
        size = norm(load)
        if size == 0.0:
            return np.zeros_like(load), 0.0, 0.0
        x = self.apply(rhs)
        best, rest = x, np.inf
        for turn in range(self.solver.refinements + 1):
            residual = rhs - product(self.matrix, x)
            found = norm(self.scale * residual) / size
            if not found < rest:
                break
            # Rounding has the last word where a turn does not halve what is left; a shift is slow.
            stays = found > 0.5 * rest and not self.solver.shift
            best, rest = x, found
            if stays or rest < max(1e-15, tolerance) or turn == self.solver.refinements:
                break
            x = x + self.apply(residual)
            if self._settled(rest, best, size):
                best = x
                break
        if self.solver.shift and rest > max(SLOW, tolerance):
            # Directions about as soft as the shift: refinement would take hundreds of turns.
            tried, left = self._minimised(load, size, tolerance)
            if left < rest:
                best, rest = tried, left
        growth = float(np.abs(best / self.scale).max() / np.abs(load).max())
        return best, rest, growth

    def _settled(self, rest: float, x: Floats, size: float) -> bool:
        """Whether one correction takes a residual to rounding, so that it need not be judged.

        The first residual is ``PIVOT |x|``. A correction leaves at most the part ``PIVOT k`` of
        it at a condition of ``k``, which is less than rounding unless the solution outgrows its
        load: that shows in the residual, too.
        """
        if self.solver.shift or rest > ACCEPTED:
            return False
        return rest * size <= SETTLED * norm(x / self.scale)

    def _minimised(self, load: Floats, size: float, tolerance: float) -> tuple[Floats, float]:
        """Solution with the shift taken out by minimal residuals, and its residual."""

        def product(x: Floats) -> Floats:
            return np.asarray(self.scale * (self.matrix @ (self.scale * x)))

        inverse, goal = self.decomposition.solve, max(1e-14, tolerance)
        x = minimal_residual(product, inverse, load, tolerance=goal)
        rest = norm(load - product(x)) / size
        return self.scale * x, rest

    @classmethod
    def _shifted(cls, solver: Decomposer, matrix: csc_array, scale: Floats) -> "Factor":
        shifted = solver.deflated()
        parts = shifted.decompose(scaled(matrix, scale, shifted.shift))
        return cls(shifted, matrix, scale, parts, deflated=True)


def _limit(growth: float) -> float:
    """Residual to accept: where the solution outgrows its load, rounding of it sets the floor."""
    return max(ACCEPTED, FLOOR * growth)
