"""What rounding leaves of the balance of stiff springs: no solution can be better."""

import numpy as np

from integration.arrays import Floats
from nmm.contact.problem.balance import length
from nmm.contact.problem.cut_springs import CutSprings
from nmm.contact.problem.row_products import pushed, terms_of_stretches
from nmm.solvers.unchecked import magnitudes

# Sums of some ten products each are rounded some ten times.
ROUNDINGS = 16.0
# A balance that rounding leaves worse than this is none: the springs are too stiff to be told apart
# from what they join.
WORST = 1e-3


def rounding(springs: CutSprings, increment: Floats) -> float:
    """Relative out-of-balance force by rounding of the springs' own stretches; at most `WORST`.

    A gap ``g + N d`` is known to the last digit of its largest term, whatever it comes to. Times
    a stiffness 1e10 times that of what moves, that digit is a millionth of the load.
    """
    problem, grain = springs.problem, ROUNDINGS * float(np.finfo(float).eps)
    rows, starts = (problem.normal_rows, problem.tangent_rows), (problem.gap, problem.slip)
    forces = np.stack(springs.forces(increment))
    sizes = np.abs(starts) + terms_of_stretches(*rows, increment)
    lost = np.where(forces != 0, grain * springs.stiffness * sizes, 0.0)
    left = sum(magnitudes(part).T @ one for part, one in zip(rows, lost, strict=True))
    held = pushed(*rows, *forces)
    inner = problem.matrix @ increment
    whole = max(length(springs.weight * part) for part in (inner, held, problem.force))
    whole = max(whole, problem.least(springs.weight))
    return min(length(springs.weight * left) / whole, WORST) if whole > 0 else 0.0
