"""Steps in time: a step that does not converge is cut; one that cannot be cut ends the run."""

from collections.abc import Callable, Iterator, Sequence

from nmm.assembly.state import State
from nmm.effects.base import Instant
from nmm.errors import NmmError
from nmm.frozen import with_parts
from nmm.progress import Progress
from nmm.stepping.drive.changes import AcceptedState, asked, with_events
from nmm.stepping.drive.equilibrium.settling import SettledStep, may_be_loose, too_far
from nmm.stepping.drive.in_time import ROUNDED_TIME, InTime, Schedule
from nmm.stepping.drive.jumps import jumped
from nmm.stepping.drive.stable_step import longest_step, singular_mass
from nmm.stepping.drive.until_verdict import broken_off
from nmm.stepping.drive.verdict import CONVERGED, FAILED, SPENT, RunVerdict
from nmm.stepping.reports.recorder import Recorder
from nmm.stepping.step.budget import BudgetSpentError
from nmm.stepping.step.stepper import Stepper
from nmm.stepping.step.trial import Attempt
from nmm.stepping.step.unopposed import left_alone

# The state before the last attempt of a step, the attempt, how the run goes on, and why it was cut.
Taken = tuple[State, Attempt, InTime, str]
# A step is halved down to this power of two of the chosen step before the run is given up: 1/1024.
DEEPEST_HALVING = 10
# What to do where a step without inertia has no end: its next equilibrium may be a jump away.
WITHOUT_INERTIA = "; take longer steps, or add [inertia] to follow what moves"


def run_in_time(
    stepper: Stepper,
    recorder: Recorder,
    at: InTime,
    schedule: Schedule,
    progress: Progress,
    keep: Callable[[InTime], InTime] = lambda at: at,
    names: Sequence[str] = (),
) -> tuple[State, RunVerdict]:
    """Step on over the schedule's duration; ``keep`` is shown where every step but the last ends.

    ``names`` (N,) are those of the regions.

    Returns
    -------
    The last accepted state and the verdict.
    """
    verdict = _unstable(stepper, at.state, schedule)
    if schedule.control is not None:
        recorder.choosing()
    while verdict is None and at.rest(schedule):
        found = _next(stepper, recorder, at, schedule, progress, names)
        if isinstance(found, RunVerdict):
            verdict = found
        else:
            at = keep(found) if found.rest(schedule) else found
    recorder.last(at.state, schedule.stage, at.contacts)
    return at.state, verdict or _arrived(at)


def _unstable(stepper: Stepper, state: State, schedule: Schedule) -> RunVerdict | None:
    """Return why a step is too long for an explicit integrator; None where it is not."""
    if singular_mass(stepper):
        return RunVerdict(
            FAILED,
            "the mass is singular, as functions depend on one another: expected one that an "
            'explicit integrator can divide by: use [integrator] mass = "lumped"',
        )
    longest = longest_step(stepper, state)
    if schedule.step <= longest:
        return None
    return RunVerdict(
        FAILED,
        f"steps of {schedule.step:.3g} s grow without bound: expected at most {longest:.3g} s, the "
        "limit of the integrator over the highest frequency: take shorter steps, larger cells or "
        '[integrator] type = "newmark"',
    )


def _next(
    stepper: Stepper,
    recorder: Recorder,
    at: InTime,
    schedule: Schedule,
    progress: Progress,
    names: Sequence[str],
) -> InTime | RunVerdict:
    """Return where the next step ends, or why there is none."""
    take = _fixed if schedule.control is None else _by_error
    try:
        before, attempt, to, why = take(recorder, at, schedule)
        jump = None if attempt.converged else jumped(recorder, at, schedule, names)
    except BudgetSpentError as spent:
        return RunVerdict(SPENT, f"stopped at {at.state.time:.6g} s: {spent}")
    except NmmError as fault:
        return broken_off(recorder, f"{at.state.time:.6g} s", fault)
    if isinstance(jump, str):
        remedy = "" if stepper.plan.inertia is not None else WITHOUT_INERTIA
        return RunVerdict(FAILED, _failure(attempt, at.state, schedule) + jump + remedy)
    if jump is None:
        after, contacts = stepper.accept(attempt)
    else:
        before, attempt, why, contacts = jump.at, jump.found.attempt, jump.said, jump.found.contacts
        after, to = attempt.state, with_parts(at, step=schedule.step)
    stands = AcceptedState(after, contacts)
    events = asked(recorder, stands) if schedule.events else ()
    said = recorder.step(before, attempt, contacts, after)
    if why:
        taken = attempt.state.time - at.state.time
        to = to.with_cut(f"at {at.state.time:.6g} s: {why}")
        said = f"{said}  cut to {taken:.3g} s: {why}"
    recorder.offer(after, schedule.stage, contacts)
    stands = with_events(recorder, stands, events, schedule.stage)
    end = at.begin + schedule.duration
    parts = [f"time {after.time:.4g} s of {end:.4g} s", said, stands.what]
    text = "  ".join(filter(None, parts))
    progress((after.time - at.begin) / schedule.duration, text)
    return with_parts(to, state=stands.state, contacts=stands.contacts)


