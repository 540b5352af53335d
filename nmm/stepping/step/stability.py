"""Whether an equilibrium of finite strain is stable: its tangent resists the softest motion.

Newton's method finds equilibria of every kind. A straight column is one beyond its critical load
too, which no slow test would meet.
"""

from dataclasses import replace

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.solvers.factor import Factor
from nmm.stepping.step.linear.equations import Equations
from nmm.stepping.step.trial import Attempt

# Turns of inverse iteration: each brings out the softest motion by the ratio of two stiffnesses.
INVERSE_ITERATIONS = 4
# Stiffness of a motion, as a share of the elastic one, that is none but rounding.
NONE = 1e-12


def unless_unstable(
    attempt: Attempt, equations: Equations, factor: Factor, elastic: csc_array, measure: csc_array
) -> Attempt:
    """Return an attempt, failed where statics came to rest unstably; see `unstable`."""
    asked = attempt.converged and equations.step is None and equations.symmetric
    if not asked or not unstable(factor, elastic, attempt.increment, measure):
        return attempt
    sentence = "the equilibrium that was found is not stable"
    return replace(
        attempt, converged=False, state=equations.state, sentence=sentence, singular=True
    )


def unstable(factor: Factor, elastic: csc_array, increment: Floats, measure: csc_array) -> bool:
    """Say whether a symmetric tangent has a motion that it drives on.

    Parameters
    ----------
    factor
        Of the tangent (n, n), or of it with conditions of multipliers beside it: motions are then
        those that keep them.
    elastic
        (n, n) stiffness where nothing has moved, by which motions are measured: functions that are
        dependent have none in either.
    increment
        (n,) unknowns of the step, with which the search begins: they have a share of what is soft,
        but where nothing leads there, as in a straight column.
    measure
        (n, n) mass of a density of one: what an arbitrary load on the volume moves is soft too.
    """
    tangent, n = factor.matrix, len(increment)
    load = np.zeros(tangent.shape[0])
    load[:n] = measure @ np.random.default_rng(0).standard_normal(n)
    way = np.zeros(n)
    for one in (increment, factor.refined(load)[:n]):
        size = float(one @ (elastic @ one))
        way += one / np.sqrt(size) if size > 0 else 0.0
    for _ in range(INVERSE_ITERATIONS):
        size = float(way @ (elastic @ way))
        if not 0 < size < np.inf:
            return False
        load = np.zeros(tangent.shape[0])
        load[:n] = elastic @ way / np.sqrt(size)
        way = factor.refined(load)[:n]
    stiffness = csc_array(tangent[:n, :n])
    return bool(way @ (stiffness @ way) < -NONE * (way @ (elastic @ way)))
