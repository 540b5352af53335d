"""Running cases and taking their cost: interleaved repeats after a warm-up, one thread a case."""

import os
import platform
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import inf
from pathlib import Path
from time import perf_counter, process_time
from typing import TYPE_CHECKING, Any

from nmm.errors import in_a_line
from nmm.progress import Progress
from nmm.study.cases.block_covers import blocks_of
from nmm.study.cases.families import family_of, spanned_degree
from nmm.study.cases.memory import added_memories
from nmm.study.cases.quantities import Measured, quantity
from nmm.study.cases.record import VALID, Record
from nmm.study.cases.running import commit, run_case
from nmm.study.cases.variants import StudyCase

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.results.summary import Summary


@dataclass(frozen=True)
class SpentTime:
    """What one repeat took: processor and wall-clock seconds, and where they went."""

    seconds: float
    wall: float
    summary: "Summary"


def measure(
    cases: Sequence[StudyCase],
    names: Sequence[str],
    repeats: int = 3,
    memory: bool = True,
    progress: Progress | None = None,
    long: float = inf,
) -> list[Record]:
    """Run every case ``repeats`` times, all cases in turn, after one round that is not counted.

    Parameters
    ----------
    cases
        What is run.
    names
        Quantities read off each run.
    repeats
        Counted runs of each case; a case that raised in the warm-up is not repeated.
    memory
        Also run each case once in a process of its own to see how much memory it adds.
    long
        Seconds from which the first run of a case counts, but for the first case: what is compiled
        then is little beside it.
    """
    tell = progress or (lambda share, text: None)
    rounds = repeats + 1 + memory
    total = rounds * len(cases)
    first = [_once(case, names) for case in _told(cases, tell, 0, total)]
    found = [record for record, _ in first]
    counts = [index > 0 and spent.seconds >= long for index, (_, spent) in enumerate(first)]
    times = [[spent] if counted else [] for (_, spent), counted in zip(first, counts, strict=True)]
    for turn in range(1, repeats + 1):
        for index, case in enumerate(_told(cases, tell, turn * len(cases), total)):
            if found[index].status != "error" and len(times[index]) < repeats:
                times[index].append(_once(case, ())[1])
    peaks: list[int | None] = [None] * len(cases)
    if memory:
        told = _told(cases, tell, (rounds - 1) * len(cases), total)
        runs = [index for index in range(len(cases)) if found[index].status != "error"]
        for index, peak in zip(runs, added_memories([cases[i] for i in runs]), strict=True):
            next(told)
            peaks[index] = peak
    return [_joined(one, many, peak) for one, many, peak in zip(found, times, peaks, strict=True)]


def record(case: StudyCase, names: Sequence[str]) -> Record:
    """Run one case once and return its record, with the seconds of that one run."""
    found, spent = _once(case, names)
    return _joined(found, [spent], None)


def machine() -> str:
    """Processor and system in words."""
    kind = platform.machine()
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        kind = next(line for line in lines if line.startswith("model name")).partition(":")[2]
    except (OSError, StopIteration):
        pass
    return f"{kind.strip()}, {os.cpu_count()} cores, {platform.system()} {platform.release()}"


def _once(case: StudyCase, names: Sequence[str]) -> tuple[Record, SpentTime]:
    from nmm.results.summary import Summary

    cpu, wall = process_time(), perf_counter()
    summary = Summary()
    try:
        done = run_case(case)
        summary = done.summary
        spent = SpentTime(process_time() - cpu, perf_counter() - wall, summary)
        return _record(case, done, names), spent
    # A case that breaks in any way is a result of the study, and the other cases go on.
    except Exception as fault:
        spent = SpentTime(process_time() - cpu, perf_counter() - wall, summary)
        return Record(**_identity(case), status="error", sentence=in_a_line(fault)), spent


def _identity(case: StudyCase) -> dict[str, Any]:
    from nmm.formulation import formulation_hash
    from nmm.results.versions import installed_versions
    from nmm.scene import scene_hash

    seeds = [item.seed for item in case.scene.tessellations if item.seed is not None]
    return {
        "name": case.name,
        "settings": dict(case.settings),
        "key": case.key,
        "cover": case.formulation.cover.type,
        "family": family_of(case.formulation.cover),
        "method": method_of(case.formulation),
        "scene_hash": scene_hash(case.scene),
        "formulation_hash": formulation_hash(case.formulation),
        "seed": seeds[0] if seeds else case.scene.seed,
        "versions": installed_versions(),
        "machine": machine(),
        "commit": commit(),
    }


def method_of(formulation: "Formulation") -> dict[str, str]:
    """Return what a formulation is in words: cover and degree, enforcement, integrator."""
    cover = formulation.cover
    linear = 0 if blocks_of(cover) is None else 1
    parts = [cover.type, str(cover.degree if cover.degree is not None else linear)]
    if cover.enrichment is not None:
        parts.append("enriched")
    return {
        "cover": " ".join(parts),
        "enforcement": formulation.contact.enforcement,
        "integrator": formulation.integrator.type,
    }


def _record(case: StudyCase, done: Measured, names: Sequence[str]) -> Record:
    summary = done.summary
    usable = summary.status in VALID
    values = {name: quantity(done, name) if usable else float("nan") for name in names}
    return Record(
        **_identity(case),
        status=summary.status,
        sentence=summary.sentence,
        quantities=values,
        spanned=spanned_degree(case.formulation.cover, done),
        phases=dict(summary.seconds),
        effects=dict(summary.effect_seconds),
        unknowns=summary.unknowns,
        elements=summary.elements,
        steps=summary.steps,
        passes=summary.passes,
    )


def _joined(found: Record, times: Sequence[SpentTime], peak: int | None) -> Record:
    """Return the record with the cost of its repeats; phases are those of the median one."""
    if not times:
        return replace(found, memory=peak)
    middle = sorted(times, key=lambda one: one.seconds)[(len(times) - 1) // 2].summary
    return replace(
        found,
        seconds=tuple(one.seconds for one in times),
        wall=tuple(one.wall for one in times),
        phases=dict(middle.seconds),
        effects=dict(middle.effect_seconds),
        memory=peak,
    )


def _told(cases: Sequence[StudyCase], tell: Progress, done: int, total: int) -> Iterator[StudyCase]:
    """Tell each case as it comes."""
    for index, case in enumerate(cases):
        tell((done + index) / total, case.label)
        yield case
