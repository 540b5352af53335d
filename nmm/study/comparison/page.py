"""The page of a comparison: a table of what each run came to, and how far they differ."""

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from integration.arrays import Floats
from nmm.results.storage.writing import told, write_text
from nmm.study.cases.measure import machine
from nmm.study.comparison.drawing import draw, last_frame
from nmm.study.comparison.runs import LONG, Compared, Comparison


def write_comparison(study: Comparison, out: Path) -> list[Path]:
    """Write ``compare.md`` and ``compare.png`` into a folder; return their paths."""
    with told(out):
        out.mkdir(parents=True, exist_ok=True)
    page, picture = out / "compare.md", out / "compare.png"
    draw(study, picture)
    write_text(page, comparison_page(study, picture.name))
    return [page, picture]


def comparison_page(study: Comparison, picture: str) -> str:
    """Return the page in Markdown."""
    names = [one.name for one in study.runs]
    lines = [
        f"# {study.title or 'scene'}: {', '.join(names)}",
        "",
        f"![{' and '.join(names)}]({picture})",
        "",
        f"| | {' | '.join(names)} |",
        f"|---|{'---|' * len(names)}",
        *(_row(words, study.runs, read) for words, read in ROWS),
        "",
        *_distances(study),
        "",
        *(f"- {one.name}: {one.fault or _sentence(one)}" for one in study.runs),
        "",
        f"Displacement and stress are taken at {len(study.raster.points):,} common points. Colour "
        "scales hold 99.5 % of the values. Seconds are processor seconds of one run, a second one "
        f"where it takes less than {LONG:g}; memory is what a run adds to a fresh process at its "
        f"peak. {machine()}.",
    ]
    return "\n".join(lines) + "\n"


def _row(
    words: str, runs: Sequence[Compared], read: "Callable[[Compared], float | int | str | None]"
) -> str:
    return f"| {words} | {' | '.join(_text(read(one)) for one in runs)} |"


def _of(name: str) -> "Callable[[Compared], float | int | str | None]":
    """Return what reads a number off the summary."""
    return lambda one: None if one.run is None else getattr(one.run.summary, name)


def _energy(one: Compared) -> float | None:
    return None if one.run is None else _last(one.run.history.get("strain_energy"))


def _largest_load(one: Compared) -> float | None:
    """Of loads that grow: in statics, where one increment may bring them, or on a path."""
    if one.run is None or not len(factors := one.run.history["load_factor"]):
        return None
    grow = np.ptp(factors) > 0 or not one.in_time
    return float(np.nanmax(factors)) if grow else None


def _released(one: Compared) -> float | None:
    """Energy (J) that cracks, broken bonds and friction took."""
    if one.run is None:
        return None
    taken = [_last(one.run.history.get(name)) for name in RELEASED]
    return sum((value for value in taken if value is not None), 0.0)


def _largest_contact(one: Compared) -> float | None:
    if one.run is None or not len(force := last_frame(one.run).contact_force):
        return None
    return float(np.hypot(*force.T).max())


# What friction and bonds took, and what cracks of a given toughness did (J).
RELEASED = ("friction_loss", "fracture:energy", "fracture in time:energy")
ROWS: tuple[tuple[str, "Callable[[Compared], float | int | str | None]"], ...] = (
    ("family", lambda one: one.family),
    ("verdict", lambda one: "error" if one.run is None else one.run.summary.status),
    ("failure load (N)", _of("failure_load")),
    ("failure load factor", _of("failure_factor")),
    ("largest load factor", _largest_load),
    ("energy released (J)", _released),
    ("elastic energy at the end (J)", _energy),
    ("largest contact force at the end (N)", _largest_contact),
    ("elements", _of("elements")),
    ("unknowns", _of("unknowns")),
    ("steps", _of("steps")),
    ("contact passes", _of("passes")),
    ("processor seconds", lambda one: one.seconds),
    ("memory (MiB)", lambda one: None if one.memory is None else one.memory / 2**20),
)


def _text(value: float | int | str | None) -> str:
    if value is None or value != value:
        return "-"
    if isinstance(value, float):
        return f"{value:.5g}"
    return value if isinstance(value, str) else f"{value:,}"


def _sentence(one: Compared) -> str:
    return "" if one.run is None else one.run.summary.sentence


def _distances(study: Comparison) -> list[str]:
    """Root mean square difference from the first run over the root mean square of the first."""
    made = study.made
    first, _, base = made[0]
    lines = []
    for one, _, other in made[1:]:
        moved = _distance(other.displacement, base.displacement)
        stress = _distance(other.stress, base.stress)
        lines.append(
            f"- {one.name} differs from {first.name} by {100 * moved:.3g} % in displacement and "
            f"{100 * stress:.3g} % in stress (root mean square over the common points)"
        )
    return lines


def _distance(other: Floats, base: Floats) -> float:
    # One of them may have no block where the other has one: a stage has removed it.
    common = ~np.isnan(other) & ~np.isnan(base)
    size = float(np.linalg.norm(base[common]))
    return float(np.linalg.norm((other - base)[common])) / size if size else float("nan")


def _last(column: Floats | None) -> float | None:
    return None if column is None or not len(column) else float(column[-1])
