"""What the records of enforcements say in short: which to choose, which aims are met."""

from collections.abc import Iterable

import numpy as np
from enforcement import Row
from kinds import DEFAULT, KINDS
from records import Row as Measurement
from step_rows import AIMS, GROWTH, StepRow, growth, milliseconds, smaller

PURPOSE = {
    "open-close 1 E": "comparison with Shi's program, walls",
    "open-close 10 E": "comparison with Shi's program, single blocks",
    "penalty 1 E": "many blocks, where penetrations may be of weight over modulus",
    "penalty 10 E": "the default",
    "penalty 100 E": "penetrations that have to be small",
    "augmented": "no penetration with the means of springs; few contacts",
    "lagrange": "no penetration where contacts are fewer than unknowns",
    "cone": "no penetration, exact friction, any number of contacts",
    "barrier": "bodies that must never pass one another; smooth forces",
}
SCENES = ("wall", "pile")
CROWDED = 1.5
"""Load from which on other processes took part of the machine."""


def choice(rows: list[Row], steps: list[StepRow]) -> str:
    """Table: what each enforcement is for, what it costs beside the default, what it leaves."""
    head = (
        "| enforcement | choose it for | cost on a wall | cost on a pile | converges on walls to | "
        "on piles to | penetration (m) | force error |"
    )
    lines = [head, "|" + "---|" * 8]
    for kind in KINDS:
        cells = [kind, PURPOSE[kind], *(_cost(kind, scene, steps) for scene in SCENES)]
        cells += [_reach(kind, scene, steps) for scene in SCENES]
        mine = [row for row in rows if row.enforcement == kind and row.scene in SCENES]
        cells += [_worst([row.penetration for row in mine if row.converged == row.steps])]
        cells += [_worst([row.force_error for row in mine if row.converged == row.steps])]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def _cost(kind: str, scene: str, steps: list[StepRow]) -> str:
    """Seconds over those of the default, at the largest size where both converged."""
    of = {(r.enforcement, r.size): r for r in steps if r.scene == scene and r.sound}
    sizes = [size for one, size in of if one == kind and (DEFAULT, size) in of]
    if not sizes:
        return ""
    size = max(sizes)
    times = of[kind, size].seconds / of[DEFAULT, size].seconds
    return f"{_short(times)} at {size}"


def _reach(kind: str, scene: str, steps: list[StepRow]) -> str:
    """Largest size up to which every step converged, and how the next came out."""
    mine = [r for r in steps if r.scene == scene and r.enforcement == kind]
    good = 0
    for row in sorted(mine, key=lambda r: r.size):
        if not row.sound:
            return f"{good or 'none'} ({row.status} at {row.size})"
        good = row.size
    return str(good) if good else ""


def _worst(errors: list[float]) -> str:
    """Largest of the errors that were measured."""
    known = [error for error in errors if error >= 0]
    return f"{max(known):.0e}" if known else ""


