"""One stage after the other: what is solved changes between them, and the state is carried over."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from nmm.assembly.motion import State
from nmm.model.solver_settings import solver_for
from nmm.results.frame import Topology
from nmm.stepping.drive.dynamics import InTime, Schedule, run_in_time
from nmm.stepping.drive.statics import LoadSchedule, UnderLoad, run_load
from nmm.stepping.drive.verdict import CONVERGED, RunVerdict
from nmm.stepping.reports.output import choice_in_time, choice_under_loads
from nmm.stepping.reports.recorder import Recorder, monitors
from nmm.stepping.step.stepper import Stepper

if TYPE_CHECKING:
    from nmm.effects.base import Setup
    from nmm.effects.change import Change
    from nmm.integrators.base import Integrator
    from nmm.model.stages import Stage

Progress = Callable[[float, str], None]


@dataclass(frozen=True)
class Staged:
    """A stage with what its effects are built from.

    ``clock`` says whether its scene has a clock, which stands while a stage comes to rest.
    """

    stage: "Stage"
    setup: "Setup"
    clock: bool


@dataclass(frozen=True)
class StagesEnd:
    """Where stages ended: the last state, the start of its stage, and how."""

    state: State
    start: State
    stage: "Stage"
    verdict: RunVerdict
    changes: Sequence[str]


def run_stages(
    stepper: Stepper,
    recorder: Recorder,
    state: State,
    stages: Sequence[Staged],
    integrator: "Integrator",
    progress: Progress,
) -> StagesEnd:
    """Solve stages from ``state``, which is the start of the first one, until one fails."""
    changes: list[str] = []
    for number, staged in enumerate(stages):
        stage = staged.stage
        if number:
            state, said = enter(stepper, recorder, state, staged, integrator)
            changes.append(said)

        def told(share: float, text: str, number: int = number) -> None:
            name = stages[number].stage.name
            progress((number + share) / len(stages), f"stage {name}: {text}")

        start = state
        state, verdict = _solved(stepper, recorder, state, staged, told)
        sentence = f"stage {stage.name}: {verdict.sentence}"
        if verdict.code != CONVERGED:
            return StagesEnd(state, start, stage, replace(verdict, sentence=sentence), changes)
    sentence = f"{len(stages)} stages; {sentence}"
    return StagesEnd(state, start, stage, RunVerdict(CONVERGED, sentence), changes)


def enter(
    stepper: Stepper, recorder: Recorder, state: State, staged: Staged, integrator: "Integrator"
) -> tuple[State, str]:
    """Solve what the stage has from now on; return the state carried over, and what changed."""
    stage, old = staged.stage, stepper.discretisation
    still = np.zeros_like(state.velocity)
    if stage.dynamic:
        state = replace(state, load_factor=1.0)
    else:
        state = replace(state, load_factor=0.0, velocity=still, acceleration=still)
    change = old.change(staged.setup, state)
    new = old.after(change)
    solver = solver_for(change.new.manifold, stage.formulation.solver)
    stepper.begin_anew(change, new, solver, integrator)
    before = recorder.ledger.change_energy
    follow(recorder, change)
    added = recorder.ledger.change_energy - before
    if not _same_elements(change):
        recorder.sink.begin(topology(staged.setup))
    return change.state, f"stage {stage.name} at {state.time:.6g}: {_what(change)}, {added:.6g} J"


def follow(recorder: Recorder, change: "Change") -> None:
    """Record the new model from now on: its monitors, and what the change did to the energies."""
    recorder.monitors = monitors(change.setup, all_there=False)
    stepper, totals = recorder.stepper, recorder.totals
    ledger = totals.ledger.changed(stepper.plan, stepper.model, change.state)
    recorder.totals = replace(totals, ledger=ledger, taken=0, periods=0)


def topology(setup: "Setup") -> Topology:
    """Return the elements of a model as frames need them."""
    manifold = setup.model.manifold
    return Topology(
        elements=manifold.elements,
        element_region=manifold.element_region,
        region_material=np.asarray(setup.region_material, dtype=np.int64),
        material_names=tuple(setup.scene.materials),
        region_names=setup.region_name,
    )


def _solved(
    stepper: Stepper,
    recorder: Recorder,
    state: State,
    staged: Staged,
    progress: Progress,
) -> tuple[State, RunVerdict]:
    """Solve one stage, in time or to rest."""
    stage, output, steps = staged.stage, staged.stage.scene.output, staged.stage.formulation
    if stage.duration is not None:
        recorder.choice = choice_in_time(output, state.time, stage.duration)
        times = Schedule(stage.duration, steps.integrator.step)
        return run_in_time(stepper, recorder, InTime.at_start(state, times), times, progress)
    recorder.choice = choice_under_loads(output)
    asked = steps.loading
    # What is new is brought on at once unless increments are asked for.
    increment = asked.increment if "increment" in asked.model_fields_set else 1.0
    loads = LoadSchedule(1.0, False, increment, asked.tolerance, state.time, staged.clock)
    names, under = staged.setup.region_name, UnderLoad.at_start(state, loads)
    return run_load(stepper, recorder, under, loads, progress, names)


def _same_elements(change: "Change") -> bool:
    old, new = change.old.manifold, change.new.manifold
    return (
        np.array_equal(old.elements.points, new.elements.points)
        and np.array_equal(old.elements.ring_offsets, new.elements.ring_offsets)
        and np.array_equal(old.element_region, new.element_region)
    )


def _what(change: "Change") -> str:
    """Say what changed: blocks and unknowns."""
    old, new = (set(m.manifold.element_region.tolist()) for m in (change.old, change.new))
    said = [f"{len(old - new)} blocks removed"] if old - new else []
    said += [f"{len(new - old)} blocks added"] if new - old else []
    before, after = change.old.manifold.n_unknowns, change.new.manifold.n_unknowns
    return ", ".join([*said, f"{after} unknowns after {before}"])
