"""How much memory a run adds at its peak, measured in a process of its own."""

import sys
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from importlib import import_module
from multiprocessing import get_context
from pathlib import Path

from nmm.study.cases.running import run_case
from nmm.study.cases.variants import StudyCase

# Packages whose modules are loaded before memory is measured: they are no part of a run.
_LOADED = ("integration", "covers", "nmm", "scipy", "skfem", "shapely", "numba")


def added_memory(case: StudyCase) -> int | None:
    """Bytes that a run adds to a fresh process at its peak; None when they cannot be told.

    What this process has imported is imported there before, so a case should have run here once.
    """
    return next(added_memories([case]))


def added_memories(cases: Sequence[StudyCase]) -> Iterator[int | None]:
    """Yield the memory of each case, one after the other in one process that gives memory back.

    What libraries keep after their first use, 6 to 40 MiB, is not counted where there are several
    cases, as each is run twice then; the rest agrees within about a tenth with that of a fresh
    process for each, which takes seconds to begin.
    """
    modules = [name for name in sys.modules if name.partition(".")[0] in _LOADED]
    left = list(cases)
    while left:
        with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
            try:
                while left:
                    if len(cases) > 1:
                        pool.submit(_added_memory, left[0], modules).result()
                    found = pool.submit(_added_memory, left[0], modules).result()
                    left.pop(0)
                    yield found
            except BrokenProcessPool:
                left.pop(0)
                yield None


def _added_memory(case: StudyCase, modules: Sequence[str]) -> int | None:
    for name in modules:
        try:
            import_module(name)
        except Exception:  # some modules of libraries cannot be imported alone
            continue
    try:
        _give_back()
        # A new process keeps the peak of the one it was made by until it is reset.
        Path("/proc/self/clear_refs").write_text("5")
        before = _high_water()
        run_case(case)
        return _high_water() - before
    except (OSError, ValueError):
        return None


def _give_back() -> None:
    """Return freed memory to the system, so that it counts again when it is taken."""
    import ctypes
    import gc

    gc.collect()
    trim = getattr(ctypes.CDLL(None), "malloc_trim", None)
    if trim is not None:
        trim(0)


def _high_water() -> int:
    """Largest resident memory so far (bytes), as Linux counts it."""
    status = Path("/proc/self/status").read_text()
    return int(status.split("VmHWM:")[1].split()[0]) * 1024
