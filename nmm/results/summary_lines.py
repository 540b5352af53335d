"""The summary of a run as a person reads it: a table, and a line about failure."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from nmm.results.summary import Summary

if TYPE_CHECKING:
    from rich.table import Table

# Ends at which the factor that was reached is no failure load.
ON_THE_WAY = ("failed", "collapsed", "budget_spent")


def failure_line(summary: Summary) -> str | None:
    """Return the failure load with its tolerance in words, None when the run has none.

    A run that failed did not look for one: the factor it reached is no failure load.
    """
    none = summary.failure_factor is None and summary.failure_load is None
    if none or summary.status in ON_THE_WAY:
        return None
    parts = []
    if summary.failure_load is not None:
        parts.append(f"load {_newton(summary.failure_load)}")
    if summary.failure_factor is not None:
        parts.append(f"load factor {summary.failure_factor:.5g}")
    text = "failure " + ", ".join(parts)
    if summary.failure_tolerance is not None:
        text += f"; none {100 * summary.failure_tolerance:.2g} % above it is in equilibrium"
    if summary.failure_bound is not None:
        bound = f"{summary.failure_bound:.5g}"
        text += f"; no more than load factor {bound} by the static theorem, as drawn"
    return text


def rows(summary: Summary) -> list[tuple[str, str]]:
    """Return label and text of every number that the run has measured."""
    listed: list[tuple[str, str | None]] = [
        ("blocks", f"{summary.blocks:,}"),
        ("elements", f"{summary.elements:,}"),
        ("unknowns", f"{summary.unknowns:,}"),
        ("cures", _counts(summary.cures)),
        ("steps", f"{summary.steps:,}"),
        ("smallest step", _or_none(summary.smallest_step, _second)),
        ("largest step", _or_none(summary.largest_step, _second)),
        ("rejected steps", _or_none(summary.rejected_steps, lambda v: f"{v:,}")),
        ("contact passes", f"{summary.passes:,}"),
        ("failure load", _or_none(summary.failure_load, _newton)),
        (
            "load factor reached" if summary.status in ON_THE_WAY else "failure load factor",
            _or_none(summary.failure_factor, _number),
        ),
        ("factor of safety", _or_none(summary.factor_of_safety, _number)),
        ("factor that fails", _or_none(summary.factor_that_fails, _number)),
        ("failure factor at most", _or_none(summary.failure_bound, _number)),
        ("equilibrium residual", _or_none(summary.equilibrium_residual, _number)),
        ("largest penetration", _or_none(summary.largest_penetration, _metre)),
        ("energy balance", _or_none(summary.energy_balance, _number)),
        ("energy added by changes, J", _or_none(summary.change_energy, _number)),
        ("energy of fracture, J", _or_none(summary.fracture_energy, _number)),
        ("energy freed by fracture, J", _or_none(summary.freed_energy, _number)),
        ("condition estimate", _or_none(summary.condition_estimate, _number)),
        ("contacts at most", _counts(summary.largest_contacts)),
        ("seconds", _seconds(summary.seconds)),
        ("seconds by effect", _shares(summary)),
        ("peak memory", _or_none(summary.peak_memory, lambda v: f"{v / 2**20:.0f} MiB")),
        ("seed", _or_none(summary.seed, str)),
        ("scene", summary.scene_hash[:12] or None),
        ("formulation", summary.formulation_hash[:12] or None),
    ]
    return [(label, text) for label, text in listed if text is not None]


def render(summary: Summary) -> "Table":
    """Return the summary as a rich table for the terminal."""
    from rich.table import Table

    table = Table(title=summary.title or None, show_header=False, title_justify="left")
    table.add_column(style="dim", no_wrap=True)
    table.add_column(overflow="fold")
    for label, text in rows(summary):
        table.add_row(label, text)
    return table


def _or_none(value: Any, text: Any) -> str | None:
    return None if value is None else str(text(value))


def _number(value: float) -> str:
    return f"{value:.4g}"


def _second(value: float) -> str:
    return f"{value:.3g} s"


def _metre(value: float) -> str:
    return f"{value:.3g} m"


def _newton(value: float) -> str:
    return f"{value / 1e3:.4g} kN" if abs(value) >= 1e3 else f"{value:.4g} N"


def _counts(counts: Mapping[str, int]) -> str | None:
    return ", ".join(f"{count:,} {name}" for name, count in counts.items() if count) or None


def _shares(summary: Summary) -> str | None:
    """Seconds of the effects and of all else, which sum to the run."""
    whole, known = sum(summary.seconds.values()), summary.effect_seconds
    if not known:
        return None
    return _seconds({**known, "all else": max(whole - sum(known.values()), 0.0)})


def _seconds(seconds: Mapping[str, float]) -> str | None:
    if not seconds:
        return None
    parts = ", ".join(f"{name} {value:.3g}" for name, value in seconds.items())
    return f"{sum(seconds.values()):.3g} ({parts})"
