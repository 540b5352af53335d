"""The linear system of a step without contact, with constraints where supports have them."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_array, csr_array

from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.assembly.moving.motion import strain_only
from nmm.assembly.state import State
from nmm.model.discretisation import ModelWithEffects
from nmm.solvers.accuracy.rounding_error import rounding_changes
from nmm.solvers.linear import Factor, LinearSolver
from nmm.solvers.rigid_apart import ROUNDED, Bodies, RigidSplit, rounding, solve_apart
from nmm.solvers.saddle import bordered
from nmm.stepping.step.linear.equations import Equations


@dataclass(frozen=True)
class LinearSolution:
    """Solution of a linear system.

    Attributes
    ----------
    increment
        (n,) unknowns.
    rounded
        Residual of these, as a share of the load.
    apart
        The solution with rigid motions apart, where these lose less by rounding; else None.
    """

    increment: Floats
    rounded: float
    apart: RigidSplit | None = None

    @property
    def residual(self) -> float:
        """Residual of the better of the two, as a share of the load."""
        return self.rounded if self.apart is None else self.apart.residual

    def moved(self, model: Model, state: State) -> State:
        """Return the state after the step in small displacements."""
        if self.apart is None:
            return strain_only(model, state, self.increment)
        return strain_only(model, state, self.apart.strain, self.apart.rigid)


class LinearSystem:
    """Solves the equations of steps.

    Parameters
    ----------
    small
        Whether displacements are small: rigid motions may then be kept apart from the strain.

    Attributes
    ----------
    factor
        Of the last system; it stands as long as the matrix has the same entries.
    """

    def __init__(self, solved: ModelWithEffects, solver: LinearSolver, small: bool) -> None:
        self._solved, self.solver, self._small = solved, solver, small
        self.factor: Factor | None = None
        self._last: tuple[Floats, Floats] | None = None

    def forget(self) -> None:
        """Drop the factor and what it solved last."""
        self.factor = self._last = None

    def rounding_changes(self) -> list[Floats]:
        """Changes (n,) that rounding may have made of the last step's unknowns in statics.

        Empty where rigid motions were solved apart, which keeps the digits of the rest.
        """
        if self.factor is None or self._last is None:
            return []
        n = self._solved.model.manifold.n_unknowns
        return [change[:n] for change in rounding_changes(self.factor, *self._last)]

    def adrift(self) -> bool:
        """Whether the unknown that moved most in the last static step is out of balance itself.

        Beside far larger loads on others that is no residual to speak of.
        """
        if self.factor is None or self._last is None:
            return False
        (increment, force), matrix = self._last, self.factor.matrix
        most = self.factor.weakest_unknown(increment)
        rest = abs(force[most] - (matrix @ increment)[most])
        sizes = csc_array((np.abs(matrix.data), matrix.indices, matrix.indptr), matrix.shape)
        rounded = ROUNDED * (sizes @ np.abs(increment))[most]
        return bool(rest > max(abs(force[most]) / 2, rounded) and force[most])

    def solve(self, equations: Equations) -> LinearSolution:
        """Solve a step; supports keep their multipliers.

        Raises
        ------
        SolveError
            Where the load moves a part that nothing holds.
        """
        plan, matrix, force = self._solved.plan, equations.matrix, equations.force
        border = plan.border(equations.state, equations.end)
        n, solver = len(force), self.solver
        if border is not None:
            matrix = bordered(matrix, border[0])
            force, solver = np.concatenate([force, border[1]]), solver.indefinite()
        if not equations.symmetric:
            solver = self.solver.unsymmetric()
        if self.factor is None or not _same(self.factor.matrix, matrix):
            self.factor = solver.factorise(matrix)
        among = equations.among
        if among is not None:
            among = np.pad(among, (0, len(force) - len(among)))
        increment = self.factor.solve(force, among)
        residual, apart = self.factor.relative_residual(increment, force, among), None
        if equations.step is None:
            apart = self._apart(equations, self.factor, increment, force, border)
            apart = apart if apart is not None and apart.residual < residual else None
        self._last = (increment, force) if equations.step is None and apart is None else None
        if border is not None:
            plan.keep(increment[n:] if apart is None else apart.multipliers)
        return LinearSolution(increment[:n], residual, apart)

    def _apart(
        self,
        equations: Equations,
        factor: Factor,
        increment: Floats,
        force: Floats,
        border: tuple[csr_array, Floats] | None,
    ) -> RigidSplit | None:
        """Solution with rigid motions apart where rounding would spoil the stress; else None."""
        model, bent = self._solved.model, bool(self._solved.plan.bent)
        bent |= model.matter is not None
        if not self._small or model.manifold.n_bodies == 1 or bent:
            return None
        bodies = rigid_bodies(model)
        if rounding(factor, bodies, increment, force) <= ROUNDED:
            return None
        held = self._solved.plan.matrix(equations.state, csc_array(model.stiffness.shape))
        return solve_apart(factor, bodies, held, force, None if border is None else border[0])


def rigid_bodies(model: Model) -> Bodies:
    """Return the rigid motions of a model's bodies."""
    manifold = model.manifold
    measure = model.measure if manifold.dependent else None
    return Bodies(model.stiffness, manifold.rigid_modes, model.rigid_projection, measure)


def _same(a: csc_array, b: csc_array) -> bool:
    return a is b or (
        a.nnz == b.nnz and np.array_equal(a.data, b.data) and np.array_equal(a.indices, b.indices)
    )
