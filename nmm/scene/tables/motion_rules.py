"""What motions of the ground, dampers and moving loads must not contradict.

Works on unvalidated tables as `nmm.scene.consistency` does.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from nmm.scene.faults import suggestion
from nmm.scene.lines import Path

Finding = tuple[Path, str, str, str]  # path, value, expected, remedy
Tables = Mapping[str, Any]


def motion_contradictions(data: Tables) -> Iterator[Finding]:
    """Yield records that are not there, and what moves in scenes without time."""
    if "damping" in data and "inertia" not in data:
        yield ("damping",), "no [inertia]", "a dynamic scene", "add [inertia], or remove [damping]"
    for path, row in _rows(data, "supports"):
        yield from _named_records(data, (*path, "motion"), row.get("motion"))
        if row.get("motion") and "inertia" not in data:
            remedy = "add [inertia], or give displacement with a history"
            yield (*path, "motion"), "no [inertia]", "a dynamic scene", remedy


def _named_records(data: Tables, path: Path, motion: object) -> Iterator[Finding]:
    known = data.get("records")
    names = list(known) if isinstance(known, Mapping) else []
    for axis, name in motion.items() if isinstance(motion, Mapping) else ():
        if isinstance(name, str) and name not in names:
            expected = "the name of one of [records.NAME]"
            yield (*path, axis), f'"{name}"', expected, suggestion(name, names)


def _rows(data: Tables, key: str) -> Iterator[tuple[Path, Tables]]:
    value = data.get(key)
    for index, row in enumerate(value if isinstance(value, list | tuple) else ()):
        if isinstance(row, Mapping):
            yield (key, index), row
