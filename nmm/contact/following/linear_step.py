"""The linear system of an iteration along a path, also where the tangent alone is singular.

On a plateau, as of a block that slides at its limit of friction, no load holds what moves, and yet
the step is determined: what is controlled says how far. With ``r d = t`` on the step the tangent
``K`` may be replaced by ``K + s r r'`` and the load by what keeps the solution, for any ``s``
(augmented tangent; Felippa 1987). It is used only there, as it couples all unknowns of the row.
"""

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.contact.following.path_problem import PathStep
from nmm.controls.path_equation import PathEquation
from nmm.errors import SolveError
from nmm.solvers.linear import LinearSolver

# Unknowns of a row up to which it is coupled: points of a control have tens.
COUPLED = 200
# Forces by the diagonal of the tangent on what a load moves, over the load, beyond which rounding
# alone holds it: a spring of 1e-6 of the stiffness of a contact makes 1e6 of it.
LOOSE = 1e10


def linear_step(
    solver: LinearSolver, tangent: csc_array, path: PathEquation, step: PathStep
) -> tuple[Floats, Floats]:
    """Return by how much unknowns (n,) change with the load of an iterate, and by one more of it.

    The first is exact only together with the change of the load that the path equation asks for.

    Raises
    ------
    SolveError
        Where nothing holds a part, not even the control.
    """
    diagonal = np.abs(tangent.diagonal())
    able = 0 < np.count_nonzero(path.row) <= COUPLED
    try:
        found = _solved(solver, tangent, path.load, step.rest)
        if not able or (diagonal * np.abs(found[1])).max() <= LOOSE * np.abs(path.load).max():
            return found
    except SolveError:
        if not able:
            raise
    row = csc_array(path.row[:, None])
    spring = float(diagonal.max()) / float(path.row @ path.row)
    held = csc_array(tangent + spring * (row @ row.T))
    load = path.load - spring * path.share * path.row
    rest = step.rest + spring * path.left(step.increment, step.change) * path.row
    return _solved(solver, held, load, rest)


def _solved(
    solver: LinearSolver, matrix: csc_array, load: Floats, rest: Floats
) -> tuple[Floats, Floats]:
    factor = solver.unsymmetric().factorise(matrix)
    along = factor.solve(load)
    # What is left is rounding in the end, which dependent functions cannot follow: the balance of
    # the iterate judges it.
    return factor.refined(rest), along
