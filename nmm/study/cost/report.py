"""The page of a cost study, written beside its figure and raw records."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from nmm.study.cases.record import Record, finest
from nmm.study.cases.variants import SIZE
from nmm.study.cost.cost_study import CostStudy, write_records
from nmm.study.cost.figure import draw
from nmm.study.cost.levels import level_table
from nmm.study.cost.orders import Order, observed_order
from nmm.study.cost.reference import UNKNOWNS, size_name, sizes_of
from nmm.study.cost.theory import order_in_size, order_in_step

# Relative errors up to this one are rounding, and fall with nothing.
ROUNDING_ERROR = 1e-12
# Wall over processor seconds above which something else took the processor.
DISTURBED = 1.3


def write_cost_report(study: CostStudy, out: Path) -> list[Path]:
    """Write ``cost.md``, ``cost.png`` and ``records.jsonl`` into a folder; return their paths."""
    out.mkdir(parents=True, exist_ok=True)
    page, picture, raw = out / "cost.md", out / "cost.png", out / "records.jsonl"
    write_records(study.records, raw)
    draw(study, picture)
    page.write_text(cost_page(study, picture.name), encoding="utf-8")
    return [page, picture, raw]


def cost_page(study: CostStudy, picture: str) -> str:
    """Return the page in Markdown."""
    reference = study.reference
    front = study.front()
    spread = "uncertainty" if reference.extrapolated else "tolerance"
    lines = [
        f"# What accuracy costs: {study.title or 'scene'}",
        "",
        f"Reference of `{reference.quantity}`: {reference.value:.8g}, {spread} "
        f"{reference.uncertainty:.2g} ({reference.source}).",
        *_shaded(study),
        "",
        f"![work-precision]({picture})",
        "",
        "| formulation | settings | unknowns | steps | passes | seconds: median | least | memory |"
        f" value | {reference.kind_of_error} | front | verdict |",
        "|---|---|---|---|---|---|---|---|---|---|---|---|",
        *(_row(study, one, one in front) for one in study.records),
        "",
        *_section("Observed orders", _orders(study)),
        *_section("Where the runs go", _limits(study)),
        *_section("Failed runs", _failed(study)),
        *_section("Time by effect, wall clock", _effects(study)),
        *_section("Cost at equal error", level_table(study)),
        *_section("How it was measured", _conditions(study)),
    ]
    return "\n".join(lines).rstrip() + "\n"


def _section(title: str, lines: Sequence[str]) -> list[str]:
    return [f"## {title}", "", *lines, ""] if lines else []


def _row(study: CostStudy, one: Record, best: bool) -> str:
    settings = ", ".join(f"{key.rpartition('.')[2]} {value}" for key, value in one.settings.items())
    value = one.quantities.get(study.reference.quantity, np.nan)
    error = study.error(one)
    memory = "" if one.memory is None else f"{one.memory / 2**20:.0f} MiB"
    seconds = [f"{one.median_seconds:.3g}", f"{min(one.seconds):.3g}"] if one.seconds else ["", ""]
    cells = [
        one.name,
        settings,
        f"{one.unknowns:,}" if one.unknowns else "",
        str(one.steps or ""),
        str(one.passes or ""),
        *seconds,
        memory,
        f"{value:.7g}" if np.isfinite(value) else "",
        f"{error:.2e}" if np.isfinite(error) and one.valid else "",
        "front" if best else "",
        one.status if one.valid else f"**{one.status}**",
    ]
    return f"| {' | '.join(cells)} |"


def _orders(study: CostStudy) -> list[str]:
    """Observed orders with their confidence, of errors above rounding and the uncertainty."""
    lines = []
    exact = ROUNDING_ERROR if study.reference.value else 0.0
    for name, many in study.by_formulation().items():
        valid = [one for one in many if one.valid]
        used = [one for one in valid if study.error(one) > max(study.floor, exact)]
        if len(used) < 2:
            if len(valid) > 1 and all(study.error(one) <= exact for one in valid):
                lines.append(f"- {name}: no order, its errors are rounding")
            continue
        sizes = sizes_of(used)
        order = observed_order(sizes, [study.error(one) for one in used])
        if order.points > 1 and np.isfinite(order.value):
            told = _theory(study, used, order)
            lines.append(f"- {name}: {order} in {size_name(used)}{told}")
    return lines


def _theory(study: CostStudy, records: Sequence[Record], order: Order) -> str:
    """Say what order theory promises, and whether it lies within the confidence."""
    method = records[0].method
    name = size_name(records)
    if name in (UNKNOWNS, SIZE):
        found = order_in_size(records[0].spanned, study.reference.quantity, study.exponent)
        where = "for a smooth solution" if study.exponent is None else "at the corner"
    elif name.endswith("integrator.step"):
        found, where = order_in_step(method), "while contacts stay as they are"
    else:
        found = None
    if found is None:
        return ""
    promised, formula = found
    within = abs(order.value - promised) <= order.deviation
    side = "within" if within else "above" if order.value > promised else "below"
    verdict = f", observed {side} it" if np.isfinite(order.deviation) else ""
    return f"; theory {promised:g} = {formula} {where}{verdict}"


def _limits(study: CostStudy) -> list[str]:
    """Whether formulations go to one value: a modelling error does not fall with size."""
    reference = study.reference
    return [
        f"- {name}: {limit.value:.8g}, uncertainty {limit.uncertainty:.2g}; "
        f"{(limit.value - reference.value) / (abs(reference.value) or 1.0):+.2e} from the reference"
        for name, limit in reference.limits.items()
    ]


def _effects(study: CostStudy) -> list[str]:
    """Wall-clock seconds of the dearest run of each formulation by effect."""
    lines = []
    for many in study.by_formulation().values():
        one = finest(many)
        spent = ", ".join(f"{effect} {seconds:.2g} s" for effect, seconds in one.by_effect.items())
        if spent:
            lines.append(f"- {one.label}: {spent}")
    return lines


def _failed(study: CostStudy) -> list[str]:
    return [f"- {one.label}: {one.sentence}" for one in study.records if not one.valid]


def _shaded(study: CostStudy) -> list[str]:
    floor = study.floor
    low = [one for one in study.records if one.valid and study.error(one) < floor]
    if not low:
        return []
    return [f'{len(low)} errors lie below that uncertainty and mean no more than "less than it".']


def _conditions(study: CostStudy) -> list[str]:
    first = next((one for one in study.records if one.versions), None)
    if first is None:
        return ["No run was measured."]
    versions = ", ".join(f"{name} {version}" for name, version in first.versions.items())
    repeats = max(len(one.seconds) for one in study.records)
    wall = [w / c for one in study.records for w, c in zip(one.wall, one.seconds, strict=True) if c]
    ratio = float(np.median(wall)) if wall else float("nan")
    commit = f", commit {first.commit}" if first.commit else ""
    seed = "" if first.seed is None else f", seed {first.seed}"
    shared = " (other work took the processor: read the processor seconds)" * (ratio > DISTURBED)
    return [
        f"Medians of {repeats} repeats after a warm-up, all runs in turn; processor seconds of the "
        f"whole run, covers included. Wall over processor seconds {ratio:.2f}{shared}. Memory is "
        f"what a run adds at its peak to a process that has made it once before. {first.machine}; "
        f"{versions}{commit}. Scene {first.scene_hash[:12]}{seed}. Raw records with all hashes, "
        "seeds and repeats: `records.jsonl`.",
    ]