def aims(steps: list[StepRow]) -> str:
    """Table of seconds a step over the aims: bold where missed, in words where not converged."""
    of = {row.key: row for row in steps}
    head = "| scene | blocks | aim (ms) | " + " | ".join(KINDS) + " |"
    lines = [head, "|" + "---|" * (3 + len(KINDS))]
    for (scene, size), aim in AIMS.items():
        cells = [_against(of.get((scene, kind, size))) for kind in KINDS]
        lines.append(f"| {scene} | {size} | {milliseconds(aim)} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def _against(row: StepRow | None) -> str:
    if row is None:
        return "not measured"
    if not row.sound:
        return f"{row.status} ({_short(row.ratio)})" if row.seconds else row.status
    return _short(row.ratio) if row.ratio <= 1 else f"**{_short(row.ratio)}**"


def short(rows: list[Row], steps: list[StepRow]) -> str:
    """Points in words: aims, growth, convergence and cost, met or missed by how much."""
    points = [_quickest(steps), _default(steps), _growing(steps)]
    points += [_converging(rows, steps), _exact(steps)]
    return "\n".join(f"- {point}" for point in points)


def _quickest(steps: list[StepRow]) -> str:
    """Aims against the quickest enforcement whose every step converged."""
    best: dict[tuple[str, int], StepRow] = {}
    for row in steps:
        at = (row.scene, row.size)
        if row.sound and at in AIMS and (at not in best or row.seconds < best[at].seconds):
            best[at] = row
    text = _met_and_missed({at: best.get(at) for at in AIMS}, named=True)
    return f"**Aims of seconds a step**, by the quickest that converges: {text}."


def _default(steps: list[StepRow]) -> str:
    of = {(row.scene, row.size): row for row in steps if row.enforcement == DEFAULT}
    text = _met_and_missed({at: of.get(at) for at in AIMS}, named=False)
    return f"**The same with the default**, {DEFAULT}: {text}."


def _met_and_missed(rows: dict[tuple[str, int], StepRow | None], named: bool) -> str:
    lists: dict[str, list[str]] = {"met": [], "missed": []}
    for (scene, size), row in rows.items():
        what = f"{scene} of {size}"
        if row is None or not row.sound:
            state = "not measured" if row is None else row.status
            lists.setdefault(state, []).append(what)
            continue
        by = f", {row.enforcement}" if named else ""
        figures = f"{milliseconds(row.seconds)} ms, {_short(row.ratio)} times the aim{by}"
        lists.setdefault("met" if row.ratio <= 1 else "missed", []).append(f"{what} ({figures})")
    parts = [f"{state}: {', '.join(some)}" for state, some in lists.items() if some]
    return f"{len(lists['met'])} of {len(rows)} met; " + "; ".join(parts)


def _growing(steps: list[StepRow]) -> str:
    """Growth of walls from size to size against its aim, from the worst on."""
    walls = [row for row in steps if row.scene == "wall"]
    powers = [(growth(row, walls), smaller(row, walls), row) for row in walls]
    known = [(p, last, row) for p, last, row in powers if last is not None and not np.isnan(p)]
    over = [
        f"{row.enforcement} from {last.size} to {row.size} blocks as N^{power:.2f}, "
        f"{power - GROWTH:.2f} too much"
        for power, last, row in sorted(known, key=lambda one: -one[0])
        if power > GROWTH
    ]
    text = f"{len(known) - len(over)} of {len(known)} pairs of sizes measured are within it"
    text += f"; missed by {'; '.join(over)}" if over else ""
    return f"**Aim of growth** (walls, N^{GROWTH:g} from one size to the next): {text}."


def _converging(rows: list[Row], steps: list[StepRow]) -> str:
    """Which enforcements converged in every step that was run, whole or of contact alone."""
    broken: dict[str, list[str]] = {}
    unknown: dict[str, list[str]] = {}
    for row in steps:
        where = f"{row.scene} of {row.size}"
        if row.status == "stopped" and not row.sound and not row.cut:
            unknown.setdefault(row.enforcement, []).append(where)
        elif not row.sound and row.status != "not run":
            broken.setdefault(row.enforcement, []).append(f"{where} ({row.status})")
    for one in rows:
        if one.converged < one.steps:
            where = f"{one.scene} of {one.size}, contact alone ({one.converged} of {one.steps})"
            broken.setdefault(one.enforcement, []).append(where)
    ran = {row.enforcement for row in steps if row.status != "not run"}
    good = [kind for kind in KINDS if kind in ran and kind not in broken]
    text = f"**Convergence**: every step that was done converged with {', '.join(good) or 'none'}."
    text += f" Not so {_listed(broken)}." if broken else ""
    return text + (f" Stopped in doubt: {_listed(unknown)}." if unknown else "")


def _listed(places: dict[str, list[str]]) -> str:
    return "; ".join(f"{kind}: {', '.join(where)}" for kind, where in places.items())


def _exact(steps: list[StepRow]) -> str:
    """What enforcements without penetration cost beside the default."""
    of = {(r.enforcement, r.scene, r.size): r.seconds for r in steps if r.sound}
    times = [
        seconds / of[DEFAULT, scene, size]
        for (kind, scene, size), seconds in of.items()
        if KINDS[kind].name != "penalty" and (DEFAULT, scene, size) in of
    ]
    if not times:
        return "**Cost of enforcements without penetration**: not measured."
    span = f"{_short(min(times))} to {_short(max(times))}"
    return f"**Cost of enforcements without penetration**: {span} times that of the default."


def crowd(rows: Iterable[Measurement]) -> str:
    """Warn of rows measured on a machine with other work, or at different states of the code."""
    rows = list(rows)
    busy = sum(row.load > CROWDED for row in rows)
    text = f"Of {len(rows)} rows {busy} were measured while other work ran on the machine"
    text += ": their seconds are too long, read ratios." if busy else "."
    commits = len({row.commit for row in rows})
    if commits > 1:
        text += f" They stem from {commits} states of the code; growth is told within one only."
    return text


def origins(rows: Iterable[Measurement]) -> str:
    """Where and when rows were measured, and under what load."""
    rows = list(rows)
    if not rows:
        return "Nothing has been measured."
    dates, loads = sorted(r.date for r in rows), [r.load for r in rows if r.load > 0]
    commits = list(dict.fromkeys(r.commit for r in rows if r.commit))
    versions = list(dict.fromkeys(r.versions for r in rows if r.versions))
    text = f"{len(rows)} rows, {dates[0]} to {dates[-1]}, at commits {', '.join(commits)} "
    text += '("+": with changes since), '
    if loads:
        text += f"load {min(loads):.1f} to {max(loads):.1f} (1: nothing else ran), "
    return text + f"{sum(r.used for r in rows):.0f} processor seconds. {'; '.join(versions)}."


def _short(value: float) -> str:
    """Two digits, without an exponent; hundredths where a few per cent decide."""
    if 0.1 <= value < 10:
        return f"{round(value, 2):g}"
    return f"{float(f'{value:.2g}'):g}"
