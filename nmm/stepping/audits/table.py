"""The thresholds of all audits, in the order of their page."""

from nmm.stepping.audits.thresholds.base import Threshold
from nmm.stepping.audits.thresholds.cracks import CRACKS
from nmm.stepping.audits.thresholds.energies import ENERGIES
from nmm.stepping.audits.thresholds.increments import INCREMENTS
from nmm.stepping.audits.thresholds.motion import MOTION
from nmm.stepping.audits.thresholds.solution import SOLUTION

THRESHOLDS: dict[str, Threshold] = {
    **ENERGIES,
    **SOLUTION,
    **MOTION,
    **CRACKS,
    **INCREMENTS,
}


def markdown() -> str:
    """Return the table as a page shows it."""
    lines = ["| audit | what | warns above | fails above | which runs |", "|---|---|---|---|---|"]
    for name, row in THRESHOLDS.items():
        fails = "" if row.fails is None else f"{row.fails:g}"
        lines.append(f"| `{name}` | {row.what} | {row.warns:g} | {fails} | {row.where} |")
    return "\n".join(lines)
