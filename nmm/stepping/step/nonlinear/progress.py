"""Whether iterations have found a solution, come nearer to one, or never will."""

import numpy as np

from nmm.stepping.step.nonlinear.iterate import size
from nmm.stepping.step.trial import Attempt

# Out-of-balance force of matter, as a share of the forces, that is taken for a solution where it
# falls no more for rounding.
ROUNDED = 1e-7
# Share of the contact forces that their linearisation may miss where the rest is rounding: as large
# a share of their work is stored nowhere.
MISSED_BY_CONTACT = 1e-6
# What rounding leaves of a linear solution moves forces by about so many times as much.
LEFT = 10.0
# Iterations of a step; plasticity takes four to eight.
MOST = 30
# Iterations go to and fro where so many of them leave more than this share of the least before.
FRUITLESS, FRUIT = 8, 0.7
# Below this imbalance the tangent of effects is kept, with the matrix and its factors: what it
# misses falls by as much again. Where it falls less than by this factor a new one is made.
NEARLY, FALLS = 1e-3, 0.1


def balanced(found: Attempt, tolerance: float) -> bool:
    """Whether forces balance, or as far as rounding lets them: that of the solutions too.

    Rounding is what falls no more; what contact still misses of its forces takes many iterations to
    be taken for that.
    """
    imbalances, patience = found.imbalances, 1 if _settled(found) else FRUITLESS
    last = imbalances[-1]
    if last <= tolerance:
        return True
    stalls = len(imbalances) > patience and last > 0.5 * imbalances[-1 - patience]
    return stalls and last <= max(ROUNDED, LEFT * found.residual)


def _settled(found: Attempt) -> bool:
    """Whether contact forces are those of the gaps that were found."""
    if found.missed is None or found.solved is None:
        return True
    return size(found.missed) <= MISSED_BY_CONTACT * size(found.solved.push)


def hopeless(imbalances: list[float]) -> bool:
    """Whether the iterations are used up, or the last ones made no progress."""
    last, before = imbalances[-FRUITLESS:], imbalances[:-FRUITLESS]
    fruitless = bool(before) and min(last) > FRUIT * min(before)
    return fruitless or len(imbalances) == MOST or not np.isfinite(imbalances[-1])


def falls(imbalances: list[float]) -> bool:
    """Whether the residual is small, and falls with the last tangent."""
    last, before = imbalances[-1], imbalances[-2] if len(imbalances) > 1 else np.inf
    return last <= NEARLY and last <= FALLS * before