def _fixed(recorder: Recorder, at: InTime, schedule: Schedule) -> Taken:
    """Take a step of the length that was chosen, or shorter where it must be."""
    state, rest = at.state, at.rest(schedule)
    length = rest if rest < (1 + ROUNDED_TIME) * at.step else at.step
    attempt, why = _step_or_cut(recorder.stepper, state, length, schedule)
    taken = attempt.state.time - state.time
    # After a cut the step grows back slowly: what made it fail is rarely over at once.
    step = min(schedule.step, 2 * taken) if taken < schedule.step else schedule.step
    return state, attempt, with_parts(at, step=step), why


def _by_error(recorder: Recorder, at: InTime, schedule: Schedule) -> Taken:
    """Take a step as long as its error lets, in two halves; it ends where a frame is requested."""
    from nmm.stepping.adaptive.trial_step import TrialStep

    control, state = schedule.control, at.state
    assert control is not None
    assert at.chosen is not None
    stop = min(at.begin + schedule.duration, recorder.next_frame(state.time))
    trial = TrialStep(recorder, control, state, schedule.load_factor, schedule.stage)
    found = trial.take(at.chosen, at.step, stop)
    to = with_parts(at, step=found.next, chosen=found.chosen)
    return found.middle, found.second, to, found.cut


def _arrived(at: InTime) -> RunVerdict:
    sentence = f"every step to {at.state.time:.6g} s converged"
    if at.cuts:
        sentence += f", {at.cuts} of them cut; the last {at.why}"
    return RunVerdict(CONVERGED, sentence)


def _step_or_cut(
    stepper: Stepper, state: State, step: float, schedule: Schedule
) -> tuple[Attempt, str]:
    """Solve a step, shorter where it must be; and why, if it must."""
    why = ""
    for length in _halves(step, schedule.step / 2**DEEPEST_HALVING):
        end = Instant(state.time + length, schedule.load_factor)
        attempt = stepper.attempt(state, end, length)
        if not attempt.converged and _held_by_nothing(stepper, attempt):
            attempt = _anchored(stepper, state, end, length) or attempt
        if attempt.converged:
            break
        why = why or attempt.sentence
    return attempt, why


def _anchored(stepper: Stepper, state: State, end: Instant, length: float) -> Attempt | None:
    """Solve a step with anchors, which stay; None where that does not help.

    What is loaded goes far; what is not stays, and loads its anchors with rounding.
    """
    stepper.anchored = True
    attempt = stepper.attempt(state, end, length)
    stepper.anchored = attempt.converged and attempt.motion <= too_far(stepper)
    return attempt if stepper.anchored else None


def _held_by_nothing(stepper: Stepper, attempt: Attempt) -> bool:
    """Whether rounding moves a block that nothing touches, where there is no inertia."""
    still = stepper.plan.inertia is None
    return still and may_be_loose(stepper, SettledStep(attempt, None)) and left_alone(stepper)


def _halves(step: float, smallest: float) -> Iterator[float]:
    """Yield a step, however small, and its halves down to the smallest."""
    yield step
    while step / 2 >= smallest:
        step /= 2
        yield step


def _failure(attempt: Attempt, state: State, schedule: Schedule) -> str:
    control = schedule.control
    shortest = schedule.step / 2**DEEPEST_HALVING if control is None else control.shortest
    return (
        f"the step at {state.time:.6g} s did not converge, though cut to "
        f"{shortest:.3g} s: {attempt.sentence}"
    )
