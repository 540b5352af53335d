"""A step that is taken for the time being: kept, or undone as if it had never been."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

from nmm.results.tee import Deferred

if TYPE_CHECKING:
    from nmm.stepping.reports.recorder import Recorder
    from nmm.stepping.reports.totals import Totals
    from nmm.stepping.step.carried import CarriedState


@dataclass(frozen=True)
class ProvisionalStep:
    """What a recorder and its stepper knew before the step, and what they write of it since.

    Attributes
    ----------
    recorder
        Whose stepper takes the step.
    deferred
        What was written since; nothing of it has reached the sink.
    totals, carried, taken
        Of the recorder, of the stepper and its effects, and of the budget, before the step.
    """

    recorder: "Recorder"
    deferred: Deferred
    totals: "Totals"
    carried: "CarriedState"
    taken: int

    @classmethod
    def begin(cls, recorder: "Recorder") -> Self:
        """Hold back from now on what the recorder writes."""
        stepper = recorder.stepper
        sink = Deferred(recorder.sink)
        found = cls(recorder, sink, recorder.totals, stepper.carried, stepper.budget.taken)
        recorder.sink = sink
        return found

    def keep(self) -> None:
        """Hand on what was deferred."""
        self.recorder.sink = self.deferred.release()

    def undo(self) -> None:
        """Go back to where the step began."""
        recorder = self.recorder
        recorder.sink, recorder.totals = self.deferred.behind, self.totals
        recorder.stepper.budget.taken = self.taken
        recorder.stepper.return_to(self.carried)
