"""The page, figure and raw records of a cost study."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from textwrap import wrap

import numpy as np

from nmm.study.cost import CostStudy, write_records
from nmm.study.front import Cost, costs_at_levels, front
from nmm.study.orders import Order, observed_order
from nmm.study.record import Record
from nmm.study.reference import Reference, sizes_of
from nmm.study.theory import order_in_size, order_in_step

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


def draw(study: CostStudy, path: Path) -> None:
    """Draw the work-precision figure."""
    from nmm.plots.work_precision import Series, work_precision

    on_front = _front(study)
    sizes = {one.unknowns for one in study.records if one.unknowns}
    counted = "unknowns" if len(sizes) > 1 else "steps"
    methods = distinguished(study)
    series = {
        name: Series(
            error=_errors(study, many),
            seconds=[one.median_seconds for one in many],
            counts=[float(getattr(one, counted) or np.nan) for one in many],
            memory=[float(one.memory or np.nan) for one in many],
            on_front=[id(one) in on_front for one in many],
            valid=[one.valid for one in many],
            phases=_finest(many).phases,
            effects=_by_effect(_finest(many)),
            family=many[0].family,
            method=methods[name],
        )
        for name, many in study.by_formulation().items()
    }
    reference = study.reference
    size = abs(reference.value) or 1.0
    work_precision(
        series,
        title=study.title,
        counted=counted,
        reference=_against(reference),
        error_name=f"{_kind(reference)} of {reference.quantity.replace('_', ' ')}",
        uncertainty=reference.uncertainty / size if reference.extrapolated else 0.0,
        path=path,
    )


def distinguished(study: CostStudy) -> dict[str, str]:
    """Return what tells formulations apart: their cover, else their enforcement or integrator."""
    groups = study.by_formulation()
    for part in ("cover", "enforcement", "integrator"):
        found = {name: many[0].method.get(part, "") for name, many in groups.items()}
        if len(set(found.values())) == len(found):
            return found
    return {name: many[0].method.get("cover", "") for name, many in groups.items()}


def _kind(reference: Reference) -> str:
    """Errors are relative but for a reference of zero."""
    return "relative error" if reference.value else "error"


def _by_effect(one: Record) -> dict[str, float]:
    """Return seconds by effect: the search is contact's, its solution is named as such."""
    found = dict(one.effects)
    if "contact" in found:
        found["contact"] += one.phases.get("search", 0.0)
        found["solution with contact"] = one.phases.get("solve", 0.0)
    return found


def _against(reference: Reference) -> str:
    """Say under the title what errors are taken against."""
    text = f"error against {reference.value:.6g}: {reference.source}"
    if reference.extrapolated:
        text += f", uncertainty {reference.uncertainty:.1g}"
    return "\n".join(wrap(text, 98))


def cost_page(study: CostStudy, picture: str) -> str:
    """Return the page in Markdown."""
    reference = study.reference
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
        f" value | {_kind(reference)} | front | verdict |",
        "|---|---|---|---|---|---|---|---|---|---|---|---|",
        *(_row(study, one, id(one) in _front(study)) for one in study.records),
        "",
        *_section("Observed orders", _orders(study)),
        *_section("Where the runs go", _limits(study)),
        *_section("Failed runs", _failed(study)),
        *_section("Time by effect", _effects(study)),
        *_section("Cost at equal error", _level_table(study)),
        *_section("How it was measured", _conditions(study)),
    ]
    return "\n".join(lines).rstrip() + "\n"


def levels(study: CostStudy) -> list[str]:
    """Sentences: at error e, A costs r times B; only between measured points.

    Where DDA, manifolds and finite elements stand side by side, the cheapest of each are compared.
    """
    groups = study.by_formulation()
    families = {name: many[0].family for name, many in groups.items()}
    lines = []
    for level, at in costs_at_levels(_points(study, "median_seconds")).items():
        if len(at) < 2 or all(cost.at_most for cost in at.values()):
            continue
        order = sorted(at, key=lambda name: at[name].value)
        best = order[0]
        shown = order[1:]
        if len(set(families.values())) > 1:
            cheapest = {families[name]: name for name in reversed(order)}
            shown = [name for name in order[1:] if name in cheapest.values()]
        ratios = [
            f"{name} costs {'at most ' * at[name].at_most}{at[name].value / at[best].value:.2g} "
            "times that"
            for name in shown
        ]
        missed = ", ".join(name for name in groups if name not in at)
        text = "; ".join([f"at error {level:g}, {best} costs {at[best]} s", *ratios])
        lines.append(f"- {text}" + (f"; not reached by {missed}" if missed else ""))
    return lines


