"""A scene and a formulation, compiled and ready to run."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, cast

import numpy as np

from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.formulation import Formulation, as_tables
from nmm.integrators.base import make_integrator
from nmm.model.build import reshaped
from nmm.model.origin import MovedBack
from nmm.model.staging.stage_geometry import present_setup
from nmm.progress import Progress
from nmm.results.frame import Topology
from nmm.results.safety import Safety
from nmm.results.sink import Sink
from nmm.results.storage import files
from nmm.results.storage.checkpoint import damaged
from nmm.results.storage.run_folder import RunFolder, checkpoint_header
from nmm.results.storage.values import Arrays
from nmm.results.summary import Summary
from nmm.results.tee import Tee
from nmm.stepping.bounds.passed import beside_bound
from nmm.stepping.bounds.static_theorem import load_bound
from nmm.stepping.checkpoints import Checkpoints
from nmm.stepping.compiled_scene import CompiledScene
from nmm.stepping.drive.changes import topology
from nmm.stepping.drive.stages import StagesSoFar, enter_again, run_stages
from nmm.stepping.driving import Drive
from nmm.stepping.reports.declared import DeclaredOutputs
from nmm.stepping.reports.monitors import Monitor
from nmm.stepping.reports.output import (
    FrameChoice,
    Storage,
    choice_in_time,
    choice_under_loads,
    storage,
)
from nmm.stepping.reports.recorder import Recorder
from nmm.stepping.run_state import RunState
from nmm.stepping.summing_up import summed_up

if TYPE_CHECKING:
    from nmm.model.staging.stages import Staged
    from nmm.scene.model import Scene
    from nmm.stepping.drive.in_time import InTime
    from nmm.stepping.drive.under_load import UnderLoad


@dataclass(frozen=True, kw_only=True)
class Simulation(CompiledScene):
    """A scene and a formulation, compiled and ready to run.

    Attributes
    ----------
    monitors
        Points whose displacement is recorded.
    begun
        When the preparation began, for the seconds of the summary.
    origin
        (2,) where the axes of model and states lie (m); what is written has those of the scene.
    stages
        What is solved one after the other; none in a scene without stages.
    safety
        The factor of safety at which the scene is run; None where strength is not reduced.
    """

    monitors: list[Monitor]
    begun: float
    origin: Floats
    stages: "Sequence[Staged]" = ()
    safety: Safety | None = None

    def folder(self, path: Path) -> RunFolder:
        """Return the run folder at ``path`` with scene and formulation as run."""
        return RunFolder(
            path,
            scene=_toml(self.scene),
            formulation=_toml(self.formulation),
            summary=self.identity(),
        )

    def reopened(
        self, path: Path, begun: Callable[[Arrays], bool] = lambda arrays: True
    ) -> tuple[RunFolder, RunState | None]:
        """Return the run folder at ``path`` as it was at its checkpoint, and where it stood.

        ``begun`` says of what it stored whether the run had begun.

        Raises
        ------
        StorageError, DamageError
            See `RunFolder.reopened`.
        """
        known = self.identity()
        folder, arrays = RunFolder.reopened(path, known, checkpoint_header(known))
        try:
            if not begun(arrays):
                return folder, None
            stood = RunState.from_arrays(arrays)
            return folder, stood.checked(self._model_of(stood))
        except ValueError as fault:
            folder.close()
            raise damaged(path / files.CHECKPOINT, str(fault)) from fault

    def run(
        self,
        sinks: list[Sink],
        progress: Progress,
        store: Callable[[Arrays], None] = lambda arrays: None,
        stood: RunState | None = None,
    ) -> State:
        """Run to the end, or to the step that cannot be solved; return the last state.

        ``store`` takes checkpoints; ``stood`` is where the run goes on, None from its start.
        """
        self._compile_ahead()
        bound = self._failure_bound()
        sink: Sink = Tee(sinks)
        if self.origin.any():
            sink = MovedBack(sink, self.origin)
        output = self.scene.output
        declared = DeclaredOutputs.of(output.quantities if output else ())
        recorder = Recorder(
            self.stepper,
            sink,
            self.monitors,
            choice=self._choice(),
            declared=declared,
            staged=bool(self.stages),
        )
        if stood is None:
            sink.begin(self.topology)
            first = self.stages[0].stage.scene if self.stages else self.scene
            recorder.frame(self.start, "load" if first.inertia is None else "dynamic", None)
        when = None if output is None else output.checkpoint
        checkpoints = Checkpoints(self.stepper, recorder, when, store)
        if self.stages:
            return self._in_stages(recorder, progress, checkpoints, stood)
        state, verdict = Drive(self, recorder, checkpoints, progress).run(stood)
        asked = self.scene, self.formulation
        summary = summed_up(
            self.identity(), recorder, self.start, state, verdict, asked, self.begun
        )
        sink.finish(self._told(beside_bound(summary, bound)))
        return state

    def _told(self, summary: Summary) -> Summary:
        """Return the summary with the factor of safety, where one was sought."""
        return summary if self.safety is None else self.safety.told(summary)

    def _compile_ahead(self) -> None:
        """Have the loops of contact compiled beside the run where it will call them."""
        stepper = self.stepper
        n = stepper.model.manifold.n_unknowns
        if stepper.plan.contact is not None and not stepper.solver.in_full(n):
            from nmm.stepping import kernels_ahead  # what only checks a scene compiles nothing

            kernels_ahead.begin()

    @property
    def topology(self) -> Topology:
        """The elements that frames belong to, at the start of the run."""
        return topology(self.stepper.discretisation.setup)

    def _model_of(self, stood: RunState) -> Model:
        """Return the model that was solved where a run stood."""
        setup, geometry = self.stepper.discretisation.setup, stood.carried.geometry
        if stood.stages is not None and self.stages:
            number = len(stood.stages.entered)
            if number >= len(self.stages):
                raise ValueError(f"it is of stage {number + 1} of {len(self.stages)}")
            setup = present_setup(self.stages, stood.stages.left)
        return setup.model if geometry is None else reshaped(setup, geometry).model

    def _in_stages(
        self,
        recorder: Recorder,
        progress: Progress,
        checkpoints: Checkpoints,
        stood: RunState | None,
    ) -> State:
        """Run one stage after the other; audits judge the last one by its own start."""
        rule = make_integrator(self.formulation.integrator)
        so_far, at = StagesSoFar(self.start), None
        if stood is not None and stood.stages is not None:
            so_far = stood.stages
            enter_again(self.stepper, so_far, self.stages, rule)
            present = self.stages[len(so_far.entered)].stage
            entered = checkpoints.entered(so_far, present.in_time)
            at = cast("InTime | UnderLoad", entered.go_on(stood))  # stages follow no path
        self.stepper.budget.taken = recorder.steps
        end = run_stages(
            self.stepper, recorder, so_far, self.stages, rule, progress, checkpoints.entered, at
        )
        asked = end.stage.scene, self.formulation
        summary = summed_up(
            self.identity(), recorder, end.start, end.state, end.verdict, asked, self.begun
        )
        energy = recorder.ledger.change_energy
        recorder.sink.finish(self._told(replace(summary, change_energy=energy)))
        return end.state

    def _failure_bound(self) -> float | None:
        """Return the load factor that no forces where the run begins can pass; None without one."""
        loading = self.scene.loading
        if self.scene.inertia is not None or loading is None or loading.until != "failure":
            return None
        begun = perf_counter()
        found = load_bound(self.stepper, self.start)
        self.stepper.seconds["bound"] = perf_counter() - begun
        factor = None if found is None else found.factor
        return factor if factor is not None and np.isfinite(factor) else None

    def _choice(self) -> FrameChoice:
        """Return which states are stored."""
        if not self.scene.in_time or self.scene.duration is None:
            return choice_under_loads(self.scene.output)
        return choice_in_time(self.scene.output, self.start.time, self.scene.duration)

    @property
    def storage(self) -> Storage:
        """How much the frames take, but for those of the motion after failure."""
        elements, duration = self.stepper.model.manifold.elements, self.scene.duration
        times = None
        if self.scene.in_time and duration is not None:
            times = duration, self.formulation.integrator.fixed_step
        return storage(self._choice(), times, len(elements.points), len(elements))


def _toml(model: "Scene | Formulation") -> str:
    import tomli_w

    if isinstance(model, Formulation):
        return tomli_w.dumps(as_tables(model))
    tables = model.model_dump(mode="json", by_alias=True, exclude_none=True)
    if model.formulation is not None:
        tables["formulation"] = as_tables(model.formulation)
    return tomli_w.dumps(tables)
