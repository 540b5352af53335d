"""Equilibrium on the updated geometry: a step is solved, bodies are moved, and it is corrected.

Where blocks may be loose anchors hold them meanwhile, which carry nothing in the end.
"""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from nmm.assembly.state import State
from nmm.effects.base import Instant
from nmm.stepping.step.stepper import Stepper
from nmm.stepping.step.trial import Attempt
from nmm.stepping.step.unopposed import too_weak, unopposed

if TYPE_CHECKING:
    from nmm.contact.points.contact_points import ContactPoints
    from nmm.contact.solution.record import Breaking, BrokenBonds

# Corrections for the turn of contacts and bodies end when they move nothing by more than this
# share of the step's own motion, or by more than coordinates are rounded (in sizes of the domain,
# or of its distance from the origin: see `rounding`).
SETTLED = 1e-8
ROUNDED_BALANCE = 1e-13
CORRECTIONS = 12
# While corrections shrink by this factor each they go on to so many.
SHRINKS, PATIENCE = 0.9, 60
# Corrections with anchors that do not shrink, so many and further than `COLLAPSE`, show a
# mechanism: what is out of balance moves it on and on.
STEADY = 4
# A block that only anchors hold may wander by so many times that rounding.
WANDER = 100.0

# A structure whose points move by this share of its size in one increment has no equilibrium near;
# one that may bend by any angle goes further on its way.
COLLAPSE, BENDING = 0.05, 1.0


@dataclass(frozen=True)
class SettledStep:
    """An attempt with its corrections, and the contacts as they are left.

    ``mechanism`` says that corrections went on without end; ``carried`` how far driven ground
    carries a body in it (m).
    """

    attempt: Attempt
    contacts: "ContactPoints | None"
    mechanism: bool = False
    carried: float = 0.0


def too_far(stepper: Stepper, carried: float = 0.0) -> float:
    """Return the largest motion (m) in one increment that is no collapse.

    What driven ground has ``carried`` so far (m) has not collapsed.
    """
    return (BENDING if stepper.kinematics.finite else COLLAPSE) * stepper.size + carried


def settle(
    stepper: Stepper,
    state: State,
    end: Instant,
    breaking: "Breaking",
    broken: "BrokenBonds | None" = None,
) -> SettledStep:
    """Find equilibrium on the updated geometry: solve, move, correct until nothing moves.

    ``broken`` are bonds that broke in an attempt of the same step before.

    Corrections are no steps of the load: what matter remembers is that of the step's start for all
    of them, and what the last one made of it is kept.
    """
    contacts: ContactPoints | None = None

    def failed(sentence: str, mechanism: bool) -> SettledStep:
        lost = replace(total, converged=False, sentence=sentence)
        return SettledStep(lost, contacts, mechanism, carried)

    least = rounding(stepper)
    total = attempt = stepper.attempt(state, end, None, breaking, broken)
    carried = stepper.carried_way(state, end)
    way, steady, count = 0.0, 0, 0
    while count < CORRECTIONS or (count < PATIENCE and not steady):
        far = not stepper.small and total.motion > too_far(stepper, carried)
        if far or not attempt.converged:
            return failed(total.sentence, far and not stepper.kinematics.finite)
        _, contacts = stepper.accept(attempt)
        if not stepper.anchored and stepper.small:
            return SettledStep(total, contacts)
        if attempt.motion <= SETTLED * total.motion + least:
            return SettledStep(total, contacts)
        last, way = attempt, way + attempt.motion
        whole = stepper.correct(attempt, state)
        attempt = stepper.attempt(_remembering(attempt.state, state), end, None, breaking)
        steady = steady + 1 if attempt.motion > SHRINKS * last.motion else 0
        total, count = joined(total, attempt, whole), count + 1
        if stepper.anchored and steady >= STEADY and way > COLLAPSE * stepper.size:
            said = f"it moved by {way:.3g} m in {count} corrections that did not shrink"
            return failed(said, mechanism=True)
    return failed(f"the moved place is not in equilibrium after {count} corrections", False)


def _remembering(moved: State, start: State) -> State:
    """Return a state with what matter and effects remember of the start."""
    return replace(moved, history=start.history, memory=start.memory)


def rounding(stepper: Stepper) -> float:
    """How far points must move to be known to have moved (m)."""
    farthest = float(np.abs(stepper.reference).max())
    still = max(ROUNDED_BALANCE * stepper.size, 4 * float(np.finfo(float).eps) * farthest)
    # Rounding of the loads, over anchors.
    return WANDER * still if stepper.anchored else still


def joined(first: Attempt, then: Attempt, whole: bool = False) -> Attempt:
    """One attempt of a step and its correction, with the way of both.

    Where the friction of the latter is that of the ``whole`` step it takes what it does on all of
    the way, else on what is left of it.
    """
    solved = then.solved
    if solved is not None and first.solved is not None:
        between = solved.between + first.solved.between
        loss, ways = solved.loss + first.solved.loss, first.solved.ways
        before, friction = first.solved.friction, solved.friction
        if whole and before is not None and friction is not None:
            corrected = before.corrected(friction)
            loss += corrected.taken - before.counted - friction.counted
            friction = replace(corrected, counted=corrected.taken)
        solved = replace(solved, loss=loss, friction=friction, between=between, ways=ways)
    return replace(
        then,
        increment=first.increment + then.increment,
        motion=max(first.motion, then.motion),
        passes=first.passes + then.passes,
        solved=solved,
    )


def may_be_loose(stepper: Stepper, found: "SettledStep") -> bool:
    """Whether anchors may help a step without equilibrium.

    Not where a bond was to break, or where matter yields along a mechanism.
    """
    attempt, solved = found.attempt, found.attempt.solved
    stopped = attempt.converged or attempt.yields or (solved is not None and solved.stopped)
    touches = stepper.plan.contact is not None
    return touches and not stepper.anchored and not stopped and not beyond_anchors(stepper, attempt)


def beyond_anchors(stepper: Stepper, attempt: Attempt) -> bool:
    """Whether a search that set no part free left more out of balance than anchors carry."""
    solved = attempt.solved
    return solved is not None and solved.answer.verdict.code == "stalled" and too_weak(stepper)


def is_adrift(stepper: Stepper) -> bool:
    """Whether rounding chose the place of a body that nothing holds: none touches another."""
    return stepper.plan.contact is None and not stepper.anchored and bool(unopposed(stepper))


def anchored(
    stepper: Stepper,
    state: State,
    end: Instant,
    breaking: "Breaking",
    before: SettledStep | None = None,
) -> SettledStep:
    """Find equilibrium with anchors; where that succeeds they stay, and carry nothing.

    Bonds that broke in its first solution ``before``, which needed none, are broken.
    """
    first = before is not None and before.contacts is None
    solved = before.attempt.solved if before is not None and first else None
    stepper.anchored = True
    found = settle(stepper, state, end, breaking, None if solved is None else solved.broken)
    stepper.anchored = found.attempt.converged
    return found
