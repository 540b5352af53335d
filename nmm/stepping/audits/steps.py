"""Steps: in time against impacts, of loads against what they are to find."""

import numpy as np

from nmm.stepping.audits.base import AuditFinding, EndedRun, Findings, percent
from nmm.stepping.drive.verdict import FAILURE

# Share of the turnover lost by contact from which on its duration counts.
LOST_BY_CONTACT = 0.01
# Increments in which friction may slide unseen.
FEW = 10


def steps(run: EndedRun) -> Findings:
    """Audit time steps and load increments."""
    yield from _impacts(run) if run.dynamic else _increments(run)
    yield from _records(run) if run.dynamic else ()
    yield from _rebounds(run) if run.dynamic else ()
    yield from _unresolved(run)


def _unresolved(run: EndedRun) -> Findings:
    """Tell steps that erred by more than was asked for and were to be no shorter."""
    lengths = run.recorder.totals.lengths
    if lengths is not None and lengths.unresolved:
        yield AuditFinding(
            "step_error",
            float(lengths.unresolved),
            f"{lengths.unresolved} steps of the shortest length, down to {lengths.smallest:.2g} s, "
            "erred by more than [integrator] error",
            "contact that jumps is resolved by springs only; else lower [integrator] shortest",
        )


def _records(run: EndedRun) -> Findings:
    """Tell records whose samples the steps pass over."""
    step = run.longest_step
    for name, effect in run.stepper.plan.effects.items():
        if effect.resolves is not None:
            yield AuditFinding(
                "record_step",
                step / effect.resolves,
                f"{name}: a record has samples every {effect.resolves:.3g} s, a step is {step:g} s",
                f"take steps of at most {effect.resolves / 2:.3g} s, or a coarser record",
            )


def impact_lasts(run: EndedRun) -> float | None:
    """Return how long (s) an impact of the lightest body lasts, about; None without springs.

    Half a period of its mass on two of the stiffest springs that pressed in the run.
    """
    stiffest, model = run.recorder.totals.stiffest, run.stepper.model
    mass = np.bincount(model.manifold.element_body, model.density * model.element_area)
    heavy = mass[mass > 0]
    if stiffest == 0 or not len(heavy):
        return None
    return float(np.pi * np.sqrt(float(heavy.min()) * model.thickness / (2 * stiffest)))


def _impacts(run: EndedRun) -> Findings:
    ledger, step = run.recorder.ledger, run.formulation.integrator.fixed_step
    lasts = impact_lasts(run)
    if run.formulation.integrator.kinetic_factor < 1 or lasts is None or step is None:
        return
    if ledger.contact_loss <= LOST_BY_CONTACT * ledger.throughput:
        return
    yield AuditFinding(
        "contact_duration",
        step / lasts,
        f"springs of contact lost {percent(ledger.contact_loss / ledger.throughput)} of the "
        f"turnover: an impact of the lightest body lasts some {lasts:.2g} s, a step {step:g} s",
        f"take steps of {lasts / 10:.2g} s, or a lower [contact] normal_penalty",
    )


def _rebounds(run: EndedRun) -> Findings:
    """Tell bodies that met and parted in one step: how fast depends on where in it they met."""
    totals, contact = run.recorder.totals, run.stepper.plan.contact
    turnover = run.recorder.ledger.throughput
    if contact is None or not contact.exact or not turnover:
        return
    share = totals.rebound / turnover
    yield AuditFinding(
        "rebound_in_step",
        share,
        f"{totals.thrown}, within one step, with {percent(share)} of the turnover: so fast they "
        "part by where in the step they met, and rigid bodies would stay together",
        'take [contact] enforcement = "penalty" and steps that resolve the impact on its springs',
    )


def _increments(run: EndedRun) -> Findings:
    verdict, asked = run.verdict, run.formulation.loading.tolerance
    if verdict.code == FAILURE and verdict.tolerance is not None:
        yield AuditFinding(
            "failure_tolerance",
            verdict.tolerance / asked,
            f"the failure load is known within {percent(verdict.tolerance)} only, "
            f"{percent(asked)} were asked for",
            "lower [loading] increment",
        )
    loading, recorder = run.scene.loading, run.recorder
    most = recorder.totals.largest
    # What slides without friction is nowhere held by its path.
    depends = most.get("broken", 0) or (most.get("slide", 0) and recorder.ledger.friction_loss)
    if loading is not None and loading.until != "failure" and depends and recorder.steps:
        yield AuditFinding(
            "increments",
            FEW / recorder.steps,
            f"friction slid or bonds broke in a path of {recorder.steps} increments, on which the "
            "answer depends",
            "halve [loading] increment and compare",
        )
    if run.scene.initial_stresses and recorder.ledger.throughput:
        taken = recorder.ledger.friction_first / recorder.ledger.throughput
        yield AuditFinding(
            "first_increment",
            taken,
            f"friction slid and took {percent(taken)} of the turnover in the first increment, in "
            "which initial stress acts at once: forces and places depend on how it came to be",
            "give stresses that joints bear, or compare with a first stage in which joints stick",
        )
