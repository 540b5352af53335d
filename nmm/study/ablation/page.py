"""An ablation as a table in Markdown."""

from nmm.study.ablation.ablate import Ablation

LONGEST = 110
"""Letters of a verdict on the page; a fault may have more."""


def ablation_table(found: Ablation) -> list[str]:
    """Return the lines of a table: what was left out, changes of the quantities, seconds saved."""
    heads = ["without", *found.quantities, "seconds", "saved", "ends"]
    lines = ["| " + " | ".join(heads) + " |", "|---" * len(heads) + "|"]
    whole = [f"{value:.6g}" for value in found.whole.values]
    lines.append(_line([found.whole.name, *whole, f"{found.whole.seconds:.3g}", "", ""]))
    for row in found.rows:
        changes = [_share(change) for change in found.changes(row)]
        seconds = "" if row.seconds != row.seconds else f"{row.seconds:.3g}"
        verdict = row.verdict.replace("|", "/")[:LONGEST]
        lines.append(_line([row.name, *changes, seconds, _share(found.saved(row)), verdict]))
    return lines


def _line(cells: list[str]) -> str:
    return "| " + " | ".join(cells) + " |"


def _share(value: float) -> str:
    return "" if value != value else f"{100 * value:+.3g} %"
