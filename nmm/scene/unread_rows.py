"""Rows of unvalidated tables, which may be anything."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from nmm.scene.lines import Path

Finding = tuple[Path, str, str, str]
"""A finding of a rule: place, value, what was expected, what to do."""

Tables = Mapping[str, Any]


def rows(data: Tables, *keys: str) -> Iterator[tuple[Path, Tables]]:
    """Yield the rows of the tables ``[[key]]``, each with its path."""
    for key in keys:
        value = data.get(key)
        for index, row in enumerate(value if isinstance(value, list | tuple) else ()):
            if isinstance(row, Mapping):
                yield (key, index), row


def has_clock(data: Tables) -> bool:
    """Return whether time passes in a scene: with inertia, or quasi-statically over a duration."""
    whole = "inertia" in data or "duration" in data
    return whole or any("duration" in stage for _, stage in rows(data, "stages"))
