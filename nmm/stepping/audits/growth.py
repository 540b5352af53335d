"""What growing cracks free, beside what their toughness takes."""

from nmm.stepping.audits.base import AuditFinding, Ended, Findings, percent


def growth(run: Ended) -> Findings:
    """Audit the energy of cracks whose load keeps them at their toughness."""
    cracks, ledger = run.stepper.plan.fracture, run.recorder.ledger
    if cracks is None or not cracks.at_toughness or not ledger.throughput:
        return
    missed = (run.recorder.freed_by(cracks) - cracks.energy_taken) / ledger.throughput
    word = "more" if missed > 0 else "less"
    yield AuditFinding(
        "growth_energy",
        abs(missed),
        f"growth freed {percent(abs(missed))} {word} of the largest energy than the toughness took",
        "pieces or cells are long where cracks kink or a ligament is short: take shorter ones",
    )
