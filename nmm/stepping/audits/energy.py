"""Energy that came from nowhere, and work that was not stored."""

from typing import TYPE_CHECKING

import numpy as np

from nmm.stepping.audits.base import AuditFinding, EndedRun, Findings, percent
from nmm.stepping.audits.causes import cause
from nmm.stepping.audits.lost_energy import damped, lost
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
        yield from lost(run)
        yield from damped(run)
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
        "take smaller steps, or an integrator that damps waves they do not resolve: what turns "
        "with a velocity or a stress comes a step late",
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
