"""Coulomb's law with cohesion and a limit of tension, and the states it leads to."""

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.contact.problem.step_problem import BONDED, BROKEN, OPEN, SLIDE, STICK, Limits, StepProblem


def shear_bound(normal: Floats, is_open: Bools, limits: Limits) -> Floats:
    """Largest shear force ``cohesion + friction max(-N, 0)``; 0 where open without a bond."""
    bound = limits.cohesion + limits.friction * np.maximum(-normal, 0.0)
    return np.where(is_open & (limits.tension <= 0), 0.0, bound)


def project(normal: Floats, shear: Floats, limits: Limits) -> tuple[Floats, Floats]:
    """Admissible forces of the trial forces ``normal`` and ``shear`` (N).

    First the normal force is cut at the tension limit, then the shear force at the bound that
    belongs to it: Coulomb's law without dilatancy.
    """
    bounded = np.minimum(normal, limits.tension)
    bound = shear_bound(bounded, normal > limits.tension, limits)
    return bounded, np.clip(shear, -bound, bound)


def label(problem: StepProblem, is_open: Bools, sliding: Bools) -> Ints:
    """States of contacts that are open, sliding or neither, given what they were."""
    bonded, broken = problem.state == BONDED, problem.state == BROKEN
    held = np.where(bonded, BONDED, STICK)
    closed = np.where(sliding, SLIDE, held)
    lost = np.where(broken | (problem.limits.tension > 0), BROKEN, OPEN)
    return np.where(is_open, lost, closed).astype(np.int64)
