"""Steps in time: a step that does not converge is cut; one that cannot be cut ends the run."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

from nmm.assembly.motion import State
from nmm.effects.base import Instant
from nmm.stepping.drive.verdict import CONVERGED, FAILED, SPENT, RunVerdict
from nmm.stepping.reports.recorder import Recorder
from nmm.stepping.step.budget import BudgetSpentError
from nmm.stepping.step.stepper import Stepper
from nmm.stepping.step.trial import Attempt

# Of a step, about what sums of many steps are off by: 20 000 steps are 20 000, not one more of
# 1e-12 s at the end.
ROUNDING = 1e-6
# A step is halved down to this power of two of the chosen step before the run is given up: 1/1024.
CUTS = 10


@dataclass(frozen=True)
class Schedule:
    """Times of a dynamic run.

    Attributes
    ----------
    duration, step
        s.
    load_factor
        Factor on the scaled loads, constant in dynamics.
    stage
        Name of the frames' stage.
    """

    duration: float
    step: float
    load_factor: float = 1.0
    stage: str = "dynamic"


def run_in_time(
    stepper: Stepper,
    recorder: Recorder,
    state: State,
    schedule: Schedule,
    progress: Callable[[float, str], None],
) -> tuple[State, RunVerdict]:
    """Step from ``state`` over the schedule's duration.

    Returns
    -------
    The last accepted state and the verdict.
    """
    begin, end = state.time, state.time + schedule.duration
    step, contacts, cuts, last = schedule.step, None, 0, ""
    while state.time < end - ROUNDING * schedule.step:
        rest = end - state.time
        length = rest if rest < (1 + ROUNDING) * step else step
        try:
            attempt, why = _step_or_cut(stepper, state, length, schedule)
        except BudgetSpentError as spent:
            recorder.last(state, schedule.stage, contacts)
            return state, RunVerdict(SPENT, f"stopped at {state.time:.6g} s: {spent}")
        if not attempt.converged:
            recorder.last(state, schedule.stage, contacts)
            return state, RunVerdict(FAILED, _failure(attempt, state, schedule))
        taken = attempt.state.time - state.time
        after, contacts = stepper.accept(attempt)
        said = recorder.step(state, attempt, contacts, after)
        if why:
            cuts, last = cuts + 1, f"at {state.time:.6g} s: {why}"
            said = f"{said}  cut to {taken:.3g} s: {why}"
        state = after
        # After a cut the step grows back slowly: what made it fail is rarely over at once.
        step = min(schedule.step, 2 * taken) if taken < schedule.step else schedule.step
        share = (state.time - begin) / schedule.duration
        if recorder.takes(state):
            recorder.frame(state, schedule.stage, contacts)
        progress(share, "  ".join([f"time {state.time:.4g} s of {end:.4g} s", said]).rstrip())
    recorder.last(state, schedule.stage, contacts)
    sentence = f"every step to {state.time:.6g} s converged"
    if cuts:
        sentence += f", {cuts} of them cut; the last {last}"
    return state, RunVerdict(CONVERGED, sentence)


def _step_or_cut(
    stepper: Stepper, state: State, step: float, schedule: Schedule
) -> tuple[Attempt, str]:
    """Solve a step, shorter where it must be; and why, if it must."""
    why = ""
    for length in _halves(step, schedule.step / 2**CUTS):
        end = Instant(state.time + length, schedule.load_factor)
        attempt = stepper.attempt(state, end, length)
        if attempt.converged:
            break
        why = why or attempt.sentence
    return attempt, why


def _halves(step: float, smallest: float) -> Iterator[float]:
    """Yield a step, though it be small, and its halves down to the smallest."""
    yield step
    while step / 2 >= smallest:
        step /= 2
        yield step


def _failure(attempt: Attempt, state: State, schedule: Schedule) -> str:
    return (
        f"the step at {state.time:.6g} s did not converge, though cut to "
        f"{schedule.step / 2**CUTS:.3g} s: {attempt.sentence}"
    )
