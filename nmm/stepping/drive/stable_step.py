"""The longest step of an explicit integrator: its limit over the highest frequency."""

from typing import TYPE_CHECKING

import numpy as np

from nmm.assembly.state import State
from nmm.solvers.spectrum import highest

if TYPE_CHECKING:
    from nmm.stepping.step.stepper import Stepper


def singular_mass(stepper: "Stepper") -> bool:
    """Whether an explicit integrator meets a mass of dependent functions, which has no inverse."""
    if np.isinf(stepper.integrator.limit):
        return False
    return not stepper.model.lumped and bool(stepper.model.manifold.dependent)


def longest_step(stepper: "Stepper", state: State) -> float:
    """Return the longest stable step (s); infinite of implicit integrators.

    The frequency ``w`` is that of the matter and of all that effects add to its stiffness;
    conditions of multipliers only lower it. A damper that takes the velocity at the rate ``2 a``
    shortens the step: by central differences of the velocity half a step before it is ``limit /
    (sqrt(w^2 + a^2) + a)``, which without stiffness is ``limit / 2 a``. Asked are the stiffest
    motion and the one that is damped most.
    """
    limit = stepper.integrator.limit
    if np.isinf(limit):
        return np.inf
    plan = stepper.plan
    if plan.inertia is None:
        return np.inf
    mass = plan.inertia.mass
    stiffness = plan.matrix(state, stepper.model.tangent(state))
    dampers = list(plan.damping(state).values())
    matrices = [stiffness, sum(dampers[1:], dampers[0])] if dampers else [stiffness]
    rates = []
    for matrix in matrices:
        _, mode = highest(matrix, mass)
        heavy = mode @ (mass @ mode)
        square = max(float(mode @ (stiffness @ mode) / heavy), 0.0)
        half = float(sum(mode @ (one @ mode) for one in dampers) / heavy) / 2
        rates.append(np.sqrt(square + half**2) + half)
    return float(limit / max(rates)) if max(rates) > 0 else np.inf
