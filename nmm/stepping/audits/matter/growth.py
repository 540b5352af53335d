"""Audits of crack growth: zigzag paths, crowded tips, nuclei that do not fit, energy freed."""

import math

from nmm.stepping.audits.base import AuditFinding, EndedRun, Findings, percent


def growth(run: EndedRun) -> Findings:
    """Audit the paths of cracks, and their energy where the load keeps them at their toughness."""
    cracks, ledger = run.stepper.plan.fracture, run.recorder.ledger
    if cracks is None:
        return
    swing = cracks.swing
    yield AuditFinding(
        "growth_swing",
        swing,
        f"the path of a crack swings: pieces turn to and fro by {math.degrees(swing):.0f} degrees",
        "add parallel_stress = true to [fracture], or take shorter pieces",
    )
    yield AuditFinding(
        "crowded_tips",
        cracks.crowded,
        "cracks or edges lie so few cells beside a tip that its intensities are 1 to 4 % off",
        "take cells of at most half the distance between a tip and what lies beside it",
    )
    unopened = cracks.unopened_strength_ratio(run.state)
    yield AuditFinding(
        "nucleation_length",
        unopened,
        f"the stress was {unopened:.3g} of the strength, and no crack could begin: no body holds a "
        "line as long as the mean across it",
        "give [fracture.nucleation] a smaller length, or check toughness and strength, from which "
        "it follows",
    )
    if not ledger.throughput:
        return
    if run.dynamic and not run.scene.stages:
        added = ledger.change_energy / ledger.throughput
        word = "added" if added > 0 else "took"
        yield AuditFinding(
            "growth_projection",
            abs(added),
            f"laying functions about grown tips anew {word} {percent(abs(added))} of the turnover",
            "take cells that are small beside the pieces of cracks and what is left to supports",
        )
    if not cracks.at_toughness:
        return
    missed = (run.recorder.freed_by(cracks) - cracks.energy_taken) / ledger.throughput
    word = "more" if missed > 0 else "less"
    yield AuditFinding(
        "growth_energy",
        abs(missed),
        f"growth freed {percent(abs(missed))} {word} of the largest energy than the toughness took",
        "pieces or cells are long where cracks kink or a ligament is short: take shorter ones",
    )
