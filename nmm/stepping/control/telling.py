"""Accepted steps of a path: booked, told, and where the path stands after them."""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from nmm.assembly.state import State
from nmm.controls.base import Control
from nmm.progress import Progress
from nmm.stepping.control.position import OnPath
from nmm.stepping.reports.recorder import Recorder
from nmm.stepping.step.stepper import Stepper
from nmm.stepping.step.trial import Attempt

if TYPE_CHECKING:
    from nmm.contact.points.contact_points import ContactPoints


@dataclass(frozen=True)
class Telling:
    """Books the steps of a path under a control, and tells of them."""

    stepper: Stepper
    recorder: Recorder
    control: Control
    progress: Progress

    def told(
        self,
        at: OnPath,
        attempt: Attempt,
        state: State,
        contacts: "ContactPoints | None",
        way: float,
        jump: bool = False,
    ) -> OnPath:
        """Tell a step that was accepted, and return where the path stands; time counts steps.

        It went a ``way`` of what is controlled; ``jump`` says that bonds broke in it at once.
        """
        recorder, time = self.recorder, at.state.time + 1.0
        later, state = replace(attempt.state, time=time), replace(state, time=time)
        attempt = replace(attempt, state=later)
        anew = jump and at.changed
        if (jump or self.control.by_load) and attempt.solved is not None:
            solved = replace(attempt.solved, between=0.0)
            plan, model = self.stepper.plan, self.stepper.model
            within = replace(attempt, solved=solved)
            # Motion in which bonds broke.
            lost = recorder.ledger.released(plan, model, at.state, within)
            if anew:  # where new faces leave more stored, functions of a tip went: no loss
                lost = max(lost, solved.loss, 0.0)
            attempt = replace(attempt, solved=replace(solved, loss=lost))
        elif attempt.solved is not None:
            lost = attempt.solved.loss + at.shed
            attempt = replace(attempt, solved=replace(attempt.solved, loss=lost))
        said = recorder.step(at.state, attempt, contacts, anew=anew)
        recorder.offer(state, "load", contacts)
        factor = state.load_factor
        self.progress(
            min(at.gone / self.control.end, 1.0), f"load factor {factor:.5g}  {said}".rstrip()
        )
        return replace(
            at,
            state=state,
            contacts=contacts,
            way=at.way + attempt.increment,
            gone=at.gone + way,
            peak=max(at.peak, factor),
            shed=0.0,
        )
