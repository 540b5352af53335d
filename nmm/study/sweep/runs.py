"""Sweeps and ensembles: every case once, what is done is skipped, what fails is recorded."""

import os
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from nmm.study.cases.pool import run_here, run_on_cluster
from nmm.study.cases.record import Record
from nmm.study.cases.variants import StudyCase
from nmm.study.sweep.store import Store
from nmm.study.sweep.study_file import StudyPlan

CASES = "cases"

Told = Callable[[int, int, Record], None]


@dataclass(frozen=True)
class Sweep:
    """A study that has been run.

    Attributes
    ----------
    plan
        The study file.
    records
        One a case, in the order of the plan.
    skipped
        How many had been done before.
    """

    plan: StudyPlan
    records: list[Record]
    skipped: int


def run_study(
    plan: StudyPlan,
    cases: Sequence[StudyCase],
    out: Path,
    *,
    scheduler: str | None = None,
    processes: int | None = None,
    again: bool = False,
    tell: Told | None = None,
) -> Sweep:
    """Run what is not done yet and return all records.

    Parameters
    ----------
    plan, cases
        As `read_plan` gives them.
    out
        Folder of the study; a case's record is written there as soon as it ends.
    scheduler
        Address of a dask.distributed scheduler; a pool of processes here when None.
    processes
        Size of the pool; one a core when None.
    again
        Run cases again whose run failed before.
    tell
        Called with how many are done, how many there are, and the last record.
    """
    store = Store(out / CASES)
    found = {case.key: store.find(case, plan.quantities) for case in cases}
    open_cases = [case for case in cases if _to_run(found[case.key], again)]
    # Equal cases under two names are one run.
    todo = list({case.key: case for case in open_cases}.values())
    skipped = len(cases) - len(open_cases)
    fresh = (
        run_on_cluster(todo, plan.quantities, plan.repeats, scheduler)
        if scheduler
        else run_here(todo, plan.quantities, plan.repeats, processes or os.cpu_count() or 1)
    )
    for number, record in enumerate(fresh if todo else ()):
        store.keep(record)
        if tell is not None:
            tell(skipped + number + 1, len(cases), record)
    return Sweep(plan, list(_all(store, cases)), skipped)


def _to_run(record: Record | None, again: bool) -> bool:
    return record is None or (again and not record.valid)


def _all(store: Store, cases: Sequence[StudyCase]) -> Iterator[Record]:
    for case in cases:
        record = store.find(case, ())
        if record is not None:
            yield record