def _points(study: CostStudy, cost: str) -> dict[str, tuple[list[float], list[float]]]:
    """Return cost and error of the runs of each formulation."""
    return {
        name: ([float(getattr(one, cost) or np.nan) for one in many], _errors(study, many))
        for name, many in study.by_formulation().items()
    }


def _level_table(study: CostStudy) -> list[str]:
    """Table of seconds and unknowns at equal error, each over the least of its column."""
    seconds = costs_at_levels(_points(study, "median_seconds"))
    unknowns = costs_at_levels(_points(study, "unknowns"))
    shown = [level for level, at in seconds.items() if len(at) > 1]
    if not shown:
        return []
    lines = [
        f"| seconds; unknowns at error | {' | '.join(f'{level:g}' for level in shown)} |",
        f"|---|{'---|' * len(shown)}",
    ]
    for name in study.by_formulation():
        cells = []
        for level in shown:
            first = _ratio(seconds[level], name)
            cells.append(f"{first}; {unknowns[level][name].value:,.0f}" if first else "")
        lines.append(f"| {name} | {' | '.join(cells)} |")
    return [*lines, "", *levels(study)]


def _ratio(at: Mapping[str, Cost], name: str) -> str:
    """Seconds of one formulation and how many times the least they are; empty if not reached."""
    if name not in at:
        return ""
    least = min(cost.value for cost in at.values())
    sign = "<= " * at[name].at_most
    return f"{sign}{at[name].value:.2g} s ({at[name].value / least:.2g} x)"


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
    """Observed orders with their confidence, from errors above the reference's uncertainty."""
    lines = []
    floor = _floor(study)
    for name, many in study.by_formulation().items():
        used = [one for one in many if one.valid and study.error(one) > floor]
        if len(used) < 2:
            continue
        sizes = sizes_of(used)
        order = observed_order(sizes, [study.error(one) for one in used])
        if order.points > 1 and np.isfinite(order.value):
            told = _theory(study, used, order)
            lines.append(f"- {name}: {order} in {_size_name(used)}{told}")
    return lines


def _theory(study: CostStudy, records: Sequence[Record], order: Order) -> str:
    """Say what order theory promises, and whether it lies within the confidence."""
    method = records[0].method
    if len({one.unknowns for one in records}) > 1:
        cover, quantity = method.get("cover", ""), study.reference.quantity
        found = order_in_size(cover, quantity, study.exponent)
        where = "for a smooth solution" if study.exponent is None else "at the corner"
    elif _size_name(records).endswith("integrator.step"):
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


def _size_name(records: Sequence[Record]) -> str:
    if len({one.unknowns for one in records}) > 1:
        return "unknowns^(-1/2)"
    return next(
        key
        for key in records[0].settings
        if len({str(one.settings.get(key)) for one in records}) > 1
    )


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
        one = _finest(many)
        spent = ", ".join(
            f"{effect} {seconds:.2g} s" for effect, seconds in _by_effect(one).items()
        )
        if spent:
            lines.append(f"- {one.label}: {spent}")
    return lines


def _failed(study: CostStudy) -> list[str]:
    return [f"- {one.label}: {one.sentence}" for one in study.records if not one.valid]


def _shaded(study: CostStudy) -> list[str]:
    floor = _floor(study)
    low = [one for one in study.records if one.valid and study.error(one) < floor]
    if not low:
        return []
    return [f'{len(low)} errors lie below that uncertainty and mean no more than "less than it".']


def _floor(study: CostStudy) -> float:
    """Relative error below which the reference says nothing."""
    reference = study.reference
    return reference.uncertainty / (abs(reference.value) or 1.0) if reference.extrapolated else 0.0


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


def _finest(records: Sequence[Record]) -> Record:
    valid = [one for one in records if one.valid and one.seconds] or list(records)
    return max(valid, key=lambda one: one.median_seconds if one.seconds else -1.0)


def _front(study: CostStudy) -> set[int]:
    best = front([one.median_seconds for one in study.records], _errors(study, study.records))
    return {id(one) for one, on in zip(study.records, best.tolist(), strict=True) if on}


def _errors(study: CostStudy, records: Sequence[Record]) -> list[float]:
    """Errors, nan for failed runs; none below what the reference can tell."""
    floor = _floor(study)
    return [max(study.error(one), floor) if one.valid else float("nan") for one in records]
