"""Whether a path is the only one, or joints of one strength soften together on it."""

from nmm.stepping.audits.base import AuditFinding, EndedRun, Findings


def paths(run: EndedRun) -> Findings:
    """Audit how many ways a path past its peak could have gone."""
    if run.scene.loading is None or run.scene.loading.control is None:
        return
    totals = run.recorder.totals
    yield AuditFinding(
        "unstable_ways",
        float(totals.ways),
        f"from load factor {totals.alike or 0.0:.6g} on this path is one of several: what softens "
        f"together gives way in {totals.ways} independent ways, and whatever is controlled holds "
        "but one. On another path some of it unloads, and less energy is taken",
        "give the joint that is to open a strength lower by 1e-3, or both ends of a joint that "
        "are to open alike a support that keeps them from turning",
    )
