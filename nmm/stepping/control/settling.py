"""Equilibrium in the moved place after a step along a path, with what is controlled held still.

A step is solved where it begins. Bodies that turn in it by ``r`` leave springs out of balance by
some ``r^2`` of their size, which stiff supports make much of.
"""

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from nmm.stepping.drive.equilibrium.settling import CORRECTIONS, SETTLED, joined, rounding
from nmm.stepping.step.stepper import Stepper
from nmm.stepping.step.trial import Attempt

if TYPE_CHECKING:
    from nmm.assembly.state import State
    from nmm.contact.points.contact_points import ContactPoints

Correction = Callable[[Attempt], Attempt]
"""From where a step has ended to a step from there that advances by nothing."""


# A correction of this share of the step's motion leaves its square behind: a step is in balance so
# far though the next one fails. So is one of so many times what is rounded.
LAST_CORRECTION, SEVERAL = 1e-5, 1e3


def settled(
    stepper: Stepper, attempt: Attempt, correction: Correction
) -> tuple[Attempt, "State", "ContactPoints | None"]:
    """Accept a step and correct it until nothing moves.

    Return both as one, the state as blocks are laid now, and the contacts. Where corrections find
    no balance near the step has not converged, and nothing is accepted.
    """
    before = stepper.carried
    state, contacts = stepper.accept(attempt)
    if stepper.small or state is not attempt.state:  # blocks that are laid anew turn in steps
        return attempt, state, contacts
    total, least, left = attempt, rounding(stepper), float("inf")
    for _ in range(CORRECTIONS):
        then = correction(total)
        if not then.converged or then.motion > total.motion:
            break
        state, contacts = stepper.accept(then)
        left, total = then.motion, joined(total, then)
        if left <= SETTLED * total.motion + least:
            break
    if left > LAST_CORRECTION * total.motion + SEVERAL * least:
        stepper.return_to(before)
        sentence = f"the moved place is not in equilibrium: {then.sentence}"
        return replace(total, converged=False, sentence=sentence), state, contacts
    return total, state, contacts
