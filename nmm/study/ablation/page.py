"""An ablation as a table in Markdown."""

import numpy as np

from nmm.study.ablation.ablate import Ablation

LONGEST = 110
"""Letters of a verdict on the page; a fault may have more."""
SEEN = 1e-3
"""Share of the quantities from which a change is said to matter."""
LONG = 0.1
"""Share of the seconds from which an effect is said to take long; they scatter by less."""


def ablation_table(found: Ablation) -> list[str]:
    """Return the lines of a table: what was left out, changes of the quantities, seconds saved."""
    heads = ["without", *found.quantities, "seconds", "saved", "ends"]
    lines = ["| " + " | ".join(heads) + " |", "|---" * len(heads) + "|"]
    whole = [f"{0 if abs(value) <= least else value:.6g}" for _, value, least in _whole(found)]
    seconds = f"{found.whole.seconds:.3g}"
    lines.append(_line([found.whole.name, *whole, seconds, "", found.whole.verdict]))
    for row in found.rows:
        changes = [_share(change) for change in found.changes(row)]
        seconds = "" if row.seconds != row.seconds else f"{row.seconds:.3g}"
        verdict = row.verdict.replace("|", "/")[:LONGEST]
        lines.append(_line([row.name, *changes, seconds, _share(found.saved(row)), verdict]))
    return lines


def ablation_verdict(found: Ablation) -> str:
    """Return in a sentence what matters, most first, and what changes nothing that is seen."""
    sizes = {row.name: np.abs(found.changes(row)) for row in found.rows}
    most = {name: float(size.max()) for name, size in sizes.items() if not np.isnan(size).any()}
    order = sorted(most, key=lambda name: -most[name])
    matter = [f"{row.name} ({row.verdict} without)" for row in found.rows if found.ends(row)]
    matter += [f"{name} ({_size(most[name])})" for name in order if most[name] >= SEEN]
    rest = [name for name in order if most[name] < SEEN]
    said = f"matters: {', '.join(matter) or 'none'}"
    return f"{said}; below {100 * SEEN:g} %: {', '.join(rest) or 'none'}"


def ablation_costs(found: Ablation) -> str:
    """Return in a sentence what takes long, most first, of what the scene ends alike without."""
    alike = [row for row in found.rows if row.verdict == found.whole.verdict]
    saved = {row.name: found.saved(row) for row in alike if found.saved(row) >= LONG}
    order = sorted(saved, key=lambda name: -saved[name])
    long = ", ".join(f"{name} ({100 * saved[name]:.3g} % of the seconds)" for name in order)
    return f"takes long: {long or f'no effect, none {100 * LONG:g} % of the seconds'}"


def _line(cells: list[str]) -> str:
    return "| " + " | ".join(cells) + " |"


def ablation_rounding(found: Ablation) -> str:
    """Return in a sentence which quantities of the whole scene are rounding; empty if none is."""
    whole = _whole(found)
    none = [f"{name} (below {least:.2g})" for name, value, least in whole if abs(value) <= least]
    return f"rounding in the whole scene, shown as 0: {', '.join(none)}" if none else ""


def _whole(found: Ablation) -> list[tuple[str, float, float]]:
    """Names, values of the whole scene, and the sizes up to which these are rounding."""
    pairs = zip(found.quantities, found.whole.values, strict=True)
    return [(name, value, found.rounding(name)) for name, value in pairs]


def _size(share: float) -> str:
    return "from nothing" if np.isinf(share) else f"{100 * share:.3g} %"


def _share(value: float) -> str:
    """A share in words; what becomes something from nothing has none."""
    if value != value:
        return ""
    return "from 0" if np.isinf(value) else f"{100 * value:+.3g} %" if value else "0"
