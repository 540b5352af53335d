"""Pages of the verification manual: one a benchmark, and the list of all."""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from integration.arrays import Floats
from nmm.results.frame import Frame, Topology
from nmm.verification.base import Case, Check, SceneCase
from nmm.verification.outcomes import Outcome

RELATION = {"equal": "", "at_most": "≤ ", "at_least": "≥ "}


@dataclass(frozen=True)
class Still:
    """What a scene looks like before it is run, as pictures want it."""

    topologies: list[Topology]
    frames: list[Frame] = field(default_factory=list)
    history: dict[str, Floats] = field(default_factory=dict)


def write_manual(outcomes: Sequence[Outcome], out: Path) -> list[Path]:
    """Write ``index.md``, ``margins.png`` and a page with a sketch for each benchmark."""
    from nmm.plots.verification import margins

    out.mkdir(parents=True, exist_ok=True)
    names = [f"{one.label}: {name}" for one in outcomes for name in one.checks]
    margins(
        names,
        [share(check) for one in outcomes for check in one.checks.values()],
        out / "margins.png",
    )
    by_name: dict[str, list[Outcome]] = {}
    for one in outcomes:
        by_name.setdefault(one.case.name, []).append(one)
    files = [out / "index.md", out / "margins.png"]
    files[0].write_text(_index(by_name), encoding="utf-8")
    for name, many in by_name.items():
        page = out / f"{stem(name)}.md"
        sketch = _sketch(many[0].case, out / f"{stem(name)}.png")
        page.write_text(_page(many, sketch), encoding="utf-8")
        files += [page, *([sketch] if sketch else [])]
    return files


def share(check: Check) -> float:
    """Error over tolerance; of a limit, the value over it; 0 or inf where that says nothing."""
    if check.bound == "at_most" and check.reference > 0 and not check.tolerance:
        return max(check.computed / check.reference, 0.0)
    if check.tolerance:
        return check.error / check.tolerance
    return 0.0 if check.passed else float("inf")


def stem(name: str) -> str:
    """Name of a benchmark as the name of a file."""
    return re.sub(r"\W+", "_", name).strip("_").lower()


def table(outcomes: Iterable[Outcome]) -> list[str]:
    """Rows of computed, reference and error of every quantity."""
    lines = [
        "| variant | formulation | quantity | computed | reference | error | allowed | seconds | |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for one in outcomes:
        start = f"| {one.case.variant} | {one.formulation} |"
        if one.fault:
            lines.append(f"{start} | | | | | {one.seconds:.2g} | **fault**: {one.fault} |")
        for name, check in one.checks.items():
            verdict = "passed" if check.passed else "**missed**"
            lines.append(
                f"{start} {name} | {check.computed:.7g} | {RELATION[check.bound]}"
                f"{check.reference:.7g} | {check.error:.1e} | {check.tolerance:.1e} | "
                f"{one.seconds:.2g} | {verdict} |"
            )
    return lines


def _index(by_name: dict[str, list[Outcome]]) -> str:
    total = [one for many in by_name.values() for one in many]
    missed = sum(not one.passed for one in total)
    lines = [
        "# Verification",
        "",
        f"{len(total)} runs of {len(by_name)} benchmarks, {missed} missed. Written by "
        "`nmm verify --out`.",
        "",
        "![margins](margins.png)",
        "",
        "| benchmark | what | runs | seconds | |",
        "|---|---|---|---|---|",
    ]
    for name, many in by_name.items():
        verdict = "passed" if all(one.passed for one in many) else "**missed**"
        seconds = sum(one.seconds for one in many)
        title = many[0].case.title
        lines.append(
            f"| [{name}]({stem(name)}.md) | {title} | {len(many)} | {seconds:.2g} | {verdict} |"
        )
    return "\n".join(lines) + "\n"


def _page(many: Sequence[Outcome], sketch: Path | None) -> str:
    case = many[0].case
    about = " ".join((type(case).__doc__ or "").split())
    reasons = {
        name: check.reason for one in many for name, check in one.checks.items() if check.reason
    }
    lines = [
        f"# {case.name}: {case.title}",
        "",
        about,
        "",
        f"Reference: {case.source}.",
        "",
        *([f"![{case.name}]({sketch.name})", ""] if sketch else []),
        *table(many),
        "",
        "Tolerances:",
        "",
        *(f"- {name}: {reason}" for name, reason in reasons.items()),
    ]
    return "\n".join(lines) + "\n"


def _sketch(case: Case, path: Path) -> Path | None:
    """Draw the blocks, supports and loads of a benchmark that is one scene."""
    if not isinstance(case, SceneCase):
        return None
    import numpy as np

    from nmm.geometry.regions import regions
    from nmm.plots.blocks import blocks

    scene = case.parsed()
    found = regions(scene)
    topology = Topology(
        found.polygons,
        np.arange(len(found.polygons)),
        np.asarray(found.material),
        tuple(scene.materials),
        tuple(found.name),
    )
    blocks(Still([topology]), scene=scene, path=path)
    return path
