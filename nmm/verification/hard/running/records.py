"""What came of hard cases, line by line in files, so that long runs are made in pieces and kept."""

import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from nmm.errors import NmmError
from nmm.verification.base import Check, Checks
from nmm.verification.hard.cases.base import Document, HardCase
from nmm.verification.hard.running.registry import HARD
from nmm.verification.hard.running.running import Finding

SUFFIX = ".jsonl"
"""Of files of records: one JSON object a line."""

_SHOWN = ("computed", "reference", "tolerance", "reason", "scale", "bound")


def append_record(finding: Finding, path: Path) -> None:
    """Add a finding to a file; what a run that is stopped has written so far is whole."""
    checks = {
        name: {key: getattr(check, key) for key in _SHOWN} for name, check in finding.checks.items()
    }
    record = {
        "class": finding.group,
        "case": finding.case.label,
        "parts": dict(finding.case.parts),
        "seconds": round(finding.seconds, 3),
        "fault": finding.fault,
        "crashed": finding.crashed,
        "checks": checks,
    }
    with path.open("a", encoding="utf-8") as file:
        file.write(json.dumps(record, default=float) + "\n")


def read_records(paths: Iterable[Path]) -> list[Finding]:
    """Return the findings of files, class by class in the order of the registry.

    Where a case stands more than once the last record counts.

    Raises
    ------
    NmmError
        A line that is no record, with its file and number.
    """
    found: dict[tuple[str, str], Finding] = {}
    for path in paths:
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            try:
                finding = _finding(json.loads(line))
            except (ValueError, KeyError, TypeError, AttributeError) as fault:
                raise NmmError(
                    f"{path}, line {number}: {line[:40]!r}: expected a record of a hard case, as "
                    f"`nmm verify --hard --out NAME{SUFFIX}` writes it ({fault}): remove the line"
                ) from fault
            found[finding.group, finding.case.label] = finding
    order = {name: place for place, name in enumerate(HARD.table)}
    return sorted(found.values(), key=lambda one: order.get(one.group, len(order)))


def _finding(record: dict[str, Any]) -> Finding:
    case = HardCase(record["case"], {}, _not_kept, record["parts"])
    checks = {name: Check(**values) for name, values in record["checks"].items()}
    return Finding(
        record["class"], case, checks, record["fault"], record["crashed"], record["seconds"]
    )


def _not_kept(scene: Document) -> Checks:
    """Stand for what judged a case of which the record alone is left."""
    raise NmmError("a hard case read from a record: its scene is not kept: run it by its class")
