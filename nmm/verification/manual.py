"""Pages of the verification manual: one a benchmark, and the list of all."""

import re
from collections.abc import Iterable, Sequence
from pathlib import Path

from nmm.verification.outcomes import Outcome
from nmm.verification.rows import FILE, Row, merged

GROUPS = {
    "A": "Accuracy of the continuum",
    "B": "Blocks, contact, friction, dynamics",
    "C": "Fracture of concrete",
    "D": "Numerically hard",
    "GR": "Cracks that grow",
    "CO": "Cohesive cracks",
    "SP": "Blocks that split",
    "PA": "Paths past the peak",
    "BO": "Bars and bolts",
    "BM": "Earthquakes and boundaries of waves",
    "WA": "Water",
    "ST": "Excavation and construction",
    "TH": "Heat",
    "PL": "Plasticity",
    "VI": "Viscosity and damping",
    "FK": "Finite strain",
    "IN": "Integrators",
    "ML": "Moving loads",
    "": "Others",
}
"""What benchmarks are about, by the letters their names begin with."""

VERDICT = {True: "passed", False: "**missed**"}


def write_manual(outcomes: Sequence[Outcome], out: Path) -> list[Path]:
    """Write the list of benchmarks, and a page for each with a sketch and how its errors fall.

    Benchmarks that the folder holds and that were not run again stay in the list as they are.

    Returns
    -------
    files
        ``index.md``, ``margins.png``, ``results.json``, then the pages with their pictures.
    """
    from nmm.plots.verification import margins

    out.mkdir(parents=True, exist_ok=True)
    by_name: dict[str, list[Row]] = {}
    for row in merged(outcomes, out):
        by_name.setdefault(row.benchmark, []).append(row)
    by_name = {name: by_name[name] for name in in_order(by_name)}
    shares = {name: [one for row in rows for one in row.shares] for name, rows in by_name.items()}
    files = [out / "index.md", out / "margins.png", out / FILE]
    margins(shares, files[1])
    files[0].write_text(_index(by_name), encoding="utf-8")
    for name, many in grouped(outcomes).items():
        sketch = out / f"{stem(name)}.png"
        drawn = many[0].case.sketch(sketch)
        fall = out / f"{stem(name)}_convergence.png"
        falls = _draw_convergence(many, fall)
        page = out / f"{stem(name)}.md"
        page.write_text(_page(many, drawn, falls), encoding="utf-8")
        files += [page, *([sketch] if drawn else []), *([fall] if falls else [])]
    return files


def grouped(outcomes: Iterable[Outcome]) -> dict[str, list[Outcome]]:
    """Outcomes by benchmark, in the order of groups, numbers and the first run of each."""
    found: dict[str, list[Outcome]] = {}
    for one in outcomes:
        found.setdefault(one.case.name, []).append(one)
    return {name: found[name] for name in in_order(found)}


def in_order(names: Iterable[str]) -> list[str]:
    """Names of benchmarks by group and number: B2 before B10, a user's own last."""
    return sorted(names, key=_rank)


def stem(name: str) -> str:
    """Name of a benchmark as the name of a file."""
    return re.sub(r"\W+", "_", name).strip("_").lower()


