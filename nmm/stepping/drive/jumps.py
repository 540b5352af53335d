"""Time that passes without inertia, where the next equilibrium of loose blocks is a jump away."""

from collections.abc import Sequence
from dataclasses import dataclass

from nmm.assembly.state import State
from nmm.effects.base import Instant
from nmm.frozen import with_parts
from nmm.stepping.drive.equilibrium.relaxation import relax
from nmm.stepping.drive.equilibrium.settling import SettledStep, anchored, may_be_loose, settle
from nmm.stepping.drive.in_time import InTime, Schedule
from nmm.stepping.reports.recorder import Recorder
from nmm.stepping.step.stepper import Stepper


@dataclass(frozen=True)
class JumpToRest:
    """A step that relaxation began.

    Attributes
    ----------
    at
        Where it left blocks, at the time at which the step begins.
    found
        The step from there, accepted.
    said
        What was done.
    """

    at: State
    found: SettledStep
    said: str


def jumped(
    recorder: Recorder, at: InTime, schedule: Schedule, names: Sequence[str]
) -> JumpToRest | str:
    """Bring loose blocks to rest near where they stand, under what acts a whole step later.

    Just beyond the last load that one equilibrium bears the next one is far, beside what is out of
    balance. Matter that flows or creeps would do so by the time of the relaxation, and is left.

    Returns
    -------
    The jump, or why there is none.
    """
    stepper = recorder.stepper
    plan = stepper.plan
    if plan.inertia is not None or plan.contact is None or stepper.model.matter is not None:
        return ""
    time, start, totals = at.state.time, stepper.remember(), recorder.totals
    end = Instant(time + min(schedule.step, at.rest(schedule)), schedule.load_factor)
    rest = relax(stepper, at.state, end, names, near=True)
    said, why = f"after {rest.steps} steps of relaxation", rest.sentence
    if rest.at_rest:
        state = with_parts(rest.state, time=time, load_factor=at.state.load_factor)
        recorder.brought_to(state, end)
        found = _held(stepper, state, end)
        if found.attempt.converged:
            return JumpToRest(state, found, f"loose blocks jumped to rest {said}")
        recorder.totals, why = totals, found.attempt.sentence
    stepper.restore(start)
    return f"; no rest {said}: {why}"


def _held(stepper: Stepper, state: State, end: Instant) -> SettledStep:
    """Find equilibrium near rest, with anchors that carry nothing where it needs them."""
    start = stepper.remember()
    found = settle(stepper, state, end, "worst")
    if may_be_loose(stepper, found):
        stepper.restore(start)
        found = anchored(stepper, state, end, "worst", found)
        stepper.anchored = False
    return found
