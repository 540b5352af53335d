"""What rounding leaves of the balance of stiff springs: no solution can be better."""

import numpy as np

from integration.arrays import Floats
from nmm.contact.problem.balance import length
from nmm.contact.problem.cut_springs import CutSprings

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
    moved = np.abs(increment)
    parts = (
        (problem.normal_rows, problem.gap, springs.stiffness[0]),
        (problem.tangent_rows, problem.slip, springs.stiffness[1]),
    )
    normal, shear = springs.forces(increment)
    left = np.zeros_like(increment)
    held = np.zeros_like(increment)
    for (rows, start, stiffness), force in zip(parts, (normal, shear), strict=True):
        size = abs(rows)
        acts = force != 0
        left += size.T @ np.where(acts, grain * stiffness * (np.abs(start) + size @ moved), 0.0)
        held += rows.T @ force
    inner = problem.matrix @ increment
    whole = max(length(springs.weight * part) for part in (inner, held, problem.force))
    whole = max(whole, problem.least(springs.weight))
    return min(length(springs.weight * left) / whole, WORST) if whole > 0 else 0.0
