"""Along a path event by event: a step ends where a bond is at its limit, and the bond gives way.

Between events the load factor follows what is controlled, up or down. A bond that softens goes on
without a jump. Where one breaks at once, forces find a new balance with what is controlled held
still, bond after bond; under control by events they find none before the load has changed to where
the next bond is at its limit.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Bools, Floats
from nmm.assembly.motion import MaterialPoints, State
from nmm.contact.controls.base import Control, Standing
from nmm.contact.following.path_equation import PathEquation
from nmm.stepping.control.locating import Tried, located, outward
from nmm.stepping.drive.verdict import CONVERGED, FAILED, FAILURE, SPENT, RunVerdict
from nmm.stepping.reports.ledger import stored
from nmm.stepping.reports.recorder import Recorder
from nmm.stepping.step.budget import BudgetSpentError
from nmm.stepping.step.stepper import Stepper
from nmm.stepping.step.trial import Attempt

if TYPE_CHECKING:
    from nmm.contact.points.contact_points import ContactPoints

# Load over strength above which a bond cannot hold, and shares of the worst that give way with it.
ABOVE, TIE = 1e-9, 1e-6
# A step that was cut to this share of the largest is not cut further.
SMALLEST = 2.0**-20
# A load factor below this share of the largest is none.
NOTHING = 1e-9
# Iterations of a step after which the next is longer.
EASY = 8


@dataclass(frozen=True)
class OnPath:
    """Where a path stands.

    Attributes
    ----------
    state, contacts
        The last state in equilibrium, and its contacts as left.
    advance
        How far the next step goes.
    way
        (n,) sum of all increments.
    gone
        How far what is controlled has come.
    peak
        Largest load factor so far.
    softened
        Whether the bonds that gave way last soften.
    events
        How often bonds gave way.
    """

    state: State
    contacts: "ContactPoints | None"
    advance: float
    way: Floats
    gone: float = 0.0
    peak: float = 0.0
    softened: bool = False
    events: int = 0


@dataclass(frozen=True)
class PathEnd:
    """Where a path is to end.

    Attributes
    ----------
    factor
        Largest load factor.
    fall
        Share of the largest load so far to which it may fall.
    """

    factor: float
    fall: float


Progress = Callable[[float, str], None]


def run_path(
    stepper: Stepper,
    recorder: Recorder,
    start: State,
    control: Control,
    end: PathEnd,
    progress: Progress,
) -> tuple[State, RunVerdict]:
    """Follow a path from ``start``; return the last state in equilibrium and the verdict."""
    monitors = {one.name: one.points for one in recorder.monitors}
    following = _Following(stepper, recorder, control, end, monitors, progress)
    at = OnPath(start, None, control.increment, np.zeros_like(start.deformation))
    verdict = None
    try:
        while verdict is None:
            found = following.next(at)
            if isinstance(found, RunVerdict):
                verdict = found
            else:
                at = found
                verdict = following.arrived(at)
    except BudgetSpentError as spent:
        held = at.state.load_factor
        verdict = RunVerdict(SPENT, f"stopped in equilibrium at load factor {held:.6g}: {spent}")
    recorder.last(at.state, "load", at.contacts)
    return at.state, verdict


@dataclass(frozen=True)
class _Following:
    """Goes from where a path stands to where it stands next."""

    stepper: Stepper
    recorder: Recorder
    control: Control
    end: PathEnd
    monitors: Mapping[str, MaterialPoints]
    progress: Progress

    def next(self, at: OnPath) -> OnPath | RunVerdict:
        """Go on to the end of a step, or to the next event."""
        standing = self._standing(at)
        idle = not self.control.row(standing).any() or self.control.idle(at.events, at.softened)
        if self.control.by_load or idle:
            return self._to_event(at, standing)
        step = min(at.advance, self.control.end - at.gone)
        found = self._tried(at, self.control.path(standing, step))
        if not found.attempt.converged:
            return self._shorter(at, step, found.attempt)
        if found.load > 1 + ABOVE:
            event = located(
                lambda way: self._tried(at, self.control.path(standing, way)),
                Tried(0.0, found.attempt, min(self._now(at), 1.0)),
                found,
            )
            if event is None:
                return self._shorter(at, step, found.attempt)
            return self._happened(at, event)
        after = self._accepted(at, found.attempt, found.way)
        easy = found.attempt.passes <= EASY
        return replace(after, advance=min(self.control.increment, (2 if easy else 1) * at.advance))

    def arrived(self, at: OnPath) -> RunVerdict | None:
        """Return the verdict where the path is at its end; None before."""
        factor, peak = at.state.load_factor, at.peak
        fallen = peak > 0 and factor <= max(self.end.fall, NOTHING) * peak
        through = at.gone >= self.control.end * (1 - 1e-12)
        if not fallen and not through and factor < self.end.factor * (1 - 1e-12):
            return None
        if factor < peak * (1 - NOTHING):
            sentence = (
                f"a limit point was passed: the largest load factor on the path is {peak:.6g}, and "
                f"the path goes on in equilibrium down to {factor:.6g}"
            )
            return RunVerdict(FAILURE, sentence, peak, 0.0)
        return RunVerdict(CONVERGED, f"equilibrium along the path to load factor {factor:.6g}")

    def _standing(self, at: OnPath) -> Standing:
        load = self.stepper.unit_load(at.state)
        return Standing(at.state, load, self.monitors, at.way)

    def _tried(self, at: OnPath, path: PathEquation) -> Tried:
        attempt = self.stepper.along(at.state, path)
        if attempt.converged and attempt.motion > self.stepper.size:
            attempt = replace(attempt, converged=False, sentence="points leave the domain")
        load = float(self._overload(attempt).max(initial=0.0)) if attempt.converged else np.inf
        return Tried(path.target, attempt, load)

    def _overload(self, attempt: Attempt) -> Floats:
        """Return load over strength (m,) of the bonds of an attempt."""
        contact, solved = self.stepper.plan.contact, attempt.solved
        assert contact is not None
        assert solved is not None
        return contact.overload(solved)

    def _now(self, at: OnPath) -> float:
        """Largest load over strength where the path stands."""
        still = PathEquation(self.stepper.unit_load(at.state), 0 * at.way, 1.0, 0.0)
        return self._tried(at, still).load

    def _shorter(self, at: OnPath, step: float, attempt: Attempt) -> OnPath | RunVerdict:
        """Try half of a step, or end."""
        if step / 2 >= SMALLEST * self.control.increment:
            return replace(at, advance=step / 2)
        return self._ended(at, attempt)

    def _to_event(self, at: OnPath, standing: Standing) -> OnPath | RunVerdict:
        """Change the load to where the next bond is at its limit."""
        nothing = 0 * at.way

        def try_(change: float) -> Tried:
            return self._tried(at, PathEquation(standing.load, nothing, 1.0, change))

        still = try_(0.0)
        if not still.attempt.converged:
            return self._ended(at, still.attempt)
        factor = at.state.load_factor
        first = factor * (1 / still.load - 1) if factor and still.load else 1.0
        found = still
        if abs(still.over) > ABOVE:
            other = outward(try_, still, first or 1.0)
            if other is None:
                return self._without_event(at, still)
            low, high = sorted((still, other), key=lambda one: one.over)
            event = located(try_, low, high)
            if event is None:
                return self._ended(at, other.attempt)
            found = event
        if factor + found.way > self.end.factor:
            last = try_(self.end.factor - factor)
            if last.attempt.converged and last.load <= 1 + ABOVE:
                return self._accepted(at, last.attempt, 0.0)
        return self._happened(at, replace(found, way=0.0))

    def _without_event(self, at: OnPath, still: Tried) -> OnPath | RunVerdict:
        """End where no load brings another bond to its limit."""
        if np.isfinite(self.end.factor):
            change = self.end.factor - at.state.load_factor
            load = self.stepper.unit_load(at.state)
            last = self._tried(at, PathEquation(load, 0 * at.way, 1.0, change))
            if last.attempt.converged and last.load <= 1 + ABOVE:
                return self._accepted(at, last.attempt, 0.0)
        last_ = "no load brings another bond to its limit"
        if at.state.load_factor < at.peak * (1 - NOTHING):
            return self._ended(at, replace(still.attempt, sentence=last_))
        held = at.state.load_factor
        sentence = f"equilibrium up to load factor {held:.6g}, {at.events} events on: {last_}"
        return RunVerdict(CONVERGED, sentence)

    def _happened(self, at: OnPath, event: Tried) -> OnPath | RunVerdict:
        """Accept a step to an event, let bonds give way, and find the balance after it."""
        after = self._accepted(at, event.attempt, event.way)
        brittle = self._let_go(event.attempt)
        after = replace(after, softened=not brittle, events=at.events + 1)
        if not brittle or self.control.by_load:
            return after
        return self._balanced(after)

    def _let_go(self, attempt: Attempt) -> bool:
        """Let the bonds that are loaded most give way; say whether any of them breaks at once."""
        contact, solved = self.stepper.plan.contact, attempt.solved
        assert contact is not None
        assert solved is not None
        load = self._overload(attempt)
        gone: Bools = load >= load.max() * (1 - TIE)
        contact.release(solved, gone)
        return bool(contact.laws.brittle[solved.contacts.interface[gone]].any())

    def _balanced(self, at: OnPath) -> OnPath | RunVerdict:
        """Return the balance after bonds broke, with what is controlled held still."""
        standing = self._standing(at)
        path = self.control.path(standing, 0.0)
        while True:
            found = self._tried(at, path)
            if not found.attempt.converged:
                return self._ended(at, found.attempt)
            if found.load <= 1 + ABOVE:
                return self._accepted(at, found.attempt, 0.0, jump=True)
            self._let_go(found.attempt)

    def _accepted(self, at: OnPath, attempt: Attempt, way: float, jump: bool = False) -> OnPath:
        """Accept a step and tell it; time counts steps."""
        stepper, recorder = self.stepper, self.recorder
        later = replace(attempt.state, time=at.state.time + 1.0)
        attempt = replace(attempt, state=later)
        state, contacts = stepper.accept(attempt)
        if (jump or self.control.by_load) and attempt.solved is not None:
            lost = self._released(at.state, later)
            attempt = replace(attempt, solved=replace(attempt.solved, loss=lost))
        said = recorder.step(at.state, attempt, contacts)
        recorder.offer(state, "load", contacts)
        factor = state.load_factor
        self.progress(
            min(at.gone / self.control.end, 1.0), f"load factor {factor:.5g}  {said}".rstrip()
        )
        return replace(
            at,
            state=state,
            contacts=contacts,
            way=at.way + attempt.increment,
            gone=at.gone + way,
            peak=max(at.peak, factor),
        )

    def _released(self, before: State, after: State) -> float:
        """Energy (J) that is neither stored nor work: motion in which bonds broke."""
        plan, model, ledger = self.stepper.plan, self.stepper.model, self.recorder.ledger
        first = sum(ledger.energies.values()) if ledger.steps else 0.0
        return plan.work(before, after) - sum(stored(plan, model, after).values()) + first

    def _ended(self, at: OnPath, attempt: Attempt) -> RunVerdict:
        """Return the verdict where no balance was found further on."""
        peak, factor = at.peak, at.state.load_factor
        if attempt.singular or factor < peak * (1 - NOTHING):
            shown = (
                "nothing holds it after the last bonds broke"
                if attempt.singular
                else "a limit point was passed"
            )
            sentence = (
                f"{shown}: the largest load factor on the path is {peak:.6g}; the path was "
                f"followed to {factor:.6g}: {attempt.sentence}"
            )
            return RunVerdict(FAILURE, sentence, peak, 0.0)
        sentence = (
            f"no balance was found beyond load factor {factor:.6g} on the path: "
            f"{attempt.sentence}; try shorter steps, or another control"
        )
        return RunVerdict(FAILED, sentence, peak)
