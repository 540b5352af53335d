"""Steps in time: a step that does not converge is cut; one that cannot be cut ends the run."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from nmm.assembly.motion import State
from nmm.effects.base import Instant
from nmm.progress import Progress
from nmm.stepping.drive.changes import Stands, asked, with_events
from nmm.stepping.drive.stable_step import longest_step, singular_mass
from nmm.stepping.drive.verdict import CONVERGED, FAILED, SPENT, RunVerdict
from nmm.stepping.reports.recorder import Recorder
from nmm.stepping.step.budget import BudgetSpentError
from nmm.stepping.step.stepper import Stepper
from nmm.stepping.step.trial import Attempt

if TYPE_CHECKING:
    from nmm.contact.points.contact_points import ContactPoints

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
    events
        Whether effects may change what is solved.
    """

    duration: float
    step: float
    load_factor: float = 1.0
    stage: str = "dynamic"
    events: bool = True


@dataclass(frozen=True)
class InTime:
    """Where a run in time stands.

    Attributes
    ----------
    state, contacts
        The last accepted state, and its contacts as left.
    begin
        Time at which the run began (s).
    step
        Length of the next step, before it is cut (s).
    cuts, why
        Number of steps that were cut so far, and when and why the last one was.
    """

    state: State
    contacts: "ContactPoints | None"
    begin: float
    step: float
    cuts: int = 0
    why: str = ""

    @classmethod
    def at_start(cls, state: State, schedule: Schedule) -> "InTime":
        """Return the start of a run from ``state``."""
        return cls(state, None, state.time, schedule.step)

    def rest(self, schedule: Schedule) -> float:
        """Return the time that is left (s); zero at the end."""
        rest = self.begin + schedule.duration - self.state.time
        return rest if rest > ROUNDING * schedule.step else 0.0


def run_in_time(
    stepper: Stepper,
    recorder: Recorder,
    at: InTime,
    schedule: Schedule,
    progress: Progress,
    keep: Callable[[InTime], InTime] = lambda at: at,
) -> tuple[State, RunVerdict]:
    """Step on over the schedule's duration; ``keep`` is shown where every step but the last ends.

    Returns
    -------
    The last accepted state and the verdict.
    """
    verdict = _unstable(stepper, at.state, schedule)
    while verdict is None and at.rest(schedule):
        found = _next(stepper, recorder, at, schedule, progress)
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
) -> InTime | RunVerdict:
    """Return where the next step ends, or why there is none."""
    state, rest = at.state, at.rest(schedule)
    length = rest if rest < (1 + ROUNDING) * at.step else at.step
    try:
        attempt, why = _step_or_cut(stepper, state, length, schedule)
    except BudgetSpentError as spent:
        return RunVerdict(SPENT, f"stopped at {state.time:.6g} s: {spent}")
    if not attempt.converged:
        return RunVerdict(FAILED, _failure(attempt, state, schedule))
    after, contacts = stepper.accept(attempt)
    stands = Stands(after, contacts)
    events = asked(recorder, stands) if schedule.events else ()
    said = recorder.step(state, attempt, contacts, after)
    taken = attempt.state.time - state.time
    cuts, last = at.cuts, at.why
    if why:
        cuts, last = cuts + 1, f"at {state.time:.6g} s: {why}"
        said = f"{said}  cut to {taken:.3g} s: {why}"
    recorder.offer(after, schedule.stage, contacts)
    stands = with_events(recorder, stands, events, schedule.stage)
    end = at.begin + schedule.duration
    parts = [f"time {after.time:.4g} s of {end:.4g} s", said, stands.what]
    text = "  ".join(filter(None, parts))
    progress((after.time - at.begin) / schedule.duration, text)
    # After a cut the step grows back slowly: what made it fail is rarely over at once.
    step = min(schedule.step, 2 * taken) if taken < schedule.step else schedule.step
    return InTime(stands.state, stands.contacts, at.begin, step, cuts, last)


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
