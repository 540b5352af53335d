"""A step in time without contact points: one linear system, whose factor is kept."""

import numpy as np
from scipy.sparse import csc_array

from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.problem.step_problem import StepAnswer, Verdict
from nmm.contact.solution.record import ContactSolution
from nmm.contact.solution.request import StepRequest
from nmm.solvers.linear import Factor

SETTLED = Verdict(True, "converged", "no contact points")


class StepsWithoutContacts:
    """Solves steps without contact points.

    Attributes
    ----------
    factor
        Of the last system; None before the first.
    matrix
        Of the last system.
    """

    def __init__(self) -> None:
        self.factor: Factor | None = None
        self.matrix: csc_array | None = None

    def forget(self) -> None:
        """Drop the factor."""
        self.factor = self.matrix = None

    def solve(self, contacts: ContactPoints, request: StepRequest) -> ContactSolution:
        """Solve a step of no ``contacts``.

        Raises
        ------
        SolveError
            Where the load moves a part that has no mass.
        """
        factor, kept = self.factor, self.matrix is request.matrix
        if factor is None or not kept:
            # A factor may hold its matrix in another order of its entries.
            factor = self.factor = request.solver.factorise(request.matrix)
            self.matrix = request.matrix
        increment = factor.solve(request.force, request.among)
        residual = factor.relative_residual(increment, request.force, request.among)
        none, states = np.zeros(0), np.zeros(0, dtype=np.int64)
        told = 1, residual, SETTLED, int(not kept), request.solver.name
        answer = StepAnswer(increment, none, none, none, none, states, *told)
        return ContactSolution(contacts, answer, passes=1, loss=0.0)
