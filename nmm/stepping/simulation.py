"""A scene and a formulation, compiled: geometry, covers, effects, solver; ready to run."""

import resource
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING

import numpy as np

from covers.approximation.block_manifold import block_manifold
from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.assembly.motion import State
from nmm.errors import FormulationError
from nmm.formulation import Formulation, formulation_hash
from nmm.geometry.checks.amounts import refuse_many_cells
from nmm.geometry.regions import regions as build_regions
from nmm.geometry.tessellation.cover_types import block_cover
from nmm.integrators.base import make_integrator
from nmm.model.build import block_functions, geometry_of, reshaped, setup_of
from nmm.model.consistency import check_kinematics, check_together
from nmm.model.discretisation import Discretisation
from nmm.model.fault_places import placed
from nmm.model.origin import MovedBack, own_origin, shifted, shifted_regions
from nmm.model.parts import check_parts
from nmm.model.plan import Plan, compile_plan
from nmm.model.solver_settings import cures, solver_for, warnings
from nmm.model.stages import Stage, stages_of
from nmm.results.frame import Topology
from nmm.results.sink import Sink
from nmm.results.storage import files
from nmm.results.storage.checkpoint import damaged
from nmm.results.storage.run_folder import RunFolder, checkpoint_header
from nmm.results.storage.values import Arrays
from nmm.results.summary import Safety, Summary
from nmm.results.tee import FramesOnly, Tee
from nmm.scene import scene_hash
from nmm.stepping.audits.base import Ended
from nmm.stepping.audits.judge import audit, judged
from nmm.stepping.checkpoints import Checkpoints
from nmm.stepping.drive.changes import refuse_events, topology
from nmm.stepping.drive.dynamics import InTime, Schedule, run_in_time
from nmm.stepping.drive.stages import Staged, StagesSoFar, enter_again, run_stages
from nmm.stepping.drive.static_theorem import load_bound
from nmm.stepping.drive.statics import Beyond, LoadSchedule, UnderLoad, run_load
from nmm.stepping.drive.verdict import CONVERGED, FAILURE, RunVerdict
from nmm.stepping.reports.declared import Declared
from nmm.stepping.reports.output import (
    FRAMES_AFTER_FAILURE,
    Choice,
    Storage,
    choice_in_time,
    choice_under_loads,
    storage,
)
from nmm.stepping.reports.recorder import Monitor, Recorder, Totals, monitors
from nmm.stepping.run_state import RunState
from nmm.stepping.step.budget import Budget
from nmm.stepping.step.remap import Lay, check_remap
from nmm.stepping.step.stepper import Stepper, scaled_load

if TYPE_CHECKING:
    from nmm.geometry.blocks import Regions
    from nmm.scene.model import Scene

Progress = Callable[[float, str], None]


