"""When a run stores where it stands, and how it goes on from there.

A run that stores goes on from what it has stored, with an empty workspace, just as one does that
was stopped: so both take the same steps, bit by bit.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeVar, cast

from nmm.assembly.matter import Matter
from nmm.results.storage.values import Arrays
from nmm.stepping.drive.in_time import InTime
from nmm.stepping.drive.phases import RunPosition
from nmm.stepping.drive.stages import StagesSoFar
from nmm.stepping.drive.under_load import UnderLoad
from nmm.stepping.reports.monitors import monitors
from nmm.stepping.reports.output import FrameChoice
from nmm.stepping.reports.recorder import Recorder
from nmm.stepping.run_state import RunState
from nmm.stepping.step.stepper import Stepper

if TYPE_CHECKING:
    from nmm.scene.output import CheckpointTable
    from nmm.stepping.control.position import OnPath

At = TypeVar("At", InTime, UnderLoad, "OnPath")


def checkpoint_choice(
    asked: "CheckpointTable | None", begin: float, in_time: bool
) -> FrameChoice | None:
    """Return after which steps is stored, None is never; time counts in dynamics alone."""
    if asked is None:
        return None
    return FrameChoice(begin, asked.every_time if in_time else None, asked.every_steps)


@dataclass
class Checkpoints:
    """Stores where a run stands.

    Attributes
    ----------
    stepper, recorder
        Of the run.
    asked
        What the scene says of checkpoints.
    store
        Takes what is stored.
    choice
        After which steps it is stored; None is never.
    stages
        Those that were entered; None of a run without stages.
    """

    stepper: Stepper
    recorder: Recorder
    asked: "CheckpointTable | None"
    store: Callable[[Arrays], None]
    choice: FrameChoice | None = None
    stages: StagesSoFar | None = None
    _periods: int = 0

    def counting(self, begin: float, in_time: bool) -> "Checkpoints":
        """Count from ``begin`` (s), in time or under loads."""
        self.choice = checkpoint_choice(self.asked, begin, in_time)
        return self

    def entered(self, stages: StagesSoFar, in_time: bool) -> "Checkpoints":
        """Go on with the present one of ``stages``, which counts anew."""
        self.stages = stages
        return self.counting(stages.start.time, in_time)

    def begin(self, at: At) -> At:
        """Store the start of a run, so that it can go on whenever it is stopped."""
        return at if self.choice is None else self._stored(at)

    def keep(self, at: At) -> At:
        """Store where the run stands, if it is time; return from where it goes on."""
        if self.choice is None:
            return at
        time, steps, before = at.state.time, self.recorder.totals.taken, self._periods
        self._periods = max(before, self.choice.periods(time))
        due = self.choice.takes(time, steps, before, frozenset())
        return self._stored(at) if due else at

    def go_on(self, state: RunState) -> RunPosition:
        """Take up a run where it stood."""
        self.stepper.carry(state.carried)
        self.recorder.totals, self.recorder.zero = state.totals, state.zero
        self.recorder.before = state.before
        if state.stages is not None or state.carried.geometry is not None:
            setup = self.stepper.discretisation.setup
            found = monitors(setup, all_there=False, zero=state.zero.state)
            self.recorder.monitors = found
        if self.choice is not None:
            self._periods = self.choice.periods(state.at.state.time)
        return state.at

    def _stored(self, at: At) -> At:
        flows = isinstance(self.stepper.model.matter, Matter)
        before = self.recorder.before if flows else None
        recorded = self.recorder.totals, self.stages, self.recorder.zero, before
        arrays = RunState(at, self.stepper.carried, *recorded).to_arrays()
        self.store(arrays)
        return cast(At, self.go_on(RunState.from_arrays(arrays)))
