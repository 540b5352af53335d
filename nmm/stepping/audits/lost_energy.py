"""Energy that integrators and contacts took which nobody asked for, and what would keep it."""

from nmm.integrators.base import make_integrator
from nmm.stepping.audits.base import AuditFinding, EndedRun, Findings, percent
from nmm.stepping.audits.steps import impact_lasts
from nmm.stepping.audits.table import THRESHOLDS

# Steps in an impact with which Shi's integrator keeps nine tenths of its energy.
RESOLVED = 60

# What contact takes whose forces act in steps as wholes, without springs.
INELASTIC = (
    "exact contact ends an impact within a step, without a rebound: right of stiff bodies that "
    "stay together, and of what is placed and rests, whatever the step; where bodies are to "
    'rebound or waves matter, take [contact] enforcement = "penalty" and steps that resolve its '
    "springs"
)


def damped(run: EndedRun) -> Findings:
    """What the integrator takes of a motion that records drive; peaks fall short by about it."""
    if all(one.resolves is None for one in run.stepper.plan.effects.values()):
        return
    ledger, rule = run.recorder.ledger, run.formulation.integrator
    missing = ledger.balance - ledger.contact_loss / ledger.throughput
    share = max(min(ledger.integration_loss / ledger.throughput, missing), 0.0)
    damps = make_integrator(rule).order == 1
    yield AuditFinding(
        "record_damped",
        share,
        f'{percent(share)} of the turnover of what records drive was lost to the integrator "'
        f'{rule.type}": peaks of waves are up to so much too low',
        "take smaller steps" + (', or type = "newmark", which damps none' if damps else ""),
    )


def lost(run: EndedRun) -> Findings:
    """Energy that damping took which nobody asked for, with the step that would keep it."""
    ledger, rule = run.recorder.ledger, run.formulation.integrator
    if rule.kinetic_factor < 1:
        return
    share = ledger.balance
    # What dashpots took may be the integrator's as well: it took no more than what is missing.
    missing = share * ledger.throughput - max(ledger.contact_loss, 0.0)
    parts = {
        f'the integrator "{rule.type}"': min(ledger.integration_loss, missing),
        "closing and opening of contacts within steps": ledger.contact_loss,
    }
    told = " and ".join(
        f"{percent(lost / ledger.throughput)} by {name}"
        for name, lost in parts.items()
        if lost > 0.01 * share * ledger.throughput
    )
    lasts = impact_lasts(run)
    by_contact = ledger.contact_loss > 0.5 * share * ledger.throughput
    yield AuditFinding(
        "energy_lost",
        share,
        f"{percent(share)} of the turnover was lost to no friction or damper"
        + (f": {told}" if told else ""),
        INELASTIC if by_contact and lasts is None else _keeps(run, share, by_contact, lasts),
    )


def _keeps(run: EndedRun, share: float, by_contact: bool, lasts: float | None) -> str:
    """Return what keeps the energy of which a ``share`` was lost.

    What integrators take falls with the first power of the step, and what contact takes once
    impacts, which last for some ``lasts`` (s) on springs, are resolved.
    """
    rule = run.formulation.integrator
    step = rule.fixed_step or run.state.time / max(run.recorder.ledger.steps, 1)
    kept = step * THRESHOLDS["energy_lost"].warns / max(share, 1e-300)
    if lasts is not None and by_contact:
        kept = min(kept, lasts / RESOLVED)
    damps = make_integrator(rule).order == 1
    other = ', or type = "newmark", which damps nothing but impacts' if damps else ""
    return f"steps of some {kept:.2g} s in place of {step:.3g} s would keep it{other}"
