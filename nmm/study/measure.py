"""Running cases and taking their cost: interleaved repeats after a warm-up, one thread a case."""

import platform
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from multiprocessing import get_context
from pathlib import Path
from time import perf_counter, process_time

from nmm.errors import NmmError
from nmm.results.summary import installed_versions
from nmm.stepping.run import Run, run
from nmm.study.quantities import quantity
from nmm.study.record import Record
from nmm.study.variants import Case

Progress = Callable[[float, str], None]


def measure(
    cases: Sequence[Case],
    names: Sequence[str],
    repeats: int = 3,
    memory: bool = True,
    progress: Progress | None = None,
) -> list[Record]:
    """Run every case ``repeats`` times, all cases in turn, after one round that is not counted.

    Parameters
    ----------
    cases
        What is run.
    names
        Quantities read off each run.
    repeats
        Counted runs of each case; a case whose warm-up failed is not repeated.
    memory
        Also run each case once in a process of its own to see how much memory it adds.
    """
    tell = progress or (lambda share, text: None)
    total = (repeats + 1) * len(cases)
    found = [_once(case, names) for case in _told(cases, tell, 0, total)]
    times: list[list[tuple[float, float]]] = [[] for _ in cases]
    for turn in range(repeats):
        for index, case in enumerate(_told(cases, tell, (turn + 1) * len(cases), total)):
            if found[index].status != "error":
                times[index].append(_timed(case))
    peaks = [
        _peak(case) if memory and one.status != "error" else None
        for case, one in zip(cases, found, strict=True)
    ]
    return [_joined(one, many, peak) for one, many, peak in zip(found, times, peaks, strict=True)]


def record(case: Case, names: Sequence[str]) -> Record:
    """Run one case once and return its record, with the seconds of that one run."""
    started = (process_time(), perf_counter())
    found = _once(case, names)
    spent = (process_time() - started[0], perf_counter() - started[1])
    return _joined(found, [spent], None)


def _once(case: Case, names: Sequence[str]) -> Record:
    try:
        done = run(case.scene, case.formulation)
    except NmmError as fault:
        return Record(case.name, dict(case.settings), case.key, "error", str(fault))
    return _record(case, done, names)


def _record(case: Case, done: Run, names: Sequence[str]) -> Record:
    summary = done.summary
    usable = summary.status in ("converged", "failure_load")
    values = {name: quantity(done, name) if usable else float("nan") for name in names}
    return Record(
        name=case.name,
        settings=dict(case.settings),
        key=case.key,
        status=summary.status,
        sentence=summary.sentence,
        quantities=values,
        phases=dict(summary.seconds),
        unknowns=summary.unknowns,
        elements=summary.elements,
        steps=summary.steps,
        passes=summary.passes,
        versions=installed_versions(),
        machine=f"{platform.machine()}, {platform.system()} {platform.release()}",
    )


def _timed(case: Case) -> tuple[float, float]:
    cpu, wall = process_time(), perf_counter()
    run(case.scene, case.formulation)
    return process_time() - cpu, perf_counter() - wall


def _joined(found: Record, times: Sequence[tuple[float, float]], peak: int | None) -> Record:
    return replace(
        found,
        seconds=tuple(cpu for cpu, _ in times),
        wall=tuple(wall for _, wall in times),
        memory=peak,
    )


def _peak(case: Case) -> int | None:
    """Bytes that a run adds to a fresh process at its peak."""
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        return pool.submit(_added_memory, case).result()


def _added_memory(case: Case) -> int | None:
    try:
        # A new process keeps the peak of the one it was made by until it is reset.
        Path("/proc/self/clear_refs").write_text("5")
        before = _high_water()
        run(case.scene, case.formulation)
        return _high_water() - before
    except OSError:
        return None


def _high_water() -> int:
    """Largest resident memory so far (bytes), as Linux counts it."""
    status = Path("/proc/self/status").read_text()
    return int(status.split("VmHWM:")[1].split()[0]) * 1024


def _told(cases: Sequence[Case], tell: Progress, done: int, total: int) -> Iterator[Case]:
    """Tell each case as it comes."""
    for index, case in enumerate(cases):
        tell((done + index) / total, case.label)
        yield case
