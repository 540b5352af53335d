"""A step in which nothing touches: one linear system, with conditions if supports make them."""

from dataclasses import replace

import numpy as np
from scipy.sparse import csc_array, csr_array

from integration.arrays import Floats
from nmm.assembly.motion import strain_only
from nmm.errors import SolveError
from nmm.model.discretisation import Current
from nmm.solvers.bordered import bordered
from nmm.solvers.linear import Factor, LinearSolver
from nmm.solvers.rigid_apart import ROUNDED, Apart, rounding, solve_apart
from nmm.stepping.step.clock import Clock
from nmm.stepping.step.equations import Equations
from nmm.stepping.step.mover import Mover
from nmm.stepping.step.rigid_bodies import rigid_bodies
from nmm.stepping.step.trial import Attempt

TRUSTED = 1e-4
"""Largest residual of a linear step, as a share of its load: beyond it no digit that matters is
known of soft motions. The summary has the residual, and warns of it from 1e-6 on."""


class Alone:
    """Solves steps without contact.

    Parameters
    ----------
    small
        Whether displacements are small: rigid motions may then be kept apart from the strain.

    Attributes
    ----------
    factor
        Of the last system; it stands as long as the matrix has the same entries.
    """

    def __init__(
        self, current: Current, mover: Mover, solver: LinearSolver, small: bool, clock: Clock
    ) -> None:
        self._current, self._mover, self.solver = current, mover, solver
        self._small, self._clock = small, clock
        self.factor: Factor | None = None

    def forget(self) -> None:
        """Drop the factor."""
        self.factor = None

    def attempt(self, equations: Equations) -> Attempt:
        """Solve a step.

        Raises
        ------
        SolveError
            Where the load moves a part that nothing holds, or rounding leaves a residual above
            `TRUSTED`.
        """
        with self._clock.phase("solve"):
            increment, residual, apart = self._solve(equations)
        left = residual if apart is None else apart.residual
        if not left <= TRUSTED:
            raise SolveError(
                f"linear system of {len(increment)} unknowns: rounding leaves a residual of "
                f"{left:.1e} of the load: expected at most {TRUSTED:.0e}: stiffnesses differ by "
                "more than numbers can hold; look for springs or bodies far stiffer than others, "
                "slivers, and parts that hardly hang together"
            )
        result = self._mover.after(equations, increment)
        if apart is None:
            return replace(result, residual=residual)
        end = equations.end
        moved = strain_only(self._current.model, equations.state, apart.strain, apart.rigid)
        moved = replace(moved, time=end.time, load_factor=end.load_factor)
        return replace(result, state=moved, residual=apart.residual)

    def _solve(self, equations: Equations) -> tuple[Floats, float, Apart | None]:
        """Return the increment (n,), its residual and, where that is better, rigid parts apart."""
        plan, matrix, force = self._current.plan, equations.matrix, equations.force
        border = plan.border(equations.state, equations.end)
        n, solver = len(force), self.solver
        if border is not None:
            matrix = bordered(matrix, border[0])
            force, solver = np.concatenate([force, border[1]]), solver.indefinite()
        if not equations.symmetric:
            solver = self.solver.unsymmetric()
        if self.factor is None or not _same(self.factor.matrix, matrix):
            self.factor = solver.factorise(matrix)
        factor = self.factor
        increment = factor.solve(force)
        residual = factor.relative_residual(increment, force)
        apart = None
        if equations.step is None:
            apart = self._apart(equations, factor, increment, force, border, residual)
        if border is not None:
            plan.keep(increment[n:] if apart is None else apart.multipliers)
        return increment[:n], residual, apart

    def _apart(
        self,
        equations: Equations,
        factor: Factor,
        increment: Floats,
        force: Floats,
        border: tuple[csr_array, Floats] | None,
        residual: float,
    ) -> Apart | None:
        """Solution with rigid motions apart where rounding would spoil the stress; else None."""
        model = self._current.model
        if not self._small or model.manifold.n_bodies == 1 or model.matter is not None:
            return None
        bodies = rigid_bodies(model)
        if rounding(factor, bodies, increment, force) <= ROUNDED:
            return None
        held = self._current.plan.matrix(equations.state, csc_array(model.stiffness.shape))
        rows = None if border is None else border[0]
        found = solve_apart(factor, bodies, held, force, rows)
        return found if found.residual < residual else None


def _same(a: csc_array, b: csc_array) -> bool:
    return a is b or (
        a.nnz == b.nnz and np.array_equal(a.data, b.data) and np.array_equal(a.indices, b.indices)
    )
