"""All audits of a run, and what they make of its verdict."""

from collections.abc import Callable
from dataclasses import replace

from nmm.errors import SolveError
from nmm.stepping.audits.balance import balance
from nmm.stepping.audits.base import AuditFinding, EndedRun, Findings
from nmm.stepping.audits.bodies import bodies
from nmm.stepping.audits.energy import energy
from nmm.stepping.audits.equations import equations
from nmm.stepping.audits.fields import fields
from nmm.stepping.audits.histories import histories
from nmm.stepping.audits.matter.closed_cracks import closed_cracks
from nmm.stepping.audits.matter.ellipticity import ellipticity
from nmm.stepping.audits.matter.growth import growth
from nmm.stepping.audits.matter.softening import softening
from nmm.stepping.audits.matter.splitting import splitting
from nmm.stepping.audits.matter.strains import strains
from nmm.stepping.audits.paths import paths
from nmm.stepping.audits.steps import steps
from nmm.stepping.audits.supports import supports
from nmm.stepping.drive.verdict import CONVERGED, FAILURE, UNBALANCED, RunVerdict

AUDITS: tuple[Callable[[EndedRun], Findings], ...] = (
    energy,
    equations,
    balance,
    fields,
    histories,
    bodies,
    growth,
    closed_cracks,
    ellipticity,
    paths,
    softening,
    splitting,
    steps,
    strains,
    supports,
)


def audit(run: EndedRun) -> list[AuditFinding]:
    """Return every number that an audit has measured; nothing of a run without a step."""
    if not run.recorder.steps:
        return []
    return [finding for one in AUDITS for finding in _made(one, run)]


def _made(one: Callable[[EndedRun], Findings], run: EndedRun) -> Findings:
    """Yield what an audit finds; that the last state lets it ask no more is a finding too."""
    try:
        yield from one(run)
    except SolveError as fault:
        yield AuditFinding(
            "not_audited",
            1.0,
            f"the audits of {one.__name__.replace('_', ' ')} ended at the last state: {fault}",
            "nothing says that they would have passed; end the run a step earlier",
        )


def judged(verdict: RunVerdict, findings: list[AuditFinding]) -> RunVerdict:
    """Return the verdict, which is "unbalanced" where the audit of a solved run failed."""
    failed = [finding.where for finding in findings if finding.fails]
    if verdict.code not in (CONVERGED, FAILURE) or not failed:
        return verdict
    sentence = f"{verdict.sentence}; the answer is not to be relied on: {'; '.join(failed)}"
    return replace(verdict, code=UNBALANCED, sentence=sentence)
