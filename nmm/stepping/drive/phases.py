"""Phases of a run or stage: loads grow, then time passes."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol, TypeAlias, TypeVar

from nmm.assembly.state import State
from nmm.progress import Progress
from nmm.stepping.drive.dynamics import run_in_time
from nmm.stepping.drive.in_time import InTime, Schedule
from nmm.stepping.drive.statics import run_load
from nmm.stepping.drive.under_load import Beyond, LoadSchedule, UnderLoad, unseen
from nmm.stepping.drive.verdict import CONVERGED, RunVerdict
from nmm.stepping.reports.recorder import Recorder
from nmm.stepping.step.stepper import Stepper

if TYPE_CHECKING:
    from nmm.stepping.control.position import OnPath

At = TypeVar("At", InTime, UnderLoad)
EndedRun = tuple[State, RunVerdict]
RunPosition: TypeAlias = "InTime | UnderLoad | OnPath"
"""Where a run stands in time, under loads that grow, or on a path past the peak."""


class Keeps(Protocol):
    """What is shown where a run stands, and says from where it goes on."""

    def begin(self, at: At) -> At:
        """Take the start of a run or of a stage."""

    def keep(self, at: At) -> At:
        """Take the end of a step."""


@dataclass(frozen=True)
class Phases:
    """What solves phases, from a state or from where one stands (``at``; None at its start).

    Attributes
    ----------
    stepper, recorder, progress
        What solves steps, takes them, and is told how far the phase is.
    names
        Of the regions.
    keeps
        Takes where the phase stands.
    """

    stepper: Stepper
    recorder: Recorder
    progress: Progress
    names: Sequence[str]
    keeps: Keeps

    def under_loads(
        self,
        state: State,
        loads: LoadSchedule,
        at: "RunPosition | None",
        beyond: Beyond = unseen,
    ) -> EndedRun:
        """Let loads grow; ``beyond`` looks for limit points."""
        under = at or self.keeps.begin(UnderLoad.at_start(state, loads))
        assert isinstance(under, UnderLoad)
        ahead = under, loads, self.progress, self.names, self.keeps.keep, beyond
        return run_load(self.stepper, self.recorder, *ahead)

    def in_time(self, state: State, times: Schedule, at: "RunPosition | None") -> EndedRun:
        """Let time pass."""
        moving = at or self.keeps.begin(InTime.at_start(state, times))
        assert isinstance(moving, InTime)
        ahead = moving, times, self.progress, self.keeps.keep, self.names
        return run_in_time(self.stepper, self.recorder, *ahead)

    def in_balance(
        self, state: State, loads: LoadSchedule, times: Schedule, at: "RunPosition | None"
    ) -> EndedRun:
        """Bring loads on while the clock stands; then let time pass, in equilibrium."""
        if not isinstance(at, InTime):
            state, verdict = self.under_loads(state, loads, at)
            if verdict.code != CONVERGED:
                return state, verdict
            at = None
        return self.in_time(state, times, at)
