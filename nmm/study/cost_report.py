"""The page, figure and raw records of a cost study."""

from pathlib import Path

import numpy as np

from nmm.study.cost import CostStudy, write_records
from nmm.study.front import LEVELS, costs_at_levels, front
from nmm.study.orders import observed_order
from nmm.study.record import Record


def write_cost_report(study: CostStudy, out: Path) -> list[Path]:
    """Write ``cost.md``, ``cost.png`` and ``records.jsonl`` into a folder; return their paths."""
    out.mkdir(parents=True, exist_ok=True)
    page, picture, raw = out / "cost.md", out / "cost.png", out / "records.jsonl"
    write_records(study.records, raw)
    draw(study, picture)
    page.write_text(cost_page(study, picture.name), encoding="utf-8")
    return [page, picture, raw]


def draw(study: CostStudy, path: Path) -> None:
    """Draw the work-precision figure."""
    from nmm.plots.work_precision import Series, work_precision

    best = front([one.median_seconds for one in study.records], _errors(study, study.records))
    on_front = dict(zip(map(id, study.records), best.tolist(), strict=True))
    series = {
        name: Series(
            error=_errors(study, many),
            seconds=[one.median_seconds for one in many],
            unknowns=[float(one.unknowns) for one in many],
            memory=[float(one.memory or np.nan) for one in many],
            on_front=[on_front[id(one)] for one in many],
            phases=many[-1].phases,
            failed=sum(not one.valid for one in many),
        )
        for name, many in study.by_formulation().items()
    }
    reference = study.reference
    size = abs(reference.value) or 1.0
    work_precision(
        series,
        title=study.title,
        error_name=f"relative error of {reference.quantity}",
        uncertainty=reference.uncertainty / size if "Richardson" in reference.source else 0.0,
        path=path,
    )


def cost_page(study: CostStudy, picture: str) -> str:
    """Return the page in Markdown."""
    reference = study.reference
    lines = [
        f"# What accuracy costs: {study.title or 'scene'}",
        "",
        f"Reference of `{reference.quantity}`: {reference.value:.8g} +- "
        f"{reference.uncertainty:.2g} ({reference.source}).",
        "",
        f"![work-precision]({picture})",
        "",
        "| formulation | settings | unknowns | steps | passes | seconds (median) | memory | value |"
        " relative error | verdict |",
        "|---|---|---|---|---|---|---|---|---|---|",
        *(_row(study, one) for one in study.records),
        "",
        *_orders(study),
        "",
        *_levels(study),
        "",
        *_conditions(study),
    ]
    return "\n".join(lines) + "\n"


def _row(study: CostStudy, one: Record) -> str:
    settings = ", ".join(f"{key.rpartition('.')[2]} {value}" for key, value in one.settings.items())
    value = one.quantities.get(study.reference.quantity, np.nan)
    memory = "" if one.memory is None else f"{one.memory / 2**20:.0f} MiB"
    return (
        f"| {one.name} | {settings} | {one.unknowns} | {one.steps} | {one.passes} | "
        f"{one.median_seconds:.3g} | {memory} | {value:.7g} | {study.error(one):.2e} | "
        f"{one.status if one.valid else f'**{one.status}**: {one.sentence}'} |"
    )


def _orders(study: CostStudy) -> list[str]:
    """Observed orders in the size that carries an unknown, the root of their number."""
    lines = []
    for name, many in study.by_formulation().items():
        sizes = [one.unknowns**-0.5 for one in many if one.unknowns]
        if len(set(sizes)) > 1:
            order = observed_order(sizes, [study.error(one) for one in many if one.unknowns])
            lines.append(f"- observed order of {name} in unknowns^(-1/2): {order}")
    return lines


def _levels(study: CostStudy) -> list[str]:
    """Sentences: at error e, A costs r times B."""
    points = {
        name: ([one.median_seconds for one in many], _errors(study, many))
        for name, many in study.by_formulation().items()
    }
    costs = costs_at_levels(points)
    lines = []
    for number, level in enumerate(LEVELS):
        at = {name: cost[number] for name, cost in costs.items() if np.isfinite(cost[number])}
        if len(at) > 1:
            best = min(at, key=lambda name: at[name])
            ratios = ", ".join(
                f"{name} {at[name] / at[best]:.2g} times" for name in at if name != best
            )
            lines.append(f"- at error {level:g}, {best} costs {at[best]:.3g} s; {ratios} that")
    return lines


def _conditions(study: CostStudy) -> list[str]:
    first = next((one for one in study.records if one.versions), None)
    if first is None:
        return ["No run was measured."]
    versions = ", ".join(f"{name} {version}" for name, version in first.versions.items())
    repeats = max(len(one.seconds) for one in study.records)
    wall = [w / c for one in study.records for w, c in zip(one.wall, one.seconds, strict=True) if c]
    return [
        f"Medians of {repeats} repeats after a warm-up, all runs in turn, processor seconds; wall "
        f"over processor seconds {np.median(wall):.2f} (median). {first.machine}; {versions}. Raw "
        "records with scene and formulation hashes: `records.jsonl`.",
    ]


def _errors(study: CostStudy, records: list[Record]) -> list[float]:
    return [study.error(one) if one.valid else float("nan") for one in records]
