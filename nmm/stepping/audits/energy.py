"""Energy that came from nowhere, energy that went, and work that was not stored."""

from typing import TYPE_CHECKING

import numpy as np

from nmm.integrators.base import make_integrator
from nmm.stepping.audits.base import AuditFinding, EndedRun, Findings, percent
from nmm.stepping.audits.causes import cause
from nmm.stepping.audits.steps import impact_lasts
from nmm.stepping.audits.table import THRESHOLDS
from nmm.stepping.reports.accounts import EnergyRise

if TYPE_CHECKING:
    from nmm.stepping.reports.ledger import Ledger
    from nmm.stepping.step.stepper import Stepper

# A rise over the run that is less than this times that of one step is the same rise.
SAME = 1.5

# Of the turnover: waves of an integrator, which it gives and takes again, are no larger. As much
# must go before a loss is told.
WAVES = 0.1

# Steps in an impact with which Shi's integrator keeps nine tenths of its energy.
RESOLVED = 60

# What contact takes whose forces act in steps as wholes, without springs.
INELASTIC = (
    "exact contact ends an impact within a step, without a rebound: right of stiff bodies that "
    "stay together, and of what is placed and rests, whatever the step; where bodies are to "
    'rebound or waves matter, take [contact] enforcement = "penalty" and steps that resolve its '
    "springs"
)

# Why work is not what is stored and lost in statics, and what to do: bonds broke, bodies touch, or
# neither.
TORN = (
    " where bonds broke: statics knows ends of increments alone, and what bonds free at once sets "
    "bodies in motion",
    "follow the path ([loading.control]), take smaller increments, or [inertia]",
)
TOUCHED = (
    ": work is of the means of loads at both ends of increments, within which contacts close, open "
    "or slide",
    "take smaller increments where energies matter",
)
BENT = (
    ": work is of the means of loads at both ends of increments, within which bodies bend and turn",
    TOUCHED[1],
)
MEANS = ": work is of the means of loads at both ends of increments, within which the force of"
WRONG = "the solution is not one of its equations: look at the residual and the condition"


def energy(run: EndedRun) -> Findings:
    """Audit the energies of a run."""
    ledger = run.recorder.ledger
    wrong = [name for name, value in ledger.row.items() if not np.isfinite(value)]
    yield AuditFinding(
        "not_finite",
        float(len(wrong)),
        f"{', '.join(wrong)} of the last step are no finite numbers",
        "take smaller steps, and look at stiffnesses and masses",
    )
    if wrong or not ledger.throughput:
        return
    if run.dynamic:
        yield from _made(run)
        yield _driven(run)
        yield from _lost(run)
        yield from _damped(run)
    elif run.stepper.small and run.stepper.plan.contact is None:
        lacking = abs(ledger.balance) * ledger.throughput
        curved = run.stepper.plan.bent
        within = f"{MEANS} {' and '.join(curved)} is no line in the displacement"
        yield AuditFinding(
            "work_not_stored",
            0.0 if lacking <= _rounding(run) else abs(ledger.balance),
            f"work and stored energy differ by {percent(ledger.balance)}{within if curved else ''}",
            TOUCHED[1] if curved else WRONG,
        )
    else:
        yield from _released(run)


def balance(stepper: "Stepper", ledger: "Ledger") -> float:
    """Return what work, stores and losses lack, over the largest of them.

    Where bodies may touch coordinates are rounded: energies of a strain of their rounding,
    ``E (eps L)^2`` times the thickness, are of nothing, and nothing is lacking.
    """
    model = stepper.model
    rounded = float(np.finfo(float).eps) * stepper.size
    nothing = float(model.modulus.max()) * model.thickness * rounded**2
    if stepper.plan.contact is not None and ledger.throughput <= nothing:
        return 0.0
    return ledger.balance


def _released(run: EndedRun) -> Findings:
    """Energy of statics that neither work nor losses account for."""
    stepper, ledger = run.stepper, run.recorder.ledger
    share, contact = abs(balance(stepper, ledger)), stepper.plan.contact
    why, remedy = BENT
    if contact is not None:
        why, remedy = TORN if contact.broken_bonds else TOUCHED
        yield _rubbed(ledger)
    yield AuditFinding(
        "energy_released",
        share,
        f"{share * ledger.throughput:.3g} J, {percent(share)} of the turnover, is the difference "
        f"between work and what is stored and lost{why}",
        remedy,
    )


def _rubbed(ledger: "Ledger") -> AuditFinding:
    """Energy that friction and bonds gave in statics, where they can only take."""
    given = ledger.friction_gift
    share = given / ledger.throughput
    return AuditFinding(
        "energy_made_by_friction",
        share,
        f"{given:.3g} J, {percent(share)} of the turnover, came from friction and bonds, which can "
        "only take: an increment of the load passed over what they took within it",
        "take smaller increments ([loading] increment of the formulation)",
    )


def _rounding(run: EndedRun) -> float:
    """Energy (J) of nothing but rounding: ``n eps |q| |K| |q|``, with n entries in a row of K.

    It bounds that of products with K (Higham, Accuracy and Stability, 3.5): a body that is moved
    without strain stores and takes no more than this.
    """
    stepper, way = run.stepper, np.abs(run.state.deformation)
    matrix = stepper.plan.matrix(run.state, stepper.model.stiffness)
    entries = int(np.diff(matrix.indptr).max())
    return float(entries * np.finfo(float).eps * (way @ (abs(matrix) @ way)))


def _made(run: EndedRun) -> Findings:
    ledger = run.recorder.ledger
    rises = (("energy_made_in_step", ledger.in_step), ("energy_made_in_run", ledger.in_run))
    waves = ledger.in_run.energy <= WAVES * ledger.throughput
    for name, rise in rises:
        share = rise.energy / ledger.throughput
        said = rise is ledger.in_run and rise.energy < SAME * ledger.in_step.energy
        bound = THRESHOLDS[name].fails
        assert bound is not None
        yield AuditFinding(
            name,
            share,
            _came(name, rise, share),
            cause(run, rise),
            # A wave that the integrator gives it takes again: it warns alone.
            mild=waves and rise.energy - rise.grown.given <= bound * ledger.throughput,
            told=said and _told(run),
        )


def _driven(run: EndedRun) -> AuditFinding:
    """Energy that dampers and friction gave in all, and matter in some steps.

    What depends on a velocity's sign lags behind.
    """
    ledger = run.recorder.ledger
    losses = {**ledger.damping_loss, "friction and bonds": ledger.friction_loss}
    losses["matter that flows"] = -ledger.material_gift
    given = {name: -loss for name, loss in losses.items() if loss < 0}
    most = sum(given.values())
    share = most / ledger.throughput
    return AuditFinding(
        "energy_made_by_damping",
        share,
        f"{most:.3g} J, {percent(share)} of the turnover, came from {' and '.join(given)}",
        "take smaller steps: what turns with a velocity or a stress comes a step late",
    )


def _told(run: EndedRun) -> bool:
    """Whether the rise in one step is worth a warning."""
    ledger = run.recorder.ledger
    return ledger.in_step.energy > THRESHOLDS["energy_made_in_step"].warns * ledger.throughput


def _came(name: str, rise: EnergyRise, share: float) -> str:
    span = "in step" if name == "energy_made_in_step" else "up to step"
    return (
        f"{rise.energy:.3g} J, {percent(share)} of the turnover, came from nowhere {span} "
        f"{rise.step}, at {rise.time:.6g} s"
    )


def _damped(run: EndedRun) -> Findings:
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


def _lost(run: EndedRun) -> Findings:
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
