"""The motion of a structure that has failed, under the load that it did not carry."""

from dataclasses import replace
from time import perf_counter
from typing import TYPE_CHECKING

from nmm.assembly.state import State
from nmm.formulation import Formulation
from nmm.integrators.base import make_integrator
from nmm.progress import Progress
from nmm.results.tee import FramesOnly
from nmm.stepping.drive.dynamics import run_in_time
from nmm.stepping.drive.in_time import InTime, Schedule
from nmm.stepping.drive.verdict import RunVerdict
from nmm.stepping.reports.output import FRAMES_AFTER_FAILURE, choice_in_time
from nmm.stepping.reports.recorder import Recorder
from nmm.stepping.reports.totals import Totals
from nmm.stepping.step.stepper import Stepper

if TYPE_CHECKING:
    from nmm.scene.model import Scene


def show_failure(
    recorder: Recorder,
    scene: "Scene",
    formulation: Formulation,
    state: State,
    verdict: RunVerdict,
    duration: float,
    progress: Progress,
) -> None:
    """Let a structure move from its last state; only frames are kept, at times of their own.

    Parameters
    ----------
    duration
        How long it moves (s).
    """
    from nmm.effects.inertia import Inertia

    stepper = recorder.stepper
    moves = stepper.kinematics.let_go
    quiet = Stepper(
        stepper.discretisation.joined(Inertia(stepper.model, moves.turns)),
        make_integrator(formulation.integrator),
        stepper.solver,
        moves,
    )
    quiet.budget = stepper.budget
    factor = (verdict.load_factor or 0.0) * (1 + 2 * (verdict.tolerance or 0.0))
    times = Schedule.of(quiet, formulation, duration, factor, "failure", events=False)
    shown = FramesOnly(recorder.sink)
    asked = choice_in_time(scene.output, state.time, duration, FRAMES_AFTER_FAILURE)
    known = Totals(frames=recorder.totals.frames)
    moving = replace(recorder, stepper=quiet, sink=shown, choice=asked, totals=known)
    begun = perf_counter()
    begin = InTime.at_start(replace(state, load_factor=factor), times)
    run_in_time(quiet, moving, begin, times, progress)
    stepper.seconds["motion after failure"] = perf_counter() - begun
    recorder.totals = replace(recorder.totals, frames=moving.totals.frames)
