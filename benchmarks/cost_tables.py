"""Tables of the manual from the records of `manifold_cost.py`."""

from __future__ import annotations

import csv
import re
from collections import defaultdict
from collections.abc import Iterable
from pathlib import Path

import numpy as np
from smooth_costs import PHASES, SOLVERS, Cost

from integration.arrays import Floats

Series = dict[tuple[str, str], list[Cost]]


def tables(page: str, records: Path) -> str:
    """Put the tables between the marks of the page."""
    parts = {}
    if (records / "smooth.csv").exists():
        smooth = read(records / "smooth.csv")
        parts["ratios"] = smooth_ratios(smooth)
        parts["assembly"] = assembly(smooth | read(records / "blocks.csv"))
        parts["runs"] = [(records / "versions.txt").read_text().strip(), "", *runs(smooth)]
    if (records / "singular.csv").exists():
        singular = read(records / "singular.csv")
        parts["singular"] = singular_ratios(singular)
        parts["elements at singular points"] = runs(
            {key: costs for key, costs in singular.items() if key[1].startswith("P")}
        )
    if (records / "cutting.md").exists():
        parts["cutting"] = (records / "cutting.md").read_text().strip().split("\n")
    for name, lines in parts.items():
        begin, end = f"<!-- {name} -->", f"<!-- end of {name} -->"
        text = "\n".join(lines)
        pattern = re.compile(re.escape(begin) + ".*?" + re.escape(end), re.DOTALL)
        page, number = pattern.subn(lambda _, t=text, b=begin, e=end: f"{b}\n\n{t}\n\n{e}", page)
        assert number == 1, f"{name}: one place in the page expected, {number} found"
    return page


def read(file: Path) -> Series:
    """Costs by problem and method."""
    found: Series = defaultdict(list)
    with file.open(newline="") as stream:
        for row in csv.DictReader(stream):
            cost = Cost(
                row["problem"],
                row["method"],
                int(row["n"]),
                int(row["position"]),
                int(row["unknowns"]),
                float(row["error"]),
                {phase: float(row[phase]) for phase in PHASES},
            )
            found[cost.problem, cost.method].append(cost)
    return found


def by_size(costs: Iterable[Cost]) -> dict[int, list[Cost]]:
    """Group the positions of one size."""
    found: dict[int, list[Cost]] = defaultdict(list)
    for cost in costs:
        found[cost.n].append(cost)
    return found


def at_error(baseline: list[Cost], values: list[float], error: float) -> float:
    """Value of the baseline at an error between those solved, by logarithms; else no number."""
    known = [(c.error, v) for c, v in zip(baseline, values, strict=True) if np.isfinite(v)]
    x, y = np.log(np.array(sorted(known))).T
    # 5 % beyond the ends: the sizes of both are chosen to end at about the same error.
    if not x[0] - 0.05 <= np.log(error) <= x[-1] + 0.05:
        return np.nan
    k = int(np.clip(np.searchsorted(x, np.log(error)) - 1, 0, len(x) - 2))
    slope = (y[k + 1] - y[k]) / (x[k + 1] - x[k])
    return float(np.exp(y[k] + slope * (np.log(error) - x[k])))


def ratio(costs: list[Cost], baseline: list[Cost], what: str) -> Floats:
    """Ratios of unknowns, or of seconds with a solver, to the baseline's at equal errors."""

    def value(cost: Cost) -> float:
        return float(cost.unknowns) if what == "unknowns" else cost.total(what)

    values = [value(cost) for cost in baseline]
    return np.array([value(cost) / at_error(baseline, values, cost.error) for cost in costs])


def number(value: float, form: str = ".2f") -> str:
    """Format, or a dash where there is no number."""
    return format(value, form) if np.isfinite(value) else "-"


def table(head: list[str], rows: Iterable[list[str]]) -> list[str]:
    """Lines of a table."""
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return lines + ["| " + " | ".join(row) + " |" for row in rows]


