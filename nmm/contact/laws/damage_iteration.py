"""What interface laws change between two solutions of one step: damage, and faces that ride up.

Every solution is that of limits that stand; what they should have been follows from it. Under
softening of slope ``h`` against a structure of stiffness ``S`` the changes shrink by ``h / S`` a
turn: they settle as long as the structure is stable, and acceleration makes that quick.
"""

from dataclasses import replace

import numpy as np

from integration.arrays import Bools, Floats
from nmm.contact.laws.bonds import Laws
from nmm.contact.laws.tension_compression import AsymmetricSprings
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.problem.step_problem import StepAnswer, StepProblem, Verdict
from nmm.solvers.anderson import FixedPoint

MOST = 200
"""Turns after which a step is given up."""
SETTLED = 1e-9
"""Change of damage, or of the rise of the faces over the largest gap, that is as good as none."""

NONE = AsymmetricSprings(np.zeros(0, dtype=np.int64), np.zeros(0))


class Turns:
    """Damage and rise of the contacts of one step, turn by turn.

    Attributes
    ----------
    start, contacts
        The contacts at the start of the step, and with the damage of this turn.
    asymmetric
        Bonds that have opened once.
    rise, lift
        (m,) by how much sliding has lifted the faces at the start, and by the end (m).
    done
        Whether the last answer agrees with the damage and rise it was found with.
    """

    def __init__(self, laws: Laws, start: ContactPoints) -> None:
        self._laws = laws
        self.start = self.contacts = start
        self._soft = laws.softening(start)
        self._stiffness, self.asymmetric = _whole_and_opened(laws, start, self._soft)
        self.rise = self.lift = laws.lift(start, start.worn)
        self.done = False
        self._count = 0
        self._iteration = FixedPoint()

    def settled(self, answer: StepAnswer, sliding: Floats) -> Verdict | None:
        """Take note of an answer; return a verdict when there have been too many turns."""
        if not self._soft.any() and not self._laws.dilates:
            self.done = True
            return None
        damage = self._laws.damaged(self.start, answer.gap, sliding, self._stiffness)
        lift = self._laws.lift(self.start, self.start.worn + np.abs(sliding))
        size = max(float(np.abs(answer.gap).max(initial=0.0)), float(lift.max(initial=0.0)))
        point, image = (
            np.concatenate([one[self._soft], rise / size if size else rise])
            for one, rise in ((self.contacts.damage, self.lift), (damage, lift))
        )
        change = float(np.abs(image - point).max(initial=0.0))
        self.done = change <= SETTLED
        self._count += 1
        if self.done:
            self.contacts = replace(self.contacts, damage=damage)
            return None
        if self._count == MOST:
            sentence = (
                f"damage still changed by {change:.1e} after {MOST} solutions of the step; "
                "shorten the step or the load increment"
            )
            return Verdict(False, "passes", sentence)
        following = self._iteration.next(point, image)
        n_soft = int(self._soft.sum())
        damage = self.start.damage.copy()
        damage[self._soft] = np.clip(following[:n_soft], damage[self._soft], 1.0)
        self.contacts = replace(self.contacts, damage=damage)
        self.lift = np.maximum(following[n_soft:], 0.0) * (size or 1.0)
        return None

    def loss(self, answer: StepAnswer, sliding: Floats) -> float:
        """Energy (J) that friction and softening took in the step."""
        rubbed = np.abs(answer.shear_force * sliding)
        if not self._soft.any():
            return float(rubbed.sum())
        before = self.start.take(self._soft)
        normal = (before.normal_force + answer.normal_force[self._soft]) / 2
        shear = (before.shear_force + answer.shear_force[self._soft]) / 2
        after = replace(
            self.contacts.take(self._soft),
            gap=answer.gap[self._soft],
            slip=answer.slip[self._soft],
            slid=before.slid + sliding[self._soft],
        )
        way = after.slip + after.slid - before.slip - before.slid
        work = normal @ (after.gap - before.gap) + shear @ way
        stored = self._laws.energy(after) - self._laws.energy(before)
        return float(rubbed[~self._soft].sum() + work - stored)


def _whole_and_opened(
    laws: Laws, start: ContactPoints, soft: Bools
) -> tuple[Floats, AsymmetricSprings]:
    """Normal stiffness (m,) of whole bonds (N/m), and those of the ``soft`` that opened once."""
    if not soft.any():
        return np.zeros(len(start)), NONE
    opened, whole = (
        laws.springs(start, np.full(len(start), is_open))[0] for is_open in (True, False)
    )
    index = np.flatnonzero(soft & (opened < (1 - 1e-9) * whole))
    return whole, AsymmetricSprings(index, opened[index] / whole[index])


def slid_under_load(problem: StepProblem, answer: StepAnswer) -> Floats:
    """How far (m,) contacts slid beyond the elastic stretch; zero where nothing presses or rubs."""
    loaded = (answer.normal_force != 0) | (answer.shear_force != 0)
    return np.where(loaded, problem.slips(answer.increment) - answer.slip, 0.0)
