"""Which integrator takes the first step, and the first after an impact."""

from nmm.integrators.base import Integrator
from nmm.integrators.shi import Shi


def rule_of(integrator: Integrator, knows_start: bool) -> Integrator:
    """Return the integrator of a step; ``knows_start``: its start's acceleration is known.

    Without it the step is Shi's, which needs none and damps the waves of loads that come all at
    once. Its error of the velocity, once of order 2 in the step, leaves orders as they are.
    """
    if knows_start:
        return integrator
    return integrator.beginning or Shi(kinetic_factor=integrator.kinetic_factor)
