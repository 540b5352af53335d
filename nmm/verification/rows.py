"""Rows of the manual's list, kept beside it so that a part can be run again without the rest."""

import json
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from nmm.verification.outcomes import Outcome

FILE = "results.json"


@dataclass(frozen=True)
class Row:
    """All variants of a benchmark under one formulation, by their worst quantity.

    Attributes
    ----------
    benchmark, title, formulation
        What was run.
    quantity, computed, reference, error, tolerance
        The quantity that comes nearest to what is allowed, in words; the fault when there is one.
    passed
        Whether every quantity of every variant is within its tolerance.
    runs, missed
        How many variants there are, and how many missed.
    seconds
        Processor time of all variants.
    shares
        Error over tolerance of every quantity.
    """

    benchmark: str
    title: str
    formulation: str
    quantity: str
    computed: str
    reference: str
    error: str
    tolerance: str
    passed: bool
    runs: int
    missed: int
    seconds: float
    shares: list[float]

    @classmethod
    def of(cls, many: Sequence[Outcome]) -> "Row":
        """Sum up runs of one benchmark under one formulation."""
        checks = [item for one in many for item in one.checks.items()]
        words = ("", "", "", "", "")
        if fault := next((one.fault for one in many if one.fault), ""):
            words = (f"fault: {fault}", "", "", "", "")
        elif checks:
            name, worst = max(checks, key=lambda item: item[1].share)
            words = (name, worst.shown, worst.wanted, *worst.missed_by)
        return cls(
            many[0].case.name,
            many[0].case.title,
            many[0].formulation,
            *words,
            passed=all(one.passed for one in many),
            runs=len(many),
            missed=sum(not one.passed for one in many),
            seconds=round(sum(one.seconds for one in many), 3),
            shares=[float(f"{min(check.share, 1e9):.3g}") for _, check in checks],
        )


def rows_of(outcomes: Iterable[Outcome]) -> Iterator[Row]:
    """Yield a row for each benchmark and formulation, in the order they were run."""
    groups: dict[tuple[str, str], list[Outcome]] = {}
    for one in outcomes:
        groups.setdefault((one.case.name, one.formulation), []).append(one)
    return (Row.of(many) for many in groups.values())


def merged(fresh: Iterable[Outcome], out: Path) -> list[Row]:
    """Return the rows that a folder holds with those of benchmarks run again, and keep them there.

    Of a benchmark that was run all rows are replaced: formulations that are gone do not stay.
    """
    new = list(rows_of(fresh))
    names = {row.benchmark for row in new}
    path = out / FILE
    old = [Row(**item) for item in json.loads(path.read_text("utf-8"))] if path.exists() else []
    rows = [row for row in old if row.benchmark not in names] + new
    lines = ",\n".join(json.dumps(asdict(row)) for row in rows)
    path.write_text(f"[\n{lines}\n]\n", encoding="utf-8")
    return rows
