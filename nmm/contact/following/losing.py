"""How much energy bonds at their limit lose in a step, by unknown.

A spring that carries ``t`` at a jump ``(g, s)`` stores ``t_n g / 2`` while it is open and
``t_n^2 / (2 k_n)`` while it is pressed, and ``t_s^2 / (2 k_s)`` along its faces. Of the work that
``t`` does on a further jump it loses what it does not store. With the law's tangent ``D`` that is,
by jump,

    w = t - (t_n / 2, 0) - D' (g / 2, t_s / k_s)              while it is open,
    w = t - D' (t_n / k_n, t_s / k_s)                         while it is pressed:

the area between two secants where a bond unloads to its origin, and all the work of friction where
it slides. Bonds below their limit lose nothing. Those that the last correction took a little below
it are at it again as soon as the step begins.
"""

import numpy as np

from integration.arrays import Bools, Floats
from nmm.contact.following.path_problem import PathProblem
from nmm.interfaces.history import History

# Share of gaps and slips by which bonds that count are below their limit at most.
NEAR = 1e-2


def losing(problem: PathProblem, springs: tuple[Floats, Floats], history: History) -> Floats:
    """Return the energy (n,) by unknown (J) that bonds lose as they open and slide further.

    Parameters
    ----------
    problem
        Of steps from a state.
    springs, history
        Normal and shear stiffness of its contacts (N/m), and their history in that state.
    """
    gap, slip = problem.gap, problem.slip
    further = problem.law((1 + NEAR) * gap, (1 + NEAR) * slip)
    lose = history["bonded"] & _changed(history, further.history)
    (pull, shear), tangent = problem.law(gap, slip).force.T, further.tangent
    is_open = pull > 0
    stretch = np.stack([np.where(is_open, gap / 2, pull / springs[0]), shear / springs[1]], axis=1)
    stored = np.einsum("mij,mi->mj", tangent, stretch)
    by_gap = np.where(is_open, pull / 2, pull) - stored[:, 0]
    by_slip = shear - stored[:, 1]
    return np.asarray(problem.rows.push(np.where(lose, by_gap, 0.0), np.where(lose, by_slip, 0.0)))


def _changed(before: History, after: History) -> Bools:
    """Whether any column (m,) differs."""
    differ = [after[name] != column for name, column in before.items()]
    return np.asarray(np.logical_or.reduce(differ))
