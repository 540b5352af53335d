"""What brings a scene to its end: time, loads that grow, a path past the peak, growth, creep."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from nmm.assembly.motion import State
from nmm.progress import Progress
from nmm.stepping.after_failure import show_failure
from nmm.stepping.checkpoints import Checkpoints
from nmm.stepping.compiled import CompiledScene
from nmm.stepping.drive.dynamics import run_in_time
from nmm.stepping.drive.in_time import InTime, Schedule
from nmm.stepping.drive.statics import run_load, with_neutral
from nmm.stepping.drive.under_load import Beyond, LoadSchedule, UnderLoad, unseen
from nmm.stepping.drive.verdict import CONVERGED, FAILURE, RunVerdict
from nmm.stepping.reports.recorder import Recorder
from nmm.stepping.run_state import RunPosition, RunState

if TYPE_CHECKING:
    from nmm.scene.tables.loading.control import ControlTable

Ended = tuple[State, RunVerdict]


@dataclass(frozen=True)
class Drive:
    """A compiled scene, and what it is run with.

    Attributes
    ----------
    made
        What is run.
    recorder, checkpoints, progress
        What takes the steps, the states to go on from, and how far the run is.
    """

    made: CompiledScene
    recorder: Recorder
    checkpoints: Checkpoints
    progress: Progress

    def run(self, stood: RunState | None) -> Ended:
        """Run from the start, or from where a run stood, to the last state and the verdict."""
        self.checkpoints.counting(self.made.start.time, self.made.scene.in_time)
        at = None if stood is None else self.checkpoints.go_on(stood)
        self.made.stepper.budget.taken = self.recorder.steps
        if self.made.scene.inertia is not None:
            return self._in_time(at)
        if self.made.scene.in_time:
            return self._creep(at)
        scene, loads = self.made.scene, self._load_schedule()
        control = None if scene.loading is None else scene.loading.control
        if control is not None:
            return self._along_path(at, control, loads)
        under = at or self.checkpoints.begin(UnderLoad.at_start(self.made.start, loads))
        assert isinstance(under, UnderLoad)
        if scene.fracture is not None and scene.fracture.control == "toughness":
            return self._at_toughness(under, loads)
        return self._under_loads(under, loads)

    def _in_time(self, at: "RunPosition | None") -> Ended:
        times = self._times()
        begun = at or self.checkpoints.begin(InTime.at_start(self.made.start, times))
        assert isinstance(begun, InTime)
        return self._let_pass(begun, times)

    def _creep(self, at: "RunPosition | None") -> Ended:
        """Bring the loads on while the clock stands; then let time pass, in equilibrium."""
        asked, times = self.made.formulation.loading, self._times("creep")
        if not isinstance(at, InTime):
            increment = asked.increment if "increment" in asked.model_fields_set else 1.0
            begin = self.made.start.time
            loads = LoadSchedule(1.0, False, increment, asked.tolerance, begin, stops=True)
            under = at or self.checkpoints.begin(UnderLoad.at_start(self.made.start, loads))
            assert isinstance(under, UnderLoad)
            state, verdict = self._raised(under, loads)
            if verdict.code != CONVERGED:
                return state, verdict
            at = self.checkpoints.begin(InTime.at_start(state, times))
            assert isinstance(at, InTime)
        state, verdict = self._let_pass(at, times)
        if verdict.code == CONVERGED:  # as where loads alone grow: some place may be any
            names = self.made.regions.name
            verdict = with_neutral(verdict, self.made.stepper, state, names)
        return state, verdict

    def _along_path(
        self, at: "RunPosition | None", table: "ControlTable", loads: LoadSchedule
    ) -> Ended:
        from nmm.stepping.control.following import run_path
        from nmm.stepping.control.making import control_of
        from nmm.stepping.control.position import OnPath, PathEnd

        stepper, start = self.made.stepper, self.made.start
        control = control_of(table)
        end = PathEnd(loads.target, table.fall)
        begun = at or self.checkpoints.begin(OnPath.at_start(start, control.increment))
        assert isinstance(begun, OnPath)
        keep = self.checkpoints.keep
        return run_path(stepper, self.recorder, begun, control, end, self.progress, keep)

    def _at_toughness(self, under: UnderLoad, loads: LoadSchedule) -> Ended:
        from nmm.stepping.drive.growth import run_growth

        keep = self.checkpoints.keep
        return run_growth(self.made.stepper, self.recorder, under, loads, self.progress, keep)

    def _under_loads(self, under: UnderLoad, loads: LoadSchedule) -> Ended:
        state, verdict = self._raised(under, loads, self._beyond())
        scene = self.made.scene
        asked = None if scene.loading is None else scene.loading.motion_after_failure
        if verdict.code == FAILURE and asked:
            formulation = self.made.formulation
            show_failure(self.recorder, scene, formulation, state, verdict, asked, self.progress)
        return state, verdict

    def _raised(self, under: UnderLoad, loads: LoadSchedule, beyond: Beyond = unseen) -> Ended:
        names, keep = self.made.regions.name, self.checkpoints.keep
        ahead = under, loads, self.progress, names, keep, beyond
        return run_load(self.made.stepper, self.recorder, *ahead)

    def _let_pass(self, begun: InTime, times: Schedule) -> Ended:
        keep = self.checkpoints.keep
        return run_in_time(self.made.stepper, self.recorder, begun, times, self.progress, keep)

    def _times(self, stage: str = "dynamic") -> Schedule:
        made, duration = self.made, self.made.scene.duration
        assert duration is not None
        return Schedule.of(made.stepper, made.formulation, duration, stage=stage)

    def _load_schedule(self) -> LoadSchedule:
        loading, steps = self.made.scene.loading, self.made.formulation.loading
        if loading is None:
            increment = steps.increment if self.made.scene.followed else 1.0
            return LoadSchedule(1.0, False, increment, steps.tolerance, at_once=self.made.at_once)
        until = loading.until == "failure"
        target = loading.maximum_factor or (np.inf if until else float(loading.until))
        return LoadSchedule(target, until, steps.increment, steps.tolerance)

    def _beyond(self) -> Beyond:
        """Return what looks for limit points."""
        if self.made.stepper.plan.contact is None:
            return unseen
        from nmm.stepping.control.limit_point import LimitPoints
        from nmm.stepping.control.making import hindrances

        if hindrances(self.made.stepper, self.made.formulation):
            return unseen
        return LimitPoints(self.made.stepper)
