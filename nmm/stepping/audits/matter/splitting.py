"""Blocks that stay whole beyond their strength, as pieces would be too small or too many."""

from nmm.stepping.audits.base import AuditFinding, EndedRun, Findings


def splitting(run: EndedRun) -> Findings:
    """Audit how far the state that was judged last is beyond the strength of its blocks."""
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