def smooth_ratios(series: Series) -> list[str]:
    """Ratios at equal error by method and size."""
    head = ["manifold", "against", "positions", "unknowns", "energy error", "seconds, median"]
    head += ["worst", *(f"both {name}, median" for name in SOLVERS), "unknowns, median", "worst"]
    rows = []
    for (_, method), costs in sorted(series.items()):
        if method.startswith("P"):
            continue
        against = f"P{int(method[3]) + 1}"
        baseline = series["smooth", against]
        for group in by_size(costs).values():
            best, size = ratio(group, baseline, "best"), ratio(group, baseline, "unknowns")
            same = [np.median(ratio(group, baseline, name)) for name in SOLVERS]
            row = [method, against, str(len(group)), _median([c.unknowns for c in group], ",.0f")]
            row += [_median([c.error for c in group], ".1e")]
            row += [number(float(np.median(best))), number(float(best.max()))]
            row += [number(float(value)) for value in same]
            row += [number(float(np.median(size))), number(float(size.max()))]
            rows.append(row)
    return table(head, rows)


def assembly(series: Series) -> list[str]:
    """Seconds of integration and assembly per unknown, at the sizes of most unknowns."""
    head = ["", "unknowns", "integrals and assembly, us an unknown", "with cutting"]
    rows = []
    for (_, method), costs in sorted(series.items()):
        group = list(by_size(costs).values())[-1]
        inner = [(c.seconds["moments"] + c.seconds["assembly"]) / c.unknowns * 1e6 for c in group]
        whole = [
            own + c.seconds["cover"] / c.unknowns * 1e6 for own, c in zip(inner, group, strict=True)
        ]
        size = _median([c.unknowns for c in group], ",.0f")
        rows.append([method, size, _median(inner, ".2f"), _median(whole, ".2f")])
    return table(head, rows)


def runs(series: Series) -> list[str]:
    """All sizes, medians over positions."""
    head = ["problem", "method", "n", "positions", "unknowns", "energy error", *PHASES, "best, s"]
    rows = []
    for (problem, method), costs in sorted(series.items()):
        for n, group in sorted(by_size(costs).items(), key=lambda item: item[1][0].unknowns):
            row = [problem, method, str(n), str(len(group))]
            row += [_median([c.unknowns for c in group], ",.0f")]
            row += [_median([c.error for c in group], ".2e")]
            row += [_median([c.seconds[phase] for c in group], ".3f") for phase in PHASES]
            rows.append([*row, _median([c.total() for c in group], ".3f")])
    return table(head, rows)


def singular_ratios(series: Series) -> list[str]:
    """Times fewer unknowns than finite elements at equal error, median and least."""
    against = ["P2 uniform", "P3 uniform", "P2 graded", "P3 graded"]
    head = ["problem", "method", "n", "unknowns", "energy error", "worst"]
    head += [f"fewer than {name}" for name in against] + ["seconds over graded, median", "worst"]
    rows = []
    for (problem, method), costs in sorted(series.items()):
        if method.startswith("P"):
            continue
        for n, group in by_size(costs).items():
            errors = [c.error for c in group]
            row = [problem, method, str(n), _median([c.unknowns for c in group], ",.0f")]
            row += [_median(errors, ".1e"), f"{max(errors):.1e}"]
            row += [_fewer(group, series[problem, name]) for name in against]
            seconds = [ratio(group, series[problem, name], "best") for name in against[2:]]
            slower = np.fmax(*seconds)  # the faster of the two graded ones
            row += [number(float(np.median(slower))), number(float(slower.max()))]
            rows.append(row)
    return table(head, rows)


def _fewer(group: list[Cost], baseline: list[Cost]) -> str:
    """Median (least) ratio; a bound where the baseline did not come so far."""
    most = max(baseline, key=lambda cost: cost.unknowns)
    ratios, beyond = [], False
    for cost, value in zip(group, 1 / ratio(group, baseline, "unknowns"), strict=True):
        below = not np.isfinite(value) and cost.error < most.error
        beyond |= below
        ratios.append(most.unknowns / cost.unknowns if below else value)
    if not np.isfinite(ratios).all():
        return "-"
    sign = "> " if beyond else ""
    return f"{sign}{np.median(ratios):.3g} ({min(ratios):.3g})"


def _median(values: Iterable[float], form: str) -> str:
    return number(float(np.median(list(values))), form)
