"""A step as two halves, beside the same in one: what they differ by is its error.

The halves are what the run keeps. The second goes on from what stepper and effects carry after the
first, which is accepted for the time being and undone with it where the step errs too much. A step
that is halved then has its whole already: it is the first half. A step in which bodies meet fast
ends as they meet.
"""

from dataclasses import dataclass
from math import floor, inf, isinf, log2

from nmm.assembly.state import State
from nmm.effects.base import Instant
from nmm.frozen import with_parts
from nmm.stepping.adaptive.control import StepChoice, StepControl
from nmm.stepping.adaptive.followed import FollowedPoints
from nmm.stepping.adaptive.meeting import ClosingContacts
from nmm.stepping.adaptive.provisional import ProvisionalStep
from nmm.stepping.reports.recorder import Recorder
from nmm.stepping.step.trial import Attempt

# A step that would end so near a stop, as a share of itself, ends there.
AT_STOP = 1e-9
# Share of the largest speed in the run: bodies that meet faster make an impact.
SUDDEN = 0.1


@dataclass(frozen=True)
class HalvedStep:
    """A step whose first half is accepted and whose second is to be.

    Attributes
    ----------
    middle, second
        The state between them and the attempt from there; what failed where no step was found.
    next
        How long the next step may be (s).
    chosen
        What the control carries on.
    cut
        Why a longer step that was tried was not solved; empty where all were.
    """

    middle: State
    second: Attempt
    next: float
    chosen: StepChoice
    cut: str = ""


@dataclass(frozen=True)
class _Trial:
    """What came of a step: the last attempt, the state before it, its error over the bound.

    ``first`` is the whole of a step half as long; None where it is not known.
    """

    middle: State
    second: Attempt
    ratio: float = inf
    seen: StepChoice | None = None
    first: Attempt | None = None


@dataclass(frozen=True)
class TrialStep:
    """Tries steps from one state until one errs little enough.

    Attributes
    ----------
    recorder
        Takes the first half.
    control
        What steps are chosen by.
    state
        Where the step begins.
    load_factor, stage
        Of its instants and frames.
    """

    recorder: Recorder
    control: StepControl
    state: State
    load_factor: float
    stage: str

    def take(self, chosen: StepChoice, asked: float, stop: float) -> HalvedStep:
        """Take a step of ``asked`` (s) or less that does not pass the time ``stop`` (s).

        Raises
        ------
        BudgetSpentError
            When the run may cost no more; nothing is left of what was tried.
        """
        start, shortest = self.state.time, self.control.shortest
        end, whole, cut, tried, met = _landing(start, asked, stop), None, "", False, False
        while True:  # trials of one step
            meeting = None
            if not met and (end - start) / 2 >= shortest:
                whole = whole or self._attempt(self.state, end)
                meeting = self._meeting(chosen, whole)
            if meeting is not None:
                end, whole, met = meeting.state.time, meeting, True
                self.recorder.tried(rejected=1)
            length, last = end - start, (end - start) / 2 < shortest
            trial = self._trial(chosen, end, whole, last)
            if not trial.second.converged:
                cut = cut or trial.second.sentence
            if trial.seen is not None:
                after = self.control.after(length, trial.ratio, chosen.last)
                # A step that was short to end at a stop says nothing against longer ones.
                after = min(after, length) if tried else max(after, asked)
                if met and not tried:  # an impact begins, which takes a time of its own
                    after = min(after, self.control.first)
                return HalvedStep(trial.middle, trial.second, after, trial.seen, cut)
            if last:
                return HalvedStep(trial.middle, trial.second, length, chosen, cut)
            self.recorder.tried(rejected=1)
            count = 1 if isinf(trial.ratio) else self.control.halvings(trial.ratio)
            count = max(1, min(count, floor(log2(length / shortest))))
            end, tried = start + length / 2**count, True
            whole = trial.first if count == 1 else None

    def _trial(self, chosen: StepChoice, end: float, whole: Attempt | None, last: bool) -> _Trial:
        """Try both halves, and keep the first where they err little enough, or are the ``last``."""
        state, stepper = self.state, self.recorder.stepper
        whole = whole or self._attempt(state, end)
        if not whole.converged:
            return _Trial(state, whole)
        first = self._attempt(state, state.time + (end - state.time) / 2)
        if not first.converged:
            return _Trial(state, first)
        known = ProvisionalStep.begin(self.recorder)
        try:
            middle, contacts = stepper.accept(first)
            self.recorder.step(state, first, contacts, middle)
            self.recorder.offer(middle, self.stage, contacts)
            second = self._attempt(middle, end)
        except BaseException:
            known.undo()
            raise
        if not second.converged:
            known.undo()
            return _Trial(middle, second)
        seen, ratio = self._error(chosen, whole, first, second)
        if ratio > 1 and not last:
            known.undo()
            return _Trial(middle, second, ratio, first=first)
        known.keep()
        if ratio > 1:
            self.recorder.tried(unresolved=1)
        return _Trial(middle, second, ratio, seen)

    def _meeting(self, chosen: StepChoice, whole: Attempt) -> Attempt | None:
        """Return the step that ends as bodies meet in a ``whole`` one; None where none do."""
        points, shortest = (
            FollowedPoints(self.recorder.stepper, self.control.rigid),
            self.control.shortest,
        )
        speed = max(chosen.speed, points.sizes(self.state)[1])
        found = ClosingContacts.of(whole, self.state, chosen.pushing, SUDDEN * speed, 2 * shortest)
        if found is None:
            return None
        return found.first(self.state, self._attempt, whole.state.time, shortest)

    def _error(
        self, chosen: StepChoice, whole: Attempt, first: Attempt, second: Attempt
    ) -> tuple[StepChoice, float]:
        """Return what the control carries on from both halves, and their error over the bound.

        Vibrations that steps do not resolve are nearly nothing in places, and much in speeds: these
        count while contacts push, where waves within bodies decide how they part.
        """
        stepper, rigid = self.recorder.stepper, self.control.rigid
        points, all_points = FollowedPoints(stepper, rigid), FollowedPoints(stepper, rigid=False)
        seen = chosen.seen(*points.sizes(first.state)).seen(*points.sizes(second.state))
        pushing = [one.solved.pushing for one in (first, second, whole) if one.solved is not None]
        counts = self.control.impacts and any(map(len, (chosen.pushing, *pushing)))
        faster = all_points.faster(whole.state, second.state) if counts else 0.0
        length = whole.state.time - self.state.time
        apart = points.apart(whole.state, second.state)
        ratio = self.control.ratio(seen, apart, faster, length)
        last = pushing[1] if pushing else chosen.pushing
        return with_parts(seen, last=ratio, pushing=last), ratio

    def _attempt(self, state: State, end: float) -> Attempt:
        instant = Instant(end, self.load_factor)
        return self.recorder.stepper.attempt(state, instant, end - state.time)


def _landing(start: float, asked: float, stop: float) -> float:
    """Return where a step of ``asked`` (s) ends: at a stop that it reaches, or half way to one."""
    rest = stop - start
    if asked >= (1 - AT_STOP) * rest:
        return stop
    return start + (asked if 2 * asked <= rest else rest / 2)
