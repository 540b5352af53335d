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

    The frequency is that of the matter and of all that effects add to its stiffness; conditions of
    multipliers only lower it. A damper of the ratio ``z`` shortens the step by ``sqrt(1 + z^2) -
    z``.
    """
    limit = stepper.integrator.limit
    if np.isinf(limit):
        return np.inf
    plan = stepper.plan
    if plan.inertia is None:
        return np.inf
    stiffness = plan.matrix(state, stepper.model.tangent(state))
    square, mode = highest(stiffness, plan.inertia.mass)
    omega, heavy = np.sqrt(square), float(mode @ (plan.inertia.mass @ mode))
    damped = sum(float(mode @ (one @ mode)) for one in plan.damping(state).values())
    ratio = damped / (2 * omega * heavy)
    return float(limit / omega * (np.sqrt(1 + ratio**2) - ratio))