def table(outcomes: Iterable[Outcome]) -> list[str]:
    """Rows of computed, reference and error of every quantity."""
    lines = [
        "| variant | formulation | quantity | computed | reference | error | tolerance "
        "| passed | seconds |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for one in outcomes:
        start, end = f"| {one.case.variant} | {one.formulation} |", f"{one.seconds:.2g} |"
        if one.fault:
            lines.append(f"{start} **fault**: {one.fault} | | | | | {VERDICT[False]} | {end}")
        lines += [
            f"{start} {name} | {check.shown} | {check.wanted} | "
            f"{' | '.join(check.missed_by)} | {VERDICT[check.passed]} | {end}"
            for name, check in one.checks.items()
        ]
    return lines


def group(name: str) -> str:
    """Letters of `GROUPS` that a benchmark belongs to; empty for one of a user's own."""
    found = re.match(r"([A-Z]+)\d", name)
    return found[1] if found and found[1] in GROUPS else ""


def _rank(name: str) -> tuple[int, int, str]:
    number = re.match(r"\D*(\d+)", name)
    return list(GROUPS).index(group(name)), int(number[1]) if number else 0, name


def _index(by_name: dict[str, list[Row]]) -> str:
    total = [row for rows in by_name.values() for row in rows]
    seconds = sum(row.seconds for row in total)
    lines = [
        "# Verification",
        "",
        f"{sum(row.runs for row in total)} runs of {len(by_name)} benchmarks, "
        f"{sum(row.missed for row in total)} missed, in {seconds:.0f} s. Written by `make manual`, "
        "that is `nmm verify --slow --out docs/verification`; `nmm verify B2 --out "
        "docs/verification` runs one again. Each row shows, of all variants under one formulation, "
        "the quantity that comes nearest to its tolerance; the page behind the name has them all.",
        "",
        "An error is relative to the reference unless the page says otherwise; a reference with ≤ "
        "or ≥ is a limit, whose error is how far it is passed. Seconds are processor seconds.",
        "",
        "![Errors over tolerances of all quantities](margins.png)",
    ]
    for letters, words in GROUPS.items():
        chosen = [row for name, rows in by_name.items() if group(name) == letters for row in rows]
        if chosen:
            lines += ["", f"## {words}", "", *_table(chosen)]
    pages = [stem(name) for name in by_name]
    return "\n".join([*lines, "", "```{toctree}", ":hidden:", "", *pages, "```"]) + "\n"


def _table(rows: Iterable[Row]) -> list[str]:
    """Rows of the list in Markdown."""
    return [
        "| benchmark | title | quantity | computed | reference | error | tolerance | formulation "
        "| passed | seconds |",
        "|---|---|---|---|---|---|---|---|---|---|",
        *(
            f"| [{row.benchmark}]({stem(row.benchmark)}.md) | {row.title} | {row.quantity} | "
            f"{row.computed} | {row.reference} | {row.error} | {row.tolerance} | "
            f"{row.formulation} | {VERDICT[row.passed]} | {row.seconds:.2g} |"
            for row in rows
        ),
    ]


def _page(many: Sequence[Outcome], sketch: bool, falls: bool) -> str:
    case = many[0].case
    about = " ".join((type(case).__doc__ or "").split())
    reasons = {
        name: check.reason for one in many for name, check in one.checks.items() if check.reason
    }
    name = stem(case.name)
    lines = [
        f"# {case.name}: {case.title}",
        "",
        about,
        "",
        f"Reference: {case.source}.",
        "",
        *([f"![Sketch of {case.name}]({name}.png)", ""] if sketch else []),
        *table(many),
        "",
        *(["## Convergence", "", *_orders(many, f"{name}_convergence.png"), ""] if falls else []),
        "## Tolerances",
        "",
        *(f"- {quantity}: {reason}" for quantity, reason in reasons.items()),
        "",
        f"Run it alone: `nmm verify {_quoted(case.name)}`. "
        f"It is `{type(case).__module__}:{type(case).__qualname__}`.",
    ]
    return "\n".join(lines) + "\n"


def _quoted(name: str) -> str:
    return f'"{name}"' if " " in name else name


def _orders(many: Sequence[Outcome], picture: str) -> list[str]:
    """Orders with confidence beside theory, and the picture."""
    return [
        "Slopes are least squares through all points of a line, ± their 95 % confidence; dashed is "
        "the slope of theory.",
        "",
        f"![Errors over sizes]({picture})",
        "",
        "| quantity | variant | formulation | observed order | theory |",
        "|---|---|---|---|---|",
        *(
            f"| {name} | {one.case.variant} | {one.formulation} | {check.series.observed} | "
            f"{check.series.theory:g} |"
            for one in many
            for name, check in one.checks.items()
            if check.series is not None
        ),
    ]


def _draw_convergence(many: Sequence[Outcome], path: Path) -> bool:
    """Draw all series of a benchmark; False where it has none."""
    from nmm.plots.verification import Fall, convergence

    panels: dict[str, list[Fall]] = {}
    for one in many:
        for name, check in one.checks.items():
            if (run := check.series) is not None:
                words = ", ".join(filter(None, (one.case.variant, one.formulation)))
                label = f"{words}: {run.observed}, theory {run.theory:g}"
                fall = Fall(run.sizes, run.errors, run.theory, label, run.x)
                panels.setdefault(name, []).append(fall)
    if panels:
        convergence(panels, path)
    return bool(panels)
