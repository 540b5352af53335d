"""Coulomb's law with cohesion and a limit of tension, as every iteration asks for it.

Forces are admissible where ``N <= t`` and ``|T| <= c + mu max(-N, 0)``. Without a bond (``t = 0``)
the cohesion is lost with the contact. The bound follows the normal force, so sliding does not
dilate and tangents are unsymmetric.
"""

import numpy as np

from integration.arrays import Bools, Floats, Ints
from integration.contraction import largest
from nmm.contact.problem.step_problem import (
    BONDED,
    BROKEN,
    OPEN,
    SLIDE,
    STICK,
    Limits,
    StepAnswer,
    StepProblem,
)

NUMBERS = tuple(int(state) for state in (OPEN, STICK, SLIDE, BONDED, BROKEN))
"""Of the states, which arrays compare without asking what they are."""

# Share of the largest shear of a motion that is rounding.
NEXT_TO_NOTHING = 1e-6


def shear_bound(normal: Floats, closed: Bools, limits: Limits) -> Floats:
    """Largest shear force (N) ``c + mu max(-N, 0)`` of normal forces (m,) within their limit.

    The cohesion counts where contacts are ``closed`` (m,) or joined by a bond.
    """
    cohesion = np.where(closed | (limits.tension > 0), limits.cohesion, 0.0)
    return np.asarray(cohesion + limits.friction * np.maximum(-normal, 0.0))


def bound_slope(normal: Floats, limits: Limits) -> Floats:
    """(m,) by how much the bound grows with the pressure: the friction of pressed contacts."""
    return np.where(normal < 0, limits.friction, 0.0)


def frictionless(limits: Limits) -> Bools:
    """(m,) contacts that carry no shear force whatever presses them."""
    return np.asarray((limits.friction == 0) & (limits.cohesion == 0))


def states(normal: Floats, shear: Floats, limits: Limits) -> tuple[Bools, Bools, Floats]:
    """(m,) open contacts, sliding ones, and bounds (N) that trial forces (N) mean."""
    is_open = normal > limits.tension
    bound = shear_bound(np.minimum(normal, limits.tension), ~is_open, limits)
    return is_open, np.abs(shear) > bound, bound


def project(normal: Floats, shear: Floats, limits: Limits) -> tuple[Floats, Floats]:
    """Admissible forces of the trial forces ``normal`` and ``shear`` (N).

    First the normal force is cut at the tension limit, then the shear force at the bound that
    belongs to it.
    """
    _, _, bound = states(normal, shear, limits)
    return np.minimum(normal, limits.tension), np.clip(shear, -bound, bound)


def tangent(normal: Floats, shear: Floats, limits: Limits) -> tuple[Floats, Floats, Floats]:
    """(m,) derivatives of the admissible forces by the trial forces (Alart, Curnier 1991).

    ``dN/dN'``, ``dT/dT'`` and ``dT/dN'``; where the law has an edge, those of the side within.
    """
    is_open, sliding, _ = states(normal, shear, limits)
    acts = np.where(is_open, 0.0, 1.0)
    held = np.where(sliding | (is_open & (limits.tension <= 0)), 0.0, 1.0)
    slope = bound_slope(np.minimum(normal, limits.tension), limits)
    return acts, held, np.where(sliding, -np.sign(shear) * slope * acts, 0.0)


def label(problem: StepProblem, is_open: Bools, sliding: Bools) -> Ints:
    """States of contacts that are open, sliding or neither, given what they were."""
    open_, stick, slide, bond, gone = NUMBERS
    bonded, broken = problem.state == bond, problem.state == gone
    closed = np.where(sliding, slide, np.where(bonded, bond, stick))
    lost = np.where(broken | (problem.limits.tension > 0), gone, open_)
    return np.where(is_open, lost, closed).astype(np.int64)


def turned_back(problem: StepProblem, answer: StepAnswer, motion: Floats | None) -> Bools:
    """Return contacts (m,) that a motion (n,) shears against their shear force."""
    if motion is None:
        return np.zeros(problem.n_contacts, dtype=bool)
    sheared = problem.tangent_rows[:, : len(motion)] @ motion
    against = np.where(answer.shear_force < 0, sheared, -sheared)
    return np.asarray(against > NEXT_TO_NOTHING * largest(np.abs(sheared), initial=0.0))
