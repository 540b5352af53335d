"""Growing loads without inertia: increments adapt to failure, and every state is in equilibrium.

A step in which bonds break is accepted only when its load increment is within the tolerance of the
load, so that bonds break in the order, and at the load, of a slow test whatever increment one
starts from.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from nmm.assembly.state import State
from nmm.progress import Progress
from nmm.stepping.drive.changes import AcceptedState, asked, with_events
from nmm.stepping.drive.equilibrium.relaxation import relax
from nmm.stepping.drive.equilibrium.settling import (
    anchored,
    is_adrift,
    may_be_loose,
    settle,
)
from nmm.stepping.drive.load_verdicts import no_equilibrium, no_rest, with_unheld
from nmm.stepping.drive.under_load import Beyond, LoadSchedule, Rest, Trial, UnderLoad, unseen
from nmm.stepping.drive.until_verdict import until_verdict
from nmm.stepping.drive.verdict import (
    CONVERGED,
    FAILURE,
    RunVerdict,
)
from nmm.stepping.reports.recorder import Recorder
from nmm.stepping.step.stepper import Stepper
from nmm.stepping.step.trial import Attempt

if TYPE_CHECKING:
    from nmm.contact.solution.record import Breaking

# A load increment that was cut to this share of the largest is not cut further.
SMALLEST_INCREMENT = 2.0**-30
# Share of the tolerance to which increments are cut where matter flows to a given load.
FLOWING = 1e-6
# Share of the stored energy from which on the loss on the way to rest is reported.
TOOK = 1e-6
CUT = (
    "increments of it cut, and the steps of its fields with them, on whose length these hang: take "
    "smaller ones, or [diffusion] step, and compare"
)


def run_load(
    stepper: Stepper,
    recorder: Recorder,
    at: UnderLoad,
    schedule: LoadSchedule,
    progress: Progress,
    names: Sequence[str] = (),
    keep: Callable[[UnderLoad], UnderLoad] = lambda at: at,
    beyond: Beyond = unseen,
) -> tuple[State, RunVerdict]:
    """Raise the load factor from its present value; ``names`` are those of the regions.

    ``keep`` is shown where every accepted increment but the last one ends; ``beyond`` looks for a
    limit point beyond a state, before a load factor.

    Returns
    -------
    The last state in equilibrium and the verdict.
    """
    raising = _Raising(stepper, recorder, schedule, progress, names, beyond)

    def step(at: UnderLoad) -> UnderLoad | RunVerdict:
        if raising.reached(at):
            return raising.arrived(at)
        found = raising.next(at)
        if isinstance(found, RunVerdict) or raising.reached(found):
            return found
        grown = at.changed or found.state.load_factor > at.state.load_factor
        return keep(found) if grown else found

    return until_verdict(at, step, recorder)


@dataclass(frozen=True)
class _Raising:
    """Raises a load: each method goes from where it stands to where it stands next."""

    stepper: Stepper
    recorder: Recorder
    schedule: LoadSchedule
    progress: Progress
    names: Sequence[str]
    beyond: Beyond

    def reached(self, at: UnderLoad) -> bool:
        """Whether the load has grown as far as it is to."""
        full = at.state.load_factor >= self.schedule.target * (1 - 1e-12)
        return full and not at.changed

    def next(self, at: UnderLoad) -> UnderLoad | RunVerdict:
        """Try an increment; then grow by it, or relax loose blocks, or try half of it, or end."""
        start = self.stepper.remember()
        trial = self._tried(at)
        # What an event leaves is sought from where it happens, to the tolerance of the load.
        if trial.found.attempt.converged and (trial.fine or not trial.located):
            return self._grown(at, trial)
        self.stepper.restore(start)
        unheld = self.stepper.plan.contact is not None and at.state.load_factor == 0
        if unheld and at.rest is None and trial.last and not trial.events:
            return self._relaxed(at, trial)
        if trial.fine and not self._may_flow(at, trial.factor):
            return self._ended(at, trial)
        if self.schedule.until_failure and _unsettled(trial.found.attempt):
            limit = self.beyond(at.state, trial.factor)
            if limit is not None:
                return RunVerdict(FAILURE, limit.sentence, limit.factor, 0.0)
        return replace(at, increment=at.increment / 2, cuts=at.cuts + 1)

    def _tried(self, at: UnderLoad) -> Trial:
        """Seek equilibrium under one more increment, with anchors where nothing else helps."""
        stepper, schedule, state = self.stepper, self.schedule, at.state
        factor = min(state.load_factor + at.rise, schedule.target)
        finest = max(schedule.tolerance * factor, SMALLEST_INCREMENT * schedule.increment)
        fine = schedule.at_once or at.rise <= finest
        start, bonds = stepper.remember(), stepper.broken_bonds
        # A bond that breaks in a coarse increment is no news yet: the increment is cut first.
        end, breaking = self.schedule.instant(factor), _breaking(fine)
        found = settle(stepper, state, end, breaking)
        # Matter keeps what a relaxation did to it on the way: smaller increments come first.
        forgets = stepper.model.matter is None
        last = fine or (forgets and state.load_factor == 0 and not schedule.until_failure)
        if last and may_be_loose(stepper, found):
            stepper.restore(start)
            found = anchored(stepper, state, end, breaking, found)
        if found.attempt.converged and is_adrift(stepper):
            stepper.restore(start)
            again = anchored(stepper, state, end, breaking)
            found = again if again.attempt.converged else settle(stepper, state, end, breaking)
        stands = AcceptedState(found.attempt.state, found.contacts)
        events = asked(self.recorder, stands) if found.attempt.converged else ()
        return Trial(factor, fine, last, found, stepper.broken_bonds > bonds, events)

    def _may_flow(self, at: UnderLoad, factor: float) -> bool:
        """Whether matter that flows to a given load may find equilibrium over a shorter way yet.

        That it flows without stiffness where a trial ended is no proof of failure: where friction
        and dilation differ ground may do so on its way to a state that it can bear.
        """
        schedule = self.schedule
        sought = schedule.until_failure or schedule.at_once
        flows = self.stepper.model.matter is not None and not sought
        # The first increment is all of its load: beside that alone it would never be short.
        shortest = SMALLEST_INCREMENT * schedule.increment
        return flows and at.rise > max(FLOWING * schedule.tolerance * factor, shortest)

    def _grown(self, at: UnderLoad, trial: Trial) -> UnderLoad:
        """Accept an increment; the next is larger unless bonds broke."""
        recorder, found, schedule = self.recorder, trial.found, self.schedule
        said = recorder.step(at.state, found.attempt, found.contacts)
        state = found.attempt.state
        recorder.offer(state, "load", found.contacts)
        text = "  ".join([f"load factor {trial.factor:.5g}", said]).rstrip()
        self.progress(min(trial.factor / schedule.target, 1.0), text)
        stands = with_events(recorder, AcceptedState(state, found.contacts), trial.events, "load")
        longer = min(2 * at.increment, schedule.increment)
        stays = trial.broke or bool(trial.events) or at.changed
        increment = at.increment if stays else longer
        given = stands.state, stands.contacts, increment, at.rest, stands.what
        return UnderLoad(*given, at.cuts)

    def _relaxed(self, at: UnderLoad, trial: Trial) -> UnderLoad | RunVerdict:
        """Bring loose blocks to rest, from where the load begins to grow anew."""
        start = self.stepper.remember()
        end = self.schedule.instant(trial.factor)
        rest = relax(self.stepper, at.state, end, self.names, near=self.schedule.at_once)
        if not rest.at_rest:
            self.stepper.restore(start)
            return no_rest(rest)
        state = replace(rest.state, time=at.state.time, load_factor=0.0)
        self.recorder.brought_to(state, end)
        return replace(at, state=state, rest=Rest(rest.steps, rest.way, rest.lost))

    def _ended(self, at: UnderLoad, trial: Trial) -> RunVerdict:
        """Return the verdict on the finest increment, under which no equilibrium was found."""
        verdict = no_equilibrium(
            at, trial.factor, trial.found, self.schedule, self.stepper, self.names, self.beyond
        )
        return with_unheld(verdict, self.stepper, at.state, self.names)

    def arrived(self, at: UnderLoad) -> RunVerdict:
        """Return the verdict at the end of the path."""
        sentence = f"equilibrium at load factor {at.state.load_factor:.6g}"
        if self.schedule.followed and at.cuts:
            sentence += f", {at.cuts} {CUT}"
        if at.rest is not None:
            sentence += f", loose blocks brought to rest in {at.rest.steps} steps of relaxation"
            sentence += f" over {at.rest.way:.3g} m"
            if at.rest.lost > TOOK * self.recorder.ledger.in_store:
                sentence += (
                    f", on which friction, bonds or matter took {at.rest.lost:.3g} J: by another "
                    "way they may rest under other forces"
                )
        return with_unheld(RunVerdict(CONVERGED, sentence), self.stepper, at.state, self.names)


def _breaking(fine: bool) -> "Breaking":
    return "worst" if fine else "stop"


def _unsettled(attempt: Attempt) -> bool:
    """Whether what interface laws remember did not settle: bonds soften where no load is held."""
    solved = attempt.solved
    return solved is not None and solved.answer.verdict.code == "passes"
