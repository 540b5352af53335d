"""Rounding error of a solution, estimated by a further solve."""

import numpy as np

from integration.arrays import Floats
from nmm.solvers.factor import Factor
from nmm.solvers.unchecked import magnitudes

SAMPLES = 2
"""Signs of roundings that are drawn; the worst counts."""
DIGITS = 0.1
"""Residual to which a change is solved, of which only the size is needed."""


def rounding_changes(factor: Factor, solution: Floats, load: Floats) -> list[Floats]:
    """Changes (n,) of a solution by roundings of ``matrix @ solution`` and of the load.

    Each entry of the residual is known to ``eps (|A| |x| + |b|)`` at best (Higham 2002, *Accuracy
    and Stability of Numerical Algorithms*, section 7.1). What such residuals move is what a
    solution is off by, within a factor of some ten; a condition number bounds the worst load.
    """
    eps = float(np.finfo(float).eps)
    size = eps * (magnitudes(factor.matrix) @ np.abs(solution) + np.abs(load))
    signs = np.random.default_rng(0).choice([-1.0, 1.0], (SAMPLES, len(load)))
    return [factor.refined(sign * size, DIGITS) for sign in signs]
