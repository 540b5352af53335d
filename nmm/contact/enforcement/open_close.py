"""Open-close iteration: which contact springs act in one iteration, and what changes then."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Bools, Floats
from nmm.contact.problem.coulomb import frictionless, shear_bound
from nmm.contact.problem.step_problem import BONDED, SLIDE, STICK, Limits, StepProblem


@dataclass(frozen=True)
class ActiveSet:
    """States of all contacts in a pass.

    Attributes
    ----------
    closed
        (m,) the normal spring acts; otherwise the normal force is the tension limit (0 as a rule).
    sliding
        (m,) the shear force is at its bound; otherwise the shear spring acts.
    sign
        (m,) direction of the shear force of sliding contacts, -1, 0 or 1.
    """

    closed: Bools
    sliding: Bools
    sign: Floats

    def sticks(self, limits: Limits) -> Bools:
        """Return which contacts (m,) have a shear spring that acts."""
        return ~self.sliding & (self.closed | (limits.tension > 0))

    @property
    def code(self) -> bytes:
        """The states as bytes: equal states, equal codes."""
        return (self.closed + 2 * self.sliding * (2 + self.sign)).astype(np.uint8).tobytes()


def first_active_set(problem: StepProblem) -> ActiveSet:
    """Active set of the first pass: the states given, and what penetrates is closed."""
    touched = np.isin(problem.state, (STICK, SLIDE, BONDED))
    closed = touched | (problem.gap <= 0)
    smooth = frictionless(problem.limits)
    sign = np.sign(np.where(problem.shear_force != 0, problem.shear_force, problem.slip))
    sliding = smooth | ((problem.state == SLIDE) & (sign != 0))
    return ActiveSet(closed, sliding, np.where(smooth, 0.0, sign) * sliding)


def next_active_set(
    problem: StepProblem, springs: ActiveSet, gap: Floats, slip: Floats
) -> ActiveSet:
    """States after a pass that ended in ``gap`` and ``slip`` (Shi 1988, open-close iteration).

    Open contacts close when they penetrate, closed ones open when their pull exceeds the tension
    limit; sticking ones slide when the shear force exceeds its bound, sliding ones stick when the
    spring, unloaded from the bound, carries less.
    """
    limits = problem.limits
    normal = problem.normal_stiffness * gap
    shear = problem.shear_stiffness * slip
    opens = np.where(springs.closed, normal > limits.tension, normal >= limits.tension)
    bound = shear_bound(np.minimum(normal, limits.tension), ~opens, limits)
    smooth = frictionless(limits)
    stays = springs.sliding & (springs.sign * shear >= bound)
    resists = springs.closed | (limits.tension > 0)
    turned = resists & (np.abs(shear) > bound)
    sliding = stays | turned | smooth
    return ActiveSet(~opens, sliding, np.where(smooth, 0.0, np.sign(shear)) * sliding)


def forces(
    problem: StepProblem, springs: ActiveSet, gap: Floats, slip: Floats
) -> tuple[Floats, Floats]:
    """Normal and shear force that the springs carry at ``gap`` and ``slip``."""
    limits = problem.limits
    normal = np.where(springs.closed, problem.normal_stiffness * gap, limits.tension)
    bound = shear_bound(normal, springs.closed, limits)
    at_bound = springs.sign * np.where(springs.sliding, bound, 0.0)
    return normal, np.where(springs.sticks(limits), problem.shear_stiffness * slip, at_bound)


def changes(problem: StepProblem, old: ActiveSet, new: ActiveSet) -> Bools:
    """(m,) contacts whose state differs; the shear state of lost contacts does not count."""
    shear = (old.sliding != new.sliding) | (old.sign != new.sign)
    bond = problem.limits.tension > 0
    stays = (old.closed | bond) & (new.closed | bond)
    return np.asarray((old.closed != new.closed) | (shear & stays))


def words(springs: ActiveSet, contact: int) -> str:
    """State of one contact in words."""
    if not springs.closed[contact]:
        return "open"
    if not springs.sliding[contact]:
        return "stick"
    return {1: "slide+", -1: "slide-"}.get(int(springs.sign[contact]), "slide")
