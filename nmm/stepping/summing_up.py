"""The summary of a run that has ended."""

import resource
from dataclasses import replace
from time import perf_counter
from typing import TYPE_CHECKING

from nmm.assembly.state import State
from nmm.formulation import Formulation
from nmm.results.summary import Summary
from nmm.stepping.audits.base import EndedRun
from nmm.stepping.audits.energy import balance
from nmm.stepping.audits.judge import audit, judged
from nmm.stepping.drive.verdict import RunVerdict
from nmm.stepping.reports.recorder import Recorder
from nmm.stepping.step.stepper import Stepper

if TYPE_CHECKING:
    from nmm.scene.model import Scene


def summed_up(
    known: Summary,
    recorder: Recorder,
    start: State,
    state: State,
    verdict: RunVerdict,
    asked: tuple["Scene", Formulation],
    begun: float,
) -> Summary:
    """Return the summary of a run, which its audits have judged.

    Parameters
    ----------
    known
        What was known before it began.
    start, state
        The first state and the last accepted one.
    verdict
        How it ended.
    asked
        Scene and formulation.
    begun
        When its preparation began (s).
    """
    stepper, totals = recorder.stepper, recorder.totals
    lengths = totals.lengths
    start = totals.since or start
    with stepper.clock.phase("audits"):
        condition = stepper.condition()
        findings = audit(EndedRun(*asked, stepper, recorder, start, state, verdict, condition))
    verdict, growth = judged(verdict, findings), stepper.plan.fracture
    load = None if verdict.load_factor is None else stepper.plan.scaled_load(verdict.load_factor)
    return replace(
        known,
        warnings=[*known.warnings, *(one.sentence for one in findings if one.warns)],
        audits={one.name: one.value for one in findings},
        status=verdict.code,
        sentence=verdict.sentence,
        steps=recorder.steps,
        passes=totals.passes,
        frames=totals.frames,
        seconds=_with_rest(stepper.seconds, perf_counter() - begun),
        effect_seconds=_by_effect(stepper, recorder),
        peak_memory=resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024,
        equilibrium_residual=totals.residual,
        largest_penetration=totals.penetration,
        energy_balance=balance(stepper, totals.ledger),
        condition_estimate=condition,
        smallest_step=None if lengths is None else lengths.smallest,
        largest_step=None if lengths is None else lengths.largest,
        rejected_steps=None if lengths is None else lengths.rejected,
        failure_load=load,
        failure_factor=verdict.load_factor,
        failure_tolerance=verdict.tolerance,
        largest_contacts=dict(totals.largest),
        change_energy=totals.ledger.change_energy if totals.changes else None,
        changes=list(totals.changes),
        fracture_energy=None if growth is None else growth.energy_taken,
        freed_energy=None if growth is None else recorder.freed_by(growth),
    )


def _by_effect(stepper: Stepper, recorder: Recorder) -> dict[str, float]:
    """Return seconds by effect: of its own calls, and of phases that are there because of it.

    Search is contact's, and so is what poses and judges its steps and every solution of one but
    that which it would have without it. Changes that events lead to are those of the one effect
    that asks for them.
    """
    found, phases, totals = dict(stepper.plan.seconds), stepper.seconds, recorder.totals
    if stepper.plan.contact is not None:
        more = max(totals.passes - recorder.steps, 0) / max(totals.passes, 1)
        own = phases.get("search", 0.0) + phases.get("contact", 0.0)
        caused = own + more * phases.get("solve", 0.0)
        found["contact"] = found.get("contact", 0.0) + caused
    if len(stepper.plan.askers) == 1:
        (asker,) = stepper.plan.askers
        found[asker] = found.get(asker, 0.0) + phases.get("change", 0.0)
    return found


def _with_rest(seconds: dict[str, float], total: float) -> dict[str, float]:
    """Return seconds by phase with what no phase has counted, so that they sum to the total."""
    return {**seconds, "rest": max(total - sum(seconds.values()), 0.0)}