@dataclass(frozen=True)
class Simulation:
    """A scene and a formulation, compiled and ready to run.

    Attributes
    ----------
    scene, formulation, regions
        What is run.
    stepper
        Model, effects and solver.
    start
        State at the start.
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
    at_once
        Whether statics of loads in full tries no smaller increments of them.
    """

    scene: "Scene"
    formulation: Formulation
    regions: "Regions"
    stepper: Stepper
    start: State
    monitors: list[Monitor]
    begun: float
    origin: Floats
    stages: Sequence[Staged] = ()
    safety: Safety | None = None
    at_once: bool = False

    def folder(self, path: Path) -> RunFolder:
        """Return the run folder at ``path`` with scene and formulation as run."""
        return RunFolder(
            path,
            scene=_toml(self.scene),
            formulation=_toml(self.formulation),
            summary=self.identity(),
        )

    def reopened(self, path: Path) -> tuple[RunFolder, RunState]:
        """Return the run folder at ``path`` as it was at its checkpoint, and where it stood.

        Raises
        ------
        StorageError, DamageError
            See `RunFolder.reopened`.
        """
        known = self.identity()
        folder, arrays = RunFolder.reopened(path, known, checkpoint_header(known))
        try:
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
        bound = self._failure_bound()
        sink: Sink = Tee(sinks)
        if self.origin.any():
            sink = MovedBack(sink, self.origin)
        output = self.scene.output
        declared = Declared.of(output.quantities if output else ())
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
        asked = None if output is None else output.checkpoint
        checkpoints = Checkpoints(self.stepper, recorder, asked, store)
        if self.stages:
            return self._in_stages(recorder, progress, checkpoints, stood)
        state, verdict = self._advance(recorder, progress, checkpoints, stood)
        summary = self._summary(recorder, state, verdict)
        if self.safety is not None:
            summary = self.safety.told(summary)
        sink.finish(replace(summary, failure_bound=bound))
        return state

    @property
    def topology(self) -> Topology:
        """The elements that frames belong to, at the start of the run."""
        return topology(self.stepper.discretisation.setup)

    def _model_of(self, stood: RunState) -> Model:
        """Return the model that was solved where a run stood."""
        if stood.carried.geometry is not None:
            return reshaped(self.stepper.discretisation.setup, stood.carried.geometry).model
        if stood.stages is None or not self.stages:
            return self.stepper.model
        number = len(stood.stages.entered)
        if number >= len(self.stages):
            raise ValueError(f"it is of stage {number + 1} of {len(self.stages)}")
        return self.stages[number].setup.model

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
            enter_again(self.stepper, recorder, so_far, self.stages, rule)
            present = self.stages[len(so_far.entered)].stage
            at = checkpoints.entered(so_far, present.dynamic).go_on(stood)
        self.stepper.budget.taken = recorder.steps
        end = run_stages(
            self.stepper, recorder, so_far, self.stages, rule, progress, checkpoints.entered, at
        )
        last = replace(self, scene=end.stage.scene, start=end.start)
        summary = last._summary(recorder, end.state, end.verdict)
        known = self.identity()
        summary = replace(
            summary,
            scene_hash=known.scene_hash,
            formulation_hash=known.formulation_hash,
            change_energy=recorder.ledger.change_energy,
            changes=[*end.changes, *recorder.totals.changes],
        )
        recorder.sink.finish(summary)
        return end.state

    def _failure_bound(self) -> float | None:
        """Return the load factor that no run until failure can pass; None where there is none."""
        loading = self.scene.loading
        if self.scene.inertia is not None or loading is None or loading.until != "failure":
            return None
        begun = perf_counter()
        found = load_bound(self.stepper, self.start)
        self.stepper.seconds["bound"] = perf_counter() - begun
        factor = None if found is None else found.factor
        return factor if factor is not None and np.isfinite(factor) else None

    def _advance(
        self,
        recorder: Recorder,
        progress: Progress,
        checkpoints: Checkpoints,
        stood: RunState | None,
    ) -> tuple[State, RunVerdict]:
        stepper, scene = self.stepper, self.scene
        checkpoints.counting(self.start.time, scene.in_time)
        at = None if stood is None else checkpoints.go_on(stood)
        stepper.budget.taken = recorder.steps
        if scene.inertia is not None:
            assert scene.duration is not None
            times = Schedule(scene.duration, self.formulation.integrator.step)
            begun = at or checkpoints.begin(InTime.at_start(self.start, times))
            assert isinstance(begun, InTime)
            return run_in_time(stepper, recorder, begun, times, progress, checkpoints.keep)
        if scene.in_time:
            return self._creep(recorder, progress, checkpoints, at)
        loads = self._load_schedule()
        if scene.loading is not None and scene.loading.control is not None:
            from nmm.stepping.control.following import run_path
            from nmm.stepping.control.making import control_of
            from nmm.stepping.control.position import PathEnd

            control = control_of(scene.loading.control, self.stepper, self.formulation)
            end = PathEnd(loads.target, scene.loading.control.fall)
            return run_path(stepper, recorder, self.start, control, end, progress)
        under = at or checkpoints.begin(UnderLoad.at_start(self.start, loads))
        assert isinstance(under, UnderLoad)
        if scene.fracture is not None and scene.fracture.control == "toughness":
            from nmm.stepping.drive.growth import run_growth

            return run_growth(stepper, recorder, under, loads, progress, checkpoints.keep)
        state, verdict = run_load(
            stepper,
            recorder,
            under,
            loads,
            progress,
            self.regions.name,
            checkpoints.keep,
            self._beyond(),
        )
        loading = scene.loading
        if verdict.code == FAILURE and loading is not None and loading.motion_after_failure:
            self._show_failure(recorder, state, verdict, loading.motion_after_failure, progress)
        return state, verdict

    def _beyond(self) -> Beyond:
        """Return what looks for limit points; it sees none where paths cannot be followed."""
        if self.stepper.plan.contact is None:
            return lambda state, factor: None
        from nmm.stepping.control.limit_point import limit_point
        from nmm.stepping.control.making import hindrances

        if hindrances(self.stepper, self.formulation):
            return lambda state, factor: None
        return partial(limit_point, self.stepper)

    def _creep(
        self,
        recorder: Recorder,
        progress: Progress,
        checkpoints: Checkpoints,
        at: InTime | UnderLoad | None,
    ) -> tuple[State, RunVerdict]:
        """Bring the loads on while the clock stands; then let time pass, in equilibrium."""
        scene, stepper, asked = self.scene, self.stepper, self.formulation.loading
        assert scene.duration is not None
        times = Schedule(scene.duration, self.formulation.integrator.step, stage="creep")
        if not isinstance(at, InTime):
            increment = asked.increment if "increment" in asked.model_fields_set else 1.0
            begin = self.start.time
            loads = LoadSchedule(1.0, False, increment, asked.tolerance, begin, stops=True)
            under = at or checkpoints.begin(UnderLoad.at_start(self.start, loads))
            state, verdict = run_load(
                stepper, recorder, under, loads, progress, self.regions.name, checkpoints.keep
            )
            if verdict.code != CONVERGED:
                return state, verdict
            at = checkpoints.begin(InTime.at_start(state, times))
        return run_in_time(stepper, recorder, at, times, progress, checkpoints.keep)

    def _show_failure(
        self,
        recorder: Recorder,
        state: State,
        verdict: RunVerdict,
        duration: float,
        progress: Progress,
    ) -> None:
        """Let the failed structure move under the load it did not carry; only frames are kept."""
        from nmm.effects.inertia import Inertia

        moves = self.stepper.kinematics.let_go
        quiet = Stepper(
            self.stepper.discretisation.joined(Inertia(self.stepper.model, moves.turns)),
            make_integrator(self.formulation.integrator),
            self.stepper.solver,
            moves,
        )
        quiet.budget = self.stepper.budget
        factor = (verdict.load_factor or 0.0) * (1 + 2 * (verdict.tolerance or 0.0))
        times = Schedule(duration, self.formulation.integrator.step, factor, "failure", False)
        shown = FramesOnly(recorder.sink)
        asked = choice_in_time(self.scene.output, state.time, duration, FRAMES_AFTER_FAILURE)
        known = Totals(frames=recorder.totals.frames)
        moving = replace(recorder, stepper=quiet, sink=shown, choice=asked, totals=known)
        begun = perf_counter()
        begin = InTime.at_start(replace(state, load_factor=factor), times)
        run_in_time(quiet, moving, begin, times, progress)
        self.stepper.seconds["motion after failure"] = perf_counter() - begun
        recorder.totals = replace(recorder.totals, frames=moving.totals.frames)

    def _choice(self) -> Choice:
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
            times = duration, self.formulation.integrator.step
        return storage(self._choice(), times, len(elements.points), len(elements))

    def _load_schedule(self) -> LoadSchedule:
        loading, steps = self.scene.loading, self.formulation.loading
        if loading is None:
            increment = steps.increment if self.scene.followed else 1.0
            return LoadSchedule(1.0, False, increment, steps.tolerance, at_once=self.at_once)
        until = loading.until == "failure"
        target = loading.maximum_factor or (np.inf if until else float(loading.until))
        return LoadSchedule(target, until, steps.increment, steps.tolerance)

    def identity(self) -> Summary:
        """Return what is known of the run before it begins."""
        seeds = [item.seed for item in self.scene.tessellations if item.seed is not None]
        return Summary(
            title=self.scene.title,
            blocks=len(self.regions.polygons),
            elements=len(self.stepper.model.manifold.elements),
            covers=self.stepper.model.manifold.n_covers,
            unknowns=self.stepper.model.manifold.n_unknowns,
            linear_solver=self.stepper.solver.describe(self.stepper.model.manifold.n_unknowns),
            cures=cures(
                self.stepper.model.manifold, self.stepper.solver, self.stepper.plan.supports
            ),
            warnings=warnings(self.stepper.model),
            seed=seeds[0] if seeds else self.scene.seed,
            scene_hash=scene_hash(self.scene),
            formulation_hash=formulation_hash(self.formulation),
        )

    def _summary(self, recorder: Recorder, state: State, verdict: RunVerdict) -> Summary:
        stepper, totals = self.stepper, recorder.totals
        condition = stepper.condition(state)
        scene, formulation = self.scene, self.formulation
        start = totals.since or self.start
        findings = audit(
            Ended(scene, formulation, stepper, recorder, start, state, verdict, condition)
        )
        verdict, known = judged(verdict, findings), self.identity()
        growth = stepper.plan.fracture
        load = None if verdict.load_factor is None else scaled_load(stepper, verdict.load_factor)
        return replace(
            known,
            warnings=[*known.warnings, *(one.sentence for one in findings if one.warns)],
            audits={one.name: one.value for one in findings},
            status=verdict.code,
            sentence=verdict.sentence,
            steps=recorder.steps,
            passes=totals.passes,
            frames=totals.frames,
            seconds=_with_rest(stepper.seconds, perf_counter() - self.begun),
            effect_seconds=dict(stepper.plan.seconds),
            peak_memory=resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024,
            equilibrium_residual=totals.residual,
            largest_penetration=totals.penetration,
            energy_balance=totals.ledger.balance,
            condition_estimate=condition,
            failure_load=load,
            failure_factor=verdict.load_factor,
            failure_tolerance=verdict.tolerance,
            largest_contacts=dict(totals.largest),
            change_energy=totals.ledger.change_energy if totals.changes else None,
            changes=list(totals.changes),
            fracture_energy=None if growth is None else growth.energy_taken,
            freed_energy=None if growth is None else totals.ledger.freed(growth.name),
        )


