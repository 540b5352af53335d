"""A step that is taken for the time being: kept, or undone as if it had never been."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

from nmm.results.tee import Held

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
    held
        What was written since; nothing of it has reached the sink.
    totals, carried, taken
        Of the recorder, of the stepper and its effects, and of the budget, before the step.
    """

    recorder: "Recorder"
    held: Held
    totals: "Totals"
    carried: "CarriedState"
    taken: int

    @classmethod
    def begin(cls, recorder: "Recorder") -> Self:
        """Hold back from now on what the recorder writes."""
        stepper = recorder.stepper
        held = Held(recorder.sink)
        found = cls(recorder, held, recorder.totals, stepper.carried, stepper.budget.taken)
        recorder.sink = held
        return found

    def keep(self) -> None:
        """Hand on what was held back."""
        self.recorder.sink = self.held.release()

    def undo(self) -> None:
        """Go back to where the step began."""
        recorder = self.recorder
        recorder.sink, recorder.totals = self.held.behind, self.totals
        recorder.stepper.budget.taken = self.taken
        recorder.stepper.return_to(self.carried)
