"""Where cases are run: a pool of processes here, or a dask.distributed cluster."""

from collections.abc import Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import replace
from multiprocessing import get_context
from typing import Any

from nmm.errors import NmmError
from nmm.study.cases.families import family_of
from nmm.study.cases.record import Record
from nmm.study.cases.threads import one_thread
from nmm.study.cases.variants import StudyCase

# A case whose process dies this often is recorded as failed: it is the case that kills.
ATTEMPTS = 2
PATIENCE = "10s"  # for a scheduler to answer
DIED = "the process that ran it died (killed, or out of memory)"


def run_case(case: StudyCase, quantities: Sequence[str], repeats: int) -> Record:
    """Run one case; what breaks is a record of status "error"."""
    from nmm.study.cases.measure import measure, record

    if repeats == 1:
        return record(case, quantities)
    return measure([case], quantities, repeats, memory=False)[0]


def run_here(
    cases: Sequence[StudyCase], quantities: Sequence[str], repeats: int, processes: int
) -> Iterator[Record]:
    """Yield the records of cases in the order they end, from a pool of processes.

    A process that dies takes down the pool: its cases are run again in a new one, one at a time,
    so that only the one that kills is given up.
    """
    waiting = list(cases)
    done: set[str] = set()
    try:
        for record in _pooled(waiting, quantities, repeats, processes):
            done.add(record.key)
            yield record
    except BrokenProcessPool:
        for case in [one for one in waiting if one.key not in done]:
            yield _alone(case, quantities, repeats)


def _pooled(
    cases: Sequence[StudyCase], quantities: Sequence[str], repeats: int, processes: int
) -> Iterator[Record]:
    with _pool(processes) as pool:
        futures = [pool.submit(run_case, case, quantities, repeats) for case in cases]
        try:
            left: set[Future[Record]] = set(futures)
            while left:
                ended, left = wait(left, return_when=FIRST_COMPLETED)
                # Whole ones first: one that died raises, and these would be run again.
                for future in sorted(ended, key=lambda one: one.exception() is not None):
                    yield future.result()
        finally:
            pool.shutdown(wait=False, cancel_futures=True)


def _alone(case: StudyCase, quantities: Sequence[str], repeats: int) -> Record:
    for _ in range(ATTEMPTS):
        with _pool(1) as pool:
            try:
                return pool.submit(run_case, case, quantities, repeats).result()
            except BrokenProcessPool:
                continue
    return lost(case, DIED)


def _pool(processes: int) -> ProcessPoolExecutor:
    return ProcessPoolExecutor(processes, mp_context=get_context("spawn"), initializer=one_thread)


def lost(case: StudyCase, sentence: str) -> Record:
    """Return the record of a case that nothing came back from."""
    cover = case.formulation.cover
    found = Record(case.name, dict(case.settings), case.key, "error", sentence)
    return replace(found, cover=cover.type, family=family_of(cover))


def run_on_cluster(
    cases: Sequence[StudyCase], quantities: Sequence[str], repeats: int, address: str
) -> Iterator[Record]:
    """Yield the records of cases as they end on the workers of a dask.distributed scheduler.

    A case is a task named by its content, so that a scheduler that gets it twice runs it once. What
    a worker was running when it died is run by another one.

    Raises
    ------
    NmmError
        When the library is missing or no scheduler answers.
    """
    try:
        import distributed
    except ImportError as fault:
        raise NmmError(
            "--scheduler: dask.distributed is not installed: expected the extra: "
            "pip install nmm-framework[cluster]"
        ) from fault
    try:
        # The library has no types.
        cluster: Any = distributed
        client = cluster.Client(address, timeout=PATIENCE, set_as_default=False)
    except (OSError, TimeoutError, ValueError) as fault:
        raise NmmError(
            f"--scheduler {address}: no answer ({fault}): expected the address of a running "
            "scheduler such as tcp://127.0.0.1:8786: start one by `dask scheduler`"
        ) from fault
    with client:
        futures = [
            client.submit(
                run_case, case, tuple(quantities), repeats, key=f"nmm-{case.key}", pure=False
            )
            for case in cases
        ]
        by_key = {future.key: case for future, case in zip(futures, cases, strict=True)}
        for future in cluster.as_completed(futures, loop=client.loop):
            broken = future.exception()
            case = by_key[future.key]
            yield future.result() if broken is None else lost(case, f"{DIED}: {broken}")