def prepare(scene: "Scene", formulation: Formulation) -> Simulation:
    """Build geometry, covers, effects and solver of a run.

    Raises
    ------
    NmmError
        When the two cannot be run; with the lines of the files that it is about.
    """
    with placed(scene, formulation):
        return _prepared(scene, formulation)


def _prepared(scene: "Scene", formulation: Formulation) -> Simulation:
    begun = perf_counter()
    regions = build_regions(scene)
    check_together(scene, formulation)
    check_parts(scene, formulation)
    cover = formulation.cover
    refuse_many_cells(regions, cover, formulation.source.place("cover", "size"))
    asked, origin = (scene, formulation), own_origin(regions.polygons.points)
    if origin.any():
        regions = shifted_regions(regions, -origin)
        scene, formulation = shifted(scene, -origin), shifted(formulation, -origin)
    stages = [
        _staged(scene, one, regions, origin)
        for one in stages_of(scene, formulation, regions, origin)
    ]
    whole = geometry_of(scene, regions)
    setup = stages[0].setup if stages else setup_of(scene, formulation, whole, origin)
    model, start, built = setup.model, setup.start, perf_counter()
    check_kinematics(formulation, setup.kinematics)
    discretisation = Discretisation.of(setup)
    for later in stages[1:]:
        compile_plan(later.setup)  # its faults are told before anything is solved
    plan = discretisation.plan
    refuse_events(scene, plan)
    stepper = Stepper(
        discretisation,
        make_integrator(formulation.integrator),
        solver_for(model.manifold, formulation.solver, plan.contact is not None),
        setup.kinematics,
        lay=_lay(formulation, model, plan),
    )
    limits = formulation.loading
    stepper.budget = Budget(limits.budget, limits.max_steps, begun)
    stepper.seconds["covers"] = built - begun
    stepper.seconds["effects"] = perf_counter() - built
    watched = monitors(setup, all_there=not stages)
    return Simulation(*asked, regions, stepper, plan.begin(start), watched, begun, origin, stages)


