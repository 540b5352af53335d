"""Blocks that stay whole beyond their strength, and energy that goes as others split."""

from nmm.stepping.audits.base import AuditFinding, EndedRun, Findings, percent


def splitting(run: EndedRun) -> Findings:
    """Audit the use of strength of the blocks that were judged last, and the energy of splits."""
    blocks = run.stepper.plan.splitting
    if blocks is None:
        return
    kept = blocks.kept
    yield AuditFinding(
        "kept_whole",
        kept.use,
        f"[splitting] keeps whole {kept.blocks} block{'s' * (kept.blocks > 1)} beyond the "
        f"strength, by up to {kept.use:.3g} times, for pieces would be too small or too many",
        "lower smallest_block below the size of cells, or raise most_blocks; what such blocks "
        "carry is not to be relied on",
    )
    ledger = run.recorder.ledger
    alone = run.scene.fracture is None and not run.scene.stages
    if not (run.dynamic and alone and ledger.throughput):
        return
    added = ledger.change_energy / ledger.throughput
    word = "added" if added > 0 else "took"
    yield AuditFinding(
        "split_energy",
        abs(added),
        f"cuts of blocks that split {word} {percent(abs(added))} of the turnover: springs of "
        "contact on a face hold less energy with the same force where more of them share it",
        "raise [contact] normal_penalty, so that springs hold little, and take smaller steps",
    )
