"""What brings a scene to its end: time, loads that grow, a path past the peak, growth, creep."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from nmm.progress import Progress
from nmm.stepping.after_failure import show_failure
from nmm.stepping.checkpoints import Checkpoints
from nmm.stepping.compiled_scene import CompiledScene
from nmm.stepping.drive.in_time import Schedule
from nmm.stepping.drive.load_verdicts import with_unheld
from nmm.stepping.drive.phases import EndedRun, Phases, RunPosition
from nmm.stepping.drive.under_load import Beyond, LoadSchedule, UnderLoad, unseen
from nmm.stepping.drive.verdict import CONVERGED, FAILURE
from nmm.stepping.reports.recorder import Recorder
from nmm.stepping.run_state import RunState

if TYPE_CHECKING:
    from nmm.scene.tables.loading.control import ControlTable


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

    def run(self, stood: RunState | None) -> EndedRun:
        """Run from the start, or from where a run stood, to the last state and the verdict."""
        self.checkpoints.counting(self.made.start.time, self.made.scene.in_time)
        at = None if stood is None else self.checkpoints.go_on(stood)
        self.made.stepper.budget.taken = self.recorder.steps
        if self.made.scene.inertia is not None:
            return self._phases.in_time(self.made.start, self._times(), at)
        if self.made.scene.in_time:
            return self._creep(at)
        scene, loads = self.made.scene, self._load_schedule()
        control = None if scene.loading is None else scene.loading.control
        if control is not None:
            return self._along_path(at, control, loads)
        if scene.fracture is not None and scene.fracture.control == "toughness":
            return self._at_toughness(at, loads)
        return self._under_loads(at, loads)

    @property
    def _phases(self) -> Phases:
        names, stepper = self.made.regions.name, self.made.stepper
        return Phases(stepper, self.recorder, self.progress, names, self.checkpoints)

    def _creep(self, at: "RunPosition | None") -> EndedRun:
        start, times = self.made.start, self._times("creep")
        loads = LoadSchedule.brought_on(self.made.formulation.loading, start.time, stops=True)
        state, verdict = self._phases.in_balance(start, loads, times, at)
        if verdict.code == CONVERGED:  # as where loads alone grow: some place may be any
            names = self.made.regions.name
            verdict = with_unheld(verdict, self.made.stepper, state, names)
        return state, verdict

    def _along_path(
        self, at: "RunPosition | None", table: "ControlTable", loads: LoadSchedule
    ) -> EndedRun:
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

    def _at_toughness(self, at: "RunPosition | None", loads: LoadSchedule) -> EndedRun:
        from nmm.stepping.drive.growth import run_growth

        under = at or self.checkpoints.begin(UnderLoad.at_start(self.made.start, loads))
        assert isinstance(under, UnderLoad)
        scene, keep = self.made.scene, self.checkpoints.keep
        dead = scene.gravity is not None
        dead |= scene.loading is not None and scene.loading.scaled != "all"
        given = self.made.stepper, self.recorder, under, loads, self.progress, keep
        return run_growth(*given, dead=dead)

    def _under_loads(self, at: "RunPosition | None", loads: LoadSchedule) -> EndedRun:
        state, verdict = self._phases.under_loads(self.made.start, loads, at, self._beyond())
        scene = self.made.scene
        asked = None if scene.loading is None else scene.loading.motion_after_failure
        if verdict.code == FAILURE and asked:
            formulation = self.made.formulation
            show_failure(self.recorder, scene, formulation, state, verdict, asked, self.progress)
        return state, verdict

    def _times(self, stage: str = "dynamic") -> Schedule:
        made, duration = self.made, self.made.scene.duration
        assert duration is not None
        return Schedule.of(made.stepper, made.formulation, duration, stage=stage)

    def _load_schedule(self) -> LoadSchedule:
        scene, steps = self.made.scene, self.made.formulation.loading
        loading, alike = scene.loading, {"followed": scene.followed}
        if loading is None:
            increment = steps.increment if scene.followed else 1.0
            # Cracks that weight or driven supports open meet all of it, whatever the increment.
            at_once = self.made.at_once or (scene.fracture is not None and scene.steady)
            return LoadSchedule(1.0, False, increment, steps.tolerance, at_once=at_once, **alike)
        until = loading.until == "failure"
        target = loading.maximum_factor or (np.inf if until else float(loading.until))
        return LoadSchedule(target, until, steps.increment, steps.tolerance, **alike)

    def _beyond(self) -> Beyond:
        """Return what looks for limit points."""
        stepper = self.made.stepper
        if stepper.plan.contact is None:
            return unseen
        from nmm.stepping.control.limit_point import LimitPoints
        from nmm.stepping.control.making import hindrances

        if hindrances(stepper, self.made.formulation):
            return unseen
        return LimitPoints(stepper)
