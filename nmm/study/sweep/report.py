"""Summary of a sweep: mean, standard deviation and their ratio by group, as Markdown and CSV."""

import csv
import io
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from nmm.study.cases.record import Record
from nmm.study.sweep.runs import Sweep


@dataclass(frozen=True)
class Group:
    """Values of one quantity over an ensemble.

    Attributes
    ----------
    name, settings
        Formulation, and what the cases of the group share.
    quantity, values
        The quantity, and its values where runs were valid.
    failed
        Runs that gave none.
    seconds
        Processor seconds of all runs.
    """

    name: str
    settings: tuple[tuple[str, object], ...]
    quantity: str
    values: tuple[float, ...]
    failed: int
    seconds: float

    @property
    def mean(self) -> float:
        """Mean; nan of nothing."""
        return float(np.mean(self.values)) if self.values else float("nan")

    @property
    def deviation(self) -> float:
        """Standard deviation of the sample; nan of fewer than two."""
        return float(np.std(self.values, ddof=1)) if len(self.values) > 1 else float("nan")

    @property
    def variation(self) -> float:
        """Coefficient of variation."""
        return self.deviation / abs(self.mean) if self.mean else float("nan")


HEADS = (
    "formulation",
    "settings",
    "quantity",
    "runs",
    "failed",
    "mean",
    "standard deviation",
    "CoV",
    "least",
    "largest",
    "processor seconds",
)


def groups(sweep: Sweep) -> list[Group]:
    """Return one group for each formulation, setting outside the ensemble, and quantity."""
    over = set(sweep.plan.over)
    together: dict[tuple[str, tuple[tuple[str, object], ...]], list[Record]] = {}
    for one in sweep.records:
        shared = tuple((key, value) for key, value in one.settings.items() if key not in over)
        together.setdefault((one.name, shared), []).append(one)
    return [
        _group(name, shared, quantity, many)
        for (name, shared), many in together.items()
        for quantity in sweep.plan.quantities
    ]


def _group(
    name: str, shared: tuple[tuple[str, object], ...], quantity: str, many: Sequence[Record]
) -> Group:
    found = [one.quantities.get(quantity, np.nan) if one.valid else np.nan for one in many]
    values = tuple(float(value) for value in found if np.isfinite(value))
    seconds = float(np.nansum([one.median_seconds for one in many]))
    return Group(name, shared, quantity, values, len(many) - len(values), seconds)


def write_sweep(sweep: Sweep, out: Path) -> list[Path]:
    """Write ``study.md``, ``study.csv`` (groups) and ``cases.csv`` (all cases)."""
    page, table, cases = out / "study.md", out / "study.csv", out / "cases.csv"
    out.mkdir(parents=True, exist_ok=True)
    page.write_text(sweep_page(sweep), encoding="utf-8")
    table.write_text(_csv([HEADS, *(_cells(one) for one in groups(sweep))]), encoding="utf-8")
    cases.write_text(_csv(list(_case_rows(sweep))), encoding="utf-8")
    return [page, table, cases]


def sweep_page(sweep: Sweep) -> str:
    """Return the page in Markdown."""
    failed = [one for one in sweep.records if not one.valid]
    first = next((one for one in sweep.records if one.versions), None)
    lines = [
        f"# {sweep.plan.title or 'Study'}",
        "",
        f"{len(sweep.records)} cases, {len(failed)} failed.",
        "",
        f"| {' | '.join(HEADS)} |",
        f"|{'---|' * len(HEADS)}",
        *(f"| {' | '.join(_cells(one))} |" for one in groups(sweep)),
        "",
        *(f"- {one.label}: **{one.status}**: {one.sentence}" for one in failed),
    ]
    if first is not None:
        versions = ", ".join(f"{name} {version}" for name, version in first.versions.items())
        lines += ["", f"{first.machine}; {versions}. Cases, one a row: `cases.csv`."]
    return "\n".join(lines) + "\n"


def _cells(group: Group) -> tuple[str, ...]:
    values = group.values or (float("nan"),)
    return (
        group.name,
        ", ".join(f"{key} = {value}" for key, value in group.settings),
        group.quantity,
        str(len(group.values) + group.failed),
        str(group.failed),
        *(
            _text(value)
            for value in (group.mean, group.deviation, group.variation, min(values), max(values))
        ),
        f"{group.seconds:.3g}",
    )


def _text(value: float) -> str:
    return f"{value:.6g}" if np.isfinite(value) else ""


def _case_rows(sweep: Sweep) -> Iterator[tuple[str, ...]]:
    keys = list(dict.fromkeys(key for one in sweep.records for key in one.settings))
    yield ("key", "formulation", *keys, "status", *sweep.plan.quantities, "unknowns", "seconds")
    for one in sweep.records:
        yield (
            one.key[:12],
            one.name,
            *(str(one.settings.get(key, "")) for key in keys),
            one.status,
            *(repr(one.quantities.get(name, float("nan"))) for name in sweep.plan.quantities),
            str(one.unknowns),
            f"{one.median_seconds:.4g}",
        )


def _csv(rows: Sequence[Sequence[str]]) -> str:
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue()
