"""What formulations cost at equal error, as sentences and as a table."""

from collections.abc import Mapping

from nmm.study.cost.cost_study import CostStudy
from nmm.study.cost.front import Cost, costs_at_levels


def levels(study: CostStudy) -> list[str]:
    """Sentences: at error e, A costs r times B; only between measured points.

    Where DDA, manifolds and finite elements stand side by side, the cheapest of each are compared.
    """
    groups = study.by_formulation()
    families = {name: many[0].family for name, many in groups.items()}
    lines = []
    for level, at in costs_at_levels(study.points("median_seconds")).items():
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


def level_table(study: CostStudy) -> list[str]:
    """Table of seconds and unknowns at equal error, each over the least of its column."""
    seconds = costs_at_levels(study.points("median_seconds"))
    unknowns = costs_at_levels(study.points("unknowns"))
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