def _staged(scene: "Scene", stage: Stage, regions: "Regions", origin: Floats) -> Staged:
    """Return a stage with its own model; blocks keep their numbers and names."""
    check_parts(stage.scene, stage.formulation)
    cover, place = stage.formulation.cover, scene.source.place("stages")
    refuse_many_cells(regions, cover, place)
    geometry = geometry_of(scene, regions.only(stage.present))
    setup = setup_of(stage.scene, stage.formulation, geometry, origin)
    whole = replace(
        setup,
        region_name=tuple(regions.name),
        region_material=np.asarray(regions.material),
        acting=stage.acting,
    )
    return Staged(stage, whole, clock=scene.inertia is not None)


def _lay(formulation: Formulation, model: Model, plan: Plan) -> Lay | None:
    """Return what lays blocks anew each step when the classical update is asked for."""
    if formulation.rotation.update != "linear":
        return None
    check_remap(plan)
    if model.matter is not None:
        raise FormulationError(
            '[rotation] update: "linear": with a material that is not linear: expected elastic '
            'materials: blocks laid anew forget their strain: use update = "exact"'
        )
    functions = block_functions(formulation.cover)
    kind = block_cover(formulation.cover)
    if kind is None or kind.divides or functions.degree > 1:
        raise FormulationError(
            '[rotation] update: "linear": it lays blocks of linear functions anew: expected '
            'cover type "block" of degree 1: use update = "exact"'
        )
    return lambda polygons: block_manifold(polygons, model.manifold.element_region, functions)


def _toml(model: "Scene | Formulation") -> str:
    import tomli_w

    return tomli_w.dumps(model.model_dump(mode="json", by_alias=True, exclude_none=True))


def _with_rest(seconds: dict[str, float], total: float) -> dict[str, float]:
    """Return seconds by phase with what no phase has counted, so that they sum to the total."""
    return {**seconds, "rest": max(total - sum(seconds.values()), 0.0)}
