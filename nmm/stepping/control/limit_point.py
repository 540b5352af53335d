"""Whether a path falls beyond the last load that was solved: a limit point, seen by following."""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.assembly.state import State
from nmm.controls.base import Control
from nmm.controls.dissipation import Dissipation
from nmm.controls.events import NextEvent
from nmm.results.tee import Tee
from nmm.stepping.control.about_peak import AboutPeak, refined
from nmm.stepping.control.following import run_path
from nmm.stepping.control.position import OnPath, PathEnd
from nmm.stepping.control.trials import Trials
from nmm.stepping.drive.verdict import FAILURE, LimitPoint, RunVerdict
from nmm.stepping.reports.energies import stored
from nmm.stepping.reports.recorder import Recorder
from nmm.stepping.step.stepper import Stepper

if TYPE_CHECKING:
    from nmm.contact.solution.record import ContactRecord

# Share of the largest load to which a path must fall, and of the stored energy that a step of it
# dissipates where bonds soften.
PEAK_PASSED, PART = 0.98, 0.01


class LimitPoints:
    """Looks for limit points, once from each state: a path is the same however far it is requested.

    Parameters
    ----------
    stepper
        Follows the paths.
    """

    def __init__(self, stepper: Stepper) -> None:
        self._stepper = stepper
        self._seen: tuple[State, float] | None = None

    def __call__(self, state: State, factor: float) -> LimitPoint | None:
        """Return a limit point beyond a state, before a load factor; None where none is seen."""
        if self._seen is not None and self._seen[0] is state and factor <= self._seen[1]:
            return None
        found = limit_point(self._stepper, state, factor)
        self._seen = (state, factor) if found is None else None
        return found


def limit_point(stepper: Stepper, state: State, factor: float) -> LimitPoint | None:
    """Follow the path from ``state``; None unless it falls before it comes to ``factor``.

    Nothing is kept of it.
    """
    contact = stepper.plan.contact
    assert contact is not None
    record, taken, energy = stepper.remember(), stepper.budget.taken, _energy(stepper, state)
    soft = not contact.laws.brittle.all()
    control: Control = Dissipation(PART * energy) if soft else NextEvent(1.0)
    end = PathEnd(factor, PEAK_PASSED)
    at = replace(OnPath.at_start(state, control.increment), way=_way(stepper, state))
    trials = Trials(stepper, {})

    def all_soften() -> bool:
        """Whether bonds soften, and none is left that begins at a limit."""
        return soft and not trials.may_give_way()

    # Where no load brings a next bond to its limit those that soften already lead the path.
    at = replace(at, softened=all_soften() and bool(trials.standing(at).losing().any()))
    paths: list[AboutPeak] = []  # the coarse one, and shorter steps about its peak

    def follow(
        at: OnPath, record: "ContactRecord | None", control: Control, about: AboutPeak
    ) -> tuple[State, RunVerdict]:
        recorder = Recorder(stepper, Tee([]), [])
        paths.append(about)

        def keep(at: OnPath) -> OnPath:
            about.see(at, stepper.remember(), recorder.totals.ways)
            return about.onward(at) if all_soften() else at

        stepper.restore(record)
        return run_path(stepper, recorder, at, control, end, _untold, keep)

    about = AboutPeak(at, record)
    last, verdict = follow(at, record, control, about)
    peak = verdict.load_factor
    shown = verdict.code == FAILURE and peak is not None and last.load_factor < peak
    if shown and soft and peak == about.most:
        peak = refined(about, control, lambda at, before, by, seen: follow(at, before, by, seen)[1])
    stepper.restore(record)
    stepper.budget.taken = taken
    if not shown or peak is None:
        return None
    kind = "dissipation" if soft else "events"
    sentence = (
        f"a limit point was passed: beyond it the path falls from load factor {peak:.6g} to "
        f"{last.load_factor:.6g} in equilibrium; it was followed as evidence and is not recorded: "
        f'[loading.control] type = "{kind}" records it'
    )
    unstable = min((one.through for one in paths if one.through is not None), default=None)
    if unstable is not None:
        sentence += (
            f"; the way there led through an unstable equilibrium at {unstable:.6g}: a load that "
            "grows may fail there already; lower [loading] increment and compare"
        )
    return LimitPoint(peak, sentence)


def _untold(share: float, said: str) -> None:
    pass


def _way(stepper: Stepper, state: State) -> Floats:
    """Return the displacements (n,) of the unknowns, those of bodies as a whole in their axes."""
    frames, modes = state.frames, stepper.model.manifold.rigid_modes
    way = frames.whole_way
    assert way is not None
    turned = frames.angle if frames.tilt is None else frames.angle + frames.tilt
    moved = frames.to_body(np.arange(len(turned)), way)
    return np.asarray(state.deformation + modes @ np.column_stack([moved, turned]).ravel())


def _energy(stepper: Stepper, state: State) -> float:
    return sum(stored(stepper.plan, stepper.model, state).values())
