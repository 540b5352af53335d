"""Stages in sequence: the discretisation changes between them, the state is carried over."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.assembly.state import State
from nmm.frozen import with_parts
from nmm.geometry.geometry import Geometry
from nmm.model.planning.out_of_balance import out_of_balance
from nmm.model.staging.stage_geometry import begun_with
from nmm.progress import Progress
from nmm.stepping.drive.changes import difference, follow
from nmm.stepping.drive.in_time import InTime, Schedule
from nmm.stepping.drive.phases import EndedRun, Keeps, Phases
from nmm.stepping.drive.under_load import LoadSchedule, UnderLoad
from nmm.stepping.drive.verdict import CONVERGED, RunVerdict
from nmm.stepping.reports.output import choice_in_time, choice_under_loads
from nmm.stepping.reports.recorder import Recorder
from nmm.stepping.step.stepper import Stepper

if TYPE_CHECKING:
    from nmm.effects.change import Change
    from nmm.integrators.base import Integrator
    from nmm.model.staging.stages import Stage, Staged


@dataclass(frozen=True)
class StagesSoFar:
    """Stages that were entered: what the next checkpoint needs to enter them again.

    Attributes
    ----------
    start
        The state at the start of the present stage.
    entered
        The states from which this stage and those before it were entered; none for the first.
    left
        The geometries with which the stages before it ended, None of one that no event changed.
    """

    start: State
    entered: tuple[State, ...] = ()
    left: tuple[Geometry | None, ...] = ()


StageKeeper = Callable[[StagesSoFar, bool], Keeps]
"""Told of the stages so far, and whether the present one is solved in time."""


@dataclass(frozen=True)
class StagesEnd:
    """Where stages ended: the last state, the start of its stage, and how."""

    state: State
    start: State
    stage: "Stage"
    verdict: RunVerdict


def run_stages(
    stepper: Stepper,
    recorder: Recorder,
    so_far: StagesSoFar,
    stages: "Sequence[Staged]",
    integrator: "Integrator",
    progress: Progress,
    keeper: StageKeeper,
    at: InTime | UnderLoad | None = None,
) -> StagesEnd:
    """Solve stages until one fails, from the start of the first one or from where one stands.

    ``keeper`` is told of each stage that is entered; ``at`` is where the present one stands, None
    at its start.
    """
    state, sentence = so_far.start, ""
    for number in range(len(so_far.entered), len(stages)):  # a handful of stages
        staged, stage = stages[number], stages[number].stage
        if number > len(so_far.entered):
            entered, left = (*so_far.entered, state), (*so_far.left, stepper.geometry)
            state = enter(stepper, recorder, state, staged, integrator)
            so_far = StagesSoFar(state, entered, left)

        def told(share: float, text: str, number: int = number) -> None:
            name = stages[number].stage.name
            progress((number + share) / len(stages), f"stage {name}: {text}")

        keep = keeper(so_far, stage.in_time)
        state, verdict = _solved(stepper, recorder, so_far.start, staged, told, keep, at)
        at, sentence = None, f"stage {stage.name}: {verdict.sentence}"
        if verdict.code != CONVERGED:
            verdict = replace(verdict, sentence=sentence)
            return StagesEnd(state, so_far.start, stage, verdict)
    verdict = RunVerdict(CONVERGED, f"{len(stages)} stages; {sentence}")
    return StagesEnd(state, so_far.start, stage, verdict)


def enter(
    stepper: Stepper, recorder: Recorder, state: State, staged: "Staged", integrator: "Integrator"
) -> State:
    """Solve what the stage has from now on, tell what changed; return the state carried over."""
    with stepper.clock.phase("stages"):
        change = _entered(stepper, state, staged, integrator)
    before = recorder.ledger.change_energy
    follow(recorder, change, reset=staged.stage.reset, unheld=_unheld(stepper, change))
    added = recorder.ledger.change_energy - before
    said = f"stage {staged.stage.name} at {state.time:.6g}: {difference(change)}, {added:.6g} J"
    changes = (*recorder.totals.changes, said)
    recorder.totals = with_parts(recorder.totals, taken=0, periods=0, changes=changes)
    return change.state


def _unheld(stepper: Stepper, change: "Change") -> Floats | None:
    """Return what blocks that left or came leave out of balance at rest (n,) in N.

    None in motion, and where multipliers hold what moves: their forces are no part of the state.
    """
    plan, kinematics = stepper.plan, stepper.kinematics
    driven = plan.supports is not None and plan.supports.multipliers and not plan.supports.steady
    if plan.inertia is not None or kinematics.finite or driven:
        return None
    return out_of_balance(plan, change)


def enter_again(
    stepper: Stepper, so_far: StagesSoFar, stages: "Sequence[Staged]", integrator: "Integrator"
) -> None:
    """Enter the stages of a run that was stopped, of which all is known that was recorded."""
    ways = zip(so_far.entered, so_far.left, stages[1:], strict=False)
    for state, left, staged in ways:  # a handful of stages
        if left is not None:
            stepper.reshape(left, stepper.discretisation.setup.start)
        _entered(stepper, state, staged, integrator)


def _entered(
    stepper: Stepper, state: State, staged: "Staged", integrator: "Integrator"
) -> "Change":
    """Let the stepper solve what the stage has; return the change."""
    stage, old = staged.stage, stepper.discretisation
    still = np.zeros_like(state.velocity)
    if stage.dynamic:
        state = replace(state, load_factor=1.0)
    else:
        state = replace(state, load_factor=0.0, velocity=still, acceleration=still)
    change = old.change(begun_with(staged, old.setup.geometry), state)
    if stage.scene.initial_velocities and stage.sets_out.any():
        from nmm.effects.initial.initial_velocity import setting_out

        change = replace(change, state=setting_out(change.setup, change.state, stage.sets_out))
    stepper.begin_anew(change, integrator)
    return change


def _solved(
    stepper: Stepper,
    recorder: Recorder,
    state: State,
    staged: "Staged",
    progress: Progress,
    keeps: Keeps,
    at: InTime | UnderLoad | None,
) -> EndedRun:
    """Solve one stage, in time or to rest, from its start or from where it stands."""
    stage, output, steps = staged.stage, staged.stage.scene.output, staged.stage.formulation
    phases = Phases(stepper, recorder, progress, staged.setup.region_name, keeps)
    begin, followed = state.time, stage.scene.followed
    # What is new comes on, where a clock runs, while it stands.
    loads = LoadSchedule.brought_on(steps.loading, begin, staged.clock, followed)
    if stage.duration is None:
        recorder.choice = choice_under_loads(output)
        return phases.under_loads(state, loads, at)
    recorder.choice = choice_in_time(output, begin, stage.duration)
    times = Schedule.of(stepper, steps, stage.duration)
    if stage.dynamic:
        return phases.in_time(state, times, at)
    return phases.in_balance(state, loads, times, at)
