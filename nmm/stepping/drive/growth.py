"""Cracks that grow in equilibrium, piece by piece: the load factor follows the toughness.

Every step finds the factor at which the most critical tip is at its toughness, which with linear
matter and loads of one factor is a matter of scale; beside dead loads intensities are affine in the
factor. The crack then grows by a piece, and the next step finds the next factor, be it larger or
smaller: a path that growing loads could not follow.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

from nmm.assembly.state import State
from nmm.errors import SolveError
from nmm.progress import Progress
from nmm.stepping.drive.changes import AcceptedState, asked, with_events
from nmm.stepping.drive.under_load import LoadSchedule, UnderLoad
from nmm.stepping.drive.until_verdict import until_verdict
from nmm.stepping.drive.verdict import CONVERGED, FAILED, RunVerdict
from nmm.stepping.reports.recorder import Recorder
from nmm.stepping.step.stepper import Stepper

if TYPE_CHECKING:
    from nmm.fracture.growth.growing import GrowingCracks
    from nmm.stepping.step.trial import Attempt

# Solutions to find a load factor, and how near to the toughness it brings a tip.
SECANTS, AT_TOUGHNESS = 20, 1e-9
# How much larger a factor is tried than one at which no tip feels anything, as dead loads press.
LARGER = 4.0
NOT_FELT = "no load factor opens a crack, no tip feels more than the error of its intensities"


def run_growth(
    stepper: Stepper,
    recorder: Recorder,
    at: UnderLoad,
    schedule: LoadSchedule,
    progress: Progress,
    keep: Callable[[UnderLoad], UnderLoad] = lambda at: at,
    dead: bool = False,
) -> tuple[State, RunVerdict]:
    """Let cracks grow from where they stand until none can.

    ``at.increment`` is the load factor that is tried next; ``keep`` is shown the end of each step;
    ``dead`` says that something acts that no factor scales.

    Returns
    -------
    The last state and the verdict.
    """
    growing = _Growing(stepper, recorder, schedule, progress, dead)

    def step(at: UnderLoad) -> UnderLoad | RunVerdict:
        found = growing.next(at)
        return found if isinstance(found, RunVerdict) else keep(found)

    # Where a crack has just grown balance is not found anew yet.
    return until_verdict(at, step, recorder, stopped="stopped")


@dataclass(frozen=True)
class _Growing:
    """Goes from the toughness of one piece to that of the next."""

    stepper: Stepper
    recorder: Recorder
    schedule: LoadSchedule
    progress: Progress
    dead: bool

    def next(self, at: UnderLoad) -> UnderLoad | RunVerdict:
        """Find the load of the present cracks, and let the critical ones grow; or end."""
        fracture = self.stepper.plan.fracture
        assert fracture is not None
        if self.recorder.steps and not at.changed:
            return self._ended("no crack grows further", at)
        if fracture.parted:
            return self._ended("a piece came free", at)
        attempt = self._at_toughness(at, fracture)
        return attempt if isinstance(attempt, RunVerdict) else self._grown(at, attempt)

    def _at_toughness(self, at: UnderLoad, fracture: "GrowingCracks") -> "Attempt | RunVerdict":
        """Balance at which the most critical tip is at its toughness, by secants from no load.

        The first of them is exact but where members yield or slide, or dead loads shear a tip
        otherwise than the others do.
        """
        before, had, factor = 0.0, 0.0, at.increment or 1.0
        if self.dead:
            still = self._share(at, 0.0, fracture)
            if isinstance(still, RunVerdict):
                return still
            had = still[1]
        for _ in range(SECANTS):
            found = self._share(at, factor, fracture)
            if isinstance(found, RunVerdict):
                return found
            trial, share = found
            slope = (share - had) / (factor - before)
            if abs(share - 1) < AT_TOUGHNESS:
                fracture.dead_factor = share / slope - factor if self.dead and slope else 0.0
                return trial
            if self.dead and share == had == 0.0:
                factor *= LARGER
                continue
            if not slope or (slope < 0 and not self.dead):
                break
            before, had, factor = factor, share, factor + (1 - share) / slope
        if not share and at.changed:
            return self._ended(NOT_FELT, at)
        missed = f"no load factor brings a tip to its toughness, {share:.6g} of it at {factor:.6g}"
        return RunVerdict(FAILED, f"{missed if share else NOT_FELT}: {at.changed or 'at first'}")

    def _share(
        self, at: UnderLoad, factor: float, fracture: "GrowingCracks"
    ) -> "tuple[Attempt, float] | RunVerdict":
        """Balance under a load factor, and what share of its toughness the critical tip feels."""
        trial = self._solved(at, factor)
        if isinstance(trial, RunVerdict):
            return trial
        with self.stepper.clock.phase("events"):
            reached = partial(fracture.reached, trial.state)
            share = self.stepper.plan.timed(fracture.name, reached)
        if share is None:
            return self._ended("every crack has come to an end", at)
        return trial, share

    def _solved(self, at: UnderLoad, factor: float) -> "Attempt | RunVerdict":
        try:
            attempt = self.stepper.attempt(at.state, self.schedule.instant(factor), None)
        except SolveError as fault:
            return RunVerdict(FAILED, str(fault))
        return attempt if attempt.converged else RunVerdict(FAILED, attempt.sentence)

    def _grown(self, at: UnderLoad, attempt: "Attempt") -> UnderLoad:
        """Accept the load of the present cracks, and the pieces by which they grow under it."""
        state, _ = self.stepper.accept(attempt)
        stands = AcceptedState(state, None)
        events = asked(self.recorder, stands)
        self.recorder.step(at.state, attempt, None)
        self.recorder.offer(state, "load", None)
        factor = state.load_factor
        self.progress(0.0, f"load factor {factor:.5g}")
        stands = with_events(self.recorder, stands, events, "load")
        return UnderLoad(stands.state, None, factor, at.rest, stands.what)

    def _ended(self, why: str, at: UnderLoad) -> RunVerdict:
        grown = len(self.recorder.totals.changes)
        factor = at.state.load_factor
        sentence = f"cracks grew {grown} times, at load factor {factor:.6g} at last: {why}"
        return RunVerdict(CONVERGED, sentence)
