"""What brings a scene to its end: time, loads that grow, a path past the peak, growth, creep."""

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from nmm.assembly.motion import State
from nmm.formulation import Formulation
from nmm.progress import Progress
from nmm.stepping.after_failure import show_failure
from nmm.stepping.checkpoints import Checkpoints
from nmm.stepping.drive.dynamics import run_in_time
from nmm.stepping.drive.in_time import InTime, Schedule
from nmm.stepping.drive.statics import Beyond, LoadSchedule, UnderLoad, run_load, unseen
from nmm.stepping.drive.verdict import CONVERGED, FAILURE, RunVerdict
from nmm.stepping.reports.recorder import Recorder
from nmm.stepping.run_state import RunState
from nmm.stepping.step.stepper import Stepper

if TYPE_CHECKING:
    from collections.abc import Sequence

    from nmm.scene.model import Scene
    from nmm.scene.tables.loading.control import ControlTable

Ended = tuple[State, RunVerdict]


@dataclass(frozen=True)
class Drive:
    """A compiled scene, and what it is run with.

    Attributes
    ----------
    scene, formulation, stepper, start
        See `nmm.stepping.simulation.Simulation`.
    names
        Of the blocks, for what is said of those that come loose.
    at_once
        See `LoadSchedule`.
    recorder, checkpoints, progress
        What takes the steps, the states to go on from, and how far the run is.
    """

    scene: "Scene"
    formulation: Formulation
    stepper: Stepper
    start: State
    names: "Sequence[str]"
    at_once: bool
    recorder: Recorder
    checkpoints: Checkpoints
    progress: Progress

    def run(self, stood: RunState | None) -> Ended:
        """Run from the start, or from where a run stood, to the last state and the verdict."""
        self.checkpoints.counting(self.start.time, self.scene.in_time)
        at = None if stood is None else self.checkpoints.go_on(stood)
        self.stepper.budget.taken = self.recorder.steps
        if self.scene.inertia is not None:
            return self._in_time(at)
        if self.scene.in_time:
            return self._creep(at)
        loads = self._load_schedule()
        control = None if self.scene.loading is None else self.scene.loading.control
        if control is not None:
            return self._along_path(control, loads)
        under = at or self.checkpoints.begin(UnderLoad.at_start(self.start, loads))
        assert isinstance(under, UnderLoad)
        if self.scene.fracture is not None and self.scene.fracture.control == "toughness":
            return self._at_toughness(under, loads)
        return self._under_loads(under, loads)

    def _in_time(self, at: InTime | UnderLoad | None) -> Ended:
        times = self._times()
        begun = at or self.checkpoints.begin(InTime.at_start(self.start, times))
        assert isinstance(begun, InTime)
        return self._let_pass(begun, times)

    def _creep(self, at: InTime | UnderLoad | None) -> Ended:
        """Bring the loads on while the clock stands; then let time pass, in equilibrium."""
        asked, times = self.formulation.loading, self._times("creep")
        if not isinstance(at, InTime):
            increment = asked.increment if "increment" in asked.model_fields_set else 1.0
            begin = self.start.time
            loads = LoadSchedule(1.0, False, increment, asked.tolerance, begin, stops=True)
            under = at or self.checkpoints.begin(UnderLoad.at_start(self.start, loads))
            assert isinstance(under, UnderLoad)
            state, verdict = self._raised(under, loads)
            if verdict.code != CONVERGED:
                return state, verdict
            at = self.checkpoints.begin(InTime.at_start(state, times))
            assert isinstance(at, InTime)
        return self._let_pass(at, times)

    def _along_path(self, table: "ControlTable", loads: LoadSchedule) -> Ended:
        from nmm.stepping.control.following import run_path
        from nmm.stepping.control.making import control_of
        from nmm.stepping.control.position import PathEnd

        control = control_of(table, self.stepper, self.formulation)
        end = PathEnd(loads.target, table.fall)
        return run_path(self.stepper, self.recorder, self.start, control, end, self.progress)

    def _at_toughness(self, under: UnderLoad, loads: LoadSchedule) -> Ended:
        from nmm.stepping.drive.growth import run_growth

        keep = self.checkpoints.keep
        return run_growth(self.stepper, self.recorder, under, loads, self.progress, keep)

    def _under_loads(self, under: UnderLoad, loads: LoadSchedule) -> Ended:
        state, verdict = self._raised(under, loads, self._beyond())
        asked = None if self.scene.loading is None else self.scene.loading.motion_after_failure
        if verdict.code == FAILURE and asked:
            show_failure(
                self.recorder, self.scene, self.formulation, state, verdict, asked, self.progress
            )
        return state, verdict

    def _raised(self, under: UnderLoad, loads: LoadSchedule, beyond: Beyond = unseen) -> Ended:
        keep, stepper, recorder = self.checkpoints.keep, self.stepper, self.recorder
        return run_load(stepper, recorder, under, loads, self.progress, self.names, keep, beyond)

    def _let_pass(self, begun: InTime, times: Schedule) -> Ended:
        keep = self.checkpoints.keep
        return run_in_time(self.stepper, self.recorder, begun, times, self.progress, keep)

    def _times(self, stage: str = "dynamic") -> Schedule:
        assert self.scene.duration is not None
        return Schedule.of(self.stepper, self.formulation, self.scene.duration, stage=stage)

    def _load_schedule(self) -> LoadSchedule:
        loading, steps = self.scene.loading, self.formulation.loading
        if loading is None:
            increment = steps.increment if self.scene.followed else 1.0
            return LoadSchedule(1.0, False, increment, steps.tolerance, at_once=self.at_once)
        until = loading.until == "failure"
        target = loading.maximum_factor or (np.inf if until else float(loading.until))
        return LoadSchedule(target, until, steps.increment, steps.tolerance)

    def _beyond(self) -> Beyond:
        """Return what looks for limit points."""
        if self.stepper.plan.contact is None:
            return unseen
        from nmm.stepping.control.limit_point import limit_point
        from nmm.stepping.control.making import hindrances

        if hindrances(self.stepper, self.formulation):
            return unseen
        return partial(limit_point, self.stepper)
