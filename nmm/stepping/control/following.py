"""Along a path event by event: a step ends where a bond is at its limit, and the bond gives way.

Between events the load factor follows what is controlled, up or down. A bond that softens goes on
without a jump. Where one breaks at once, forces find a new balance with what is controlled held
still, bond after bond; under control by events they find none before the load has changed to where
the next bond is at its limit.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from nmm.assembly.state import State
from nmm.controls.base import Control, PathState
from nmm.controls.events import NextEvent
from nmm.progress import Progress
from nmm.stepping.control.events import ReachedEvent, next_event
from nmm.stepping.control.locating import ABOVE, TriedStep, located
from nmm.stepping.control.other_answers import ahead, taking
from nmm.stepping.control.position import OnPath, PathEnd
from nmm.stepping.control.settling import settled
from nmm.stepping.control.telling import Telling
from nmm.stepping.control.trials import Trials
from nmm.stepping.control.verdicts import arrived, no_balance
from nmm.stepping.drive.changes import AcceptedState, asked, with_events
from nmm.stepping.drive.equilibrium.settling import rounding
from nmm.stepping.drive.until_verdict import until_verdict
from nmm.stepping.drive.verdict import RunVerdict
from nmm.stepping.reports.recorder import Recorder
from nmm.stepping.step.stepper import Stepper
from nmm.stepping.step.trial import Attempt

if TYPE_CHECKING:
    from nmm.contact.points.contact_points import ContactPoints

# A step that was cut to this share of the largest is not cut further, nor are so many between two
# of full length: a path that must creep does not come to its end.
SMALLEST, CREEPING = 2.0**-12, 20
# Iterations of a step up to which the next is longer.
EASY = 8


def run_path(
    stepper: Stepper,
    recorder: Recorder,
    at: OnPath,
    control: Control,
    end: PathEnd,
    progress: Progress,
    keep: Callable[[OnPath], OnPath] = lambda at: at,
) -> tuple[State, RunVerdict]:
    """Follow a path from ``at``; return the last state in equilibrium and the verdict.

    ``keep`` takes each place on it that is told, and returns from where it goes on.
    """
    following = _Following(stepper, recorder, control, end, progress)

    def step(at: OnPath) -> OnPath | RunVerdict:
        if not recorder.totals.taken and (begun := following.begun(at)) is not at:
            return begun
        ended = None if at.changed else arrived(at, control.end, end)
        after = ended or following.next(at)
        if isinstance(after, RunVerdict) or after.state is at.state:
            return after
        return keep(after)

    return until_verdict(at, step, recorder)


@dataclass(frozen=True)
class _Following:
    """Goes from where a path stands to where it stands next."""

    stepper: Stepper
    recorder: Recorder
    control: Control
    end: PathEnd
    progress: Progress

    @property
    def _telling(self) -> Telling:
        return Telling(self.stepper, self.recorder, self.control, self.progress)

    @property
    def trials(self) -> Trials:
        """Steps as they are tried on the present model."""
        monitors = {one.name: one.points for one in self.recorder.monitors}
        return Trials(self.stepper, monitors)

    def begun(self, at: OnPath) -> OnPath | RunVerdict:
        """Return where what acts without the load, as weight, is in balance at the start.

        Else its motion counts as that of the control, and the load that holds it back as one that
        was reached. Where the load leads, weight acts within the first step.
        """
        standing = self.trials.standing(at)
        if self._by_load(at, standing):
            return at
        still = self.trials.of_load(standing, 0.0).attempt
        if still.converged and still.motion <= rounding(self.stepper):
            return at
        return replace(self, control=NextEvent(1.0))._balanced(at)

    def next(self, at: OnPath) -> OnPath | RunVerdict:
        """Go on to the end of a step, or to the next event; then to what the state calls for."""
        after = self._balanced(at) if at.changed else self._further(at)
        return (
            after
            if isinstance(after, RunVerdict) or after.state is at.state
            else self._changed(after)
        )

    def _changed(self, at: OnPath) -> OnPath:
        """Change the model where effects ask for it; the balance is to be found anew then."""
        stands = AcceptedState(at.state, at.contacts)
        stands = with_events(self.recorder, stands, asked(self.recorder, stands), "load")
        way = at.way
        for change in stands.changes:  # a handful of effects
            way = change.field(way)
        changed, state, contacts = bool(stands.changes), stands.state, stands.contacts
        return replace(at, state=state, contacts=contacts, way=way, changed=changed)

    def _further(self, at: OnPath) -> OnPath | RunVerdict:
        standing = self.trials.standing(at)
        if self._by_load(at, standing):
            return self._to_event(at)
        step = min(at.advance, self.control.end - at.gone)
        found = ahead(at, self.trials.along(standing, self.control.path(standing, step)))
        if not found.attempt.converged:
            return self._shorter(at, step, found.attempt)
        if found.load > 1 + ABOVE:
            event = ahead(at, self._event_within(standing, found))
            if not event.attempt.converged:
                return self._shorter(at, step, event.attempt)
            return self._happened(at, event, step)
        if self.control.of_energy and not (found := taking(at, found)).attempt.converged:
            return self._shorter(at, step, found.attempt)
        after = self._accepted(at, found.attempt, found.way)
        if isinstance(after, Attempt):
            return self._shorter(at, step, after)
        easy, whole = found.attempt.passes <= EASY, self.control.increment
        lost = 0 if at.advance == whole else at.lost
        return replace(after, advance=min(whole, (2 if easy else 1) * at.advance), lost=lost)

    def _by_load(self, at: OnPath, standing: PathState) -> bool:
        """Whether the load leads from where a path stands, and not what is controlled."""
        begins = self.control.from_limit or self.trials.may_give_way()
        waits = begins and self.control.idle(at.events, at.softened)
        return self.control.by_load or waits or not self.control.row(standing).any()

    def _event_within(self, at: PathState, end: TriedStep) -> TriedStep:
        """Return where on a step the first bond is at its limit, or the trial that failed.

        Bonds that gave way last may have left more to their neighbours than these hold.
        """
        still = self.trials.along(at, self.control.standstill(at))
        if still.attempt.converged and still.load > 1 + ABOVE:
            return still
        now = TriedStep(0.0, end.attempt, np.minimum(self.trials.loads(), 1.0))
        return located(lambda way: self.trials.along(at, self.control.path(at, way)), now, end)

    def _shorter(self, at: OnPath, step: float, attempt: Attempt) -> OnPath | RunVerdict:
        """Try half of a step, or end."""
        if step / 2 >= SMALLEST * self.control.increment and at.lost < CREEPING:
            return replace(at, advance=step / 2, lost=at.lost + 1)
        return no_balance(at, attempt)

    def _to_event(self, at: OnPath) -> OnPath | RunVerdict:
        """Change the load to where the next bond is at its limit, or to the largest."""
        trials = self.trials
        found = next_event(trials, at, self.end.factor)
        while isinstance(found, ReachedEvent) and found.at_once:
            trials.give_way(found.tried.attempt)
            at = replace(at, events=at.events + 1)
            found = next_event(trials, at, self.end.factor)
        if isinstance(found, RunVerdict):
            return found
        if not found.event:
            after = self._accepted(at, found.tried.attempt, 0.0)
            return no_balance(at, after) if isinstance(after, Attempt) else after
        return self._happened(at, found.tried, 0.0)

    def _happened(self, at: OnPath, event: TriedStep, step: float) -> OnPath | RunVerdict:
        """Accept a step to an event, let bonds give way, and find the balance after it.

        ``step`` is how far the step was to go; the load alone, without one, has no shorter.
        """
        attempt, state, contacts = self._settled(at, event.attempt)
        if not attempt.converged:
            return self._shorter(at, step, attempt)
        after = self._telling.told(at, attempt, state, contacts, event.way)
        brittle, shed = self.trials.give_way(attempt)
        softened = at.softened or not brittle
        after = replace(after, softened=softened, events=at.events + 1, shed=shed)
        if not brittle or self.control.by_load:
            return after
        return self._balanced(after)

    def _balanced(self, at: OnPath) -> OnPath | RunVerdict:
        """Return the balance after bonds broke, or faces are new, with the control held still."""
        standing, trials = self.trials.standing(at), self.trials
        path = self.control.standstill(standing)
        while True:
            found = trials.along(standing, path)
            if not found.attempt.converged:
                return no_balance(at, found.attempt)
            if found.load <= 1 + ABOVE:
                after = self._accepted(at, found.attempt, 0.0, jump=True)
                return no_balance(at, after) if isinstance(after, Attempt) else after
            brittle, _ = trials.give_way(found.attempt)
            at = replace(
                at,
                softened=at.softened or not brittle,
                events=at.events + 1,
                changed=at.changed and not brittle,
            )

    def _accepted(
        self, at: OnPath, attempt: Attempt, way: float, jump: bool = False
    ) -> OnPath | Attempt:
        """Accept a step and tell it; where its end is in no balance return why."""
        attempt, state, contacts = self._settled(at, attempt)
        if not attempt.converged:
            return attempt
        return self._telling.told(at, attempt, state, contacts, way, jump)

    def _settled(
        self, at: OnPath, attempt: Attempt
    ) -> tuple[Attempt, State, "ContactPoints | None"]:
        """Accept a step, and find the balance where it ends with the control held still."""
        trials = self.trials

        def correction(so_far: Attempt) -> Attempt:
            now = replace(at, state=so_far.state, way=at.way + so_far.increment)
            standing = trials.standing(now)
            if self._by_load(now, standing):
                return trials.of_load(standing, 0.0).attempt
            return trials.along(
                standing, self.control.correction(standing, so_far.increment)
            ).attempt

        return settled(self.stepper, attempt, correction)
