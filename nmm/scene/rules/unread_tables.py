"""Unvalidated tables, which may be anything, and names in them that lead nowhere."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from typing import Any

from nmm.scene.faults import suggestion
from nmm.scene.lines import Path

Finding = tuple[Path, str, str, str]
"""A finding of a rule: place, value, what was expected, what to do."""

Tables = Mapping[str, Any]

SOLIDS = ("blocks", "tessellations")
"""Keys of the tables that make blocks."""


def table(data: Tables, key: str) -> Tables:
    """Return the table ``[key]``, an empty one for anything else."""
    value = data.get(key)
    return value if isinstance(value, Mapping) else {}


def rows(data: Tables, *keys: str) -> Iterator[tuple[Path, Tables]]:
    """Yield the rows of the tables ``[[key]]``, each with its path."""
    for key in keys:
        value = data.get(key)
        for index, row in enumerate(value if isinstance(value, list | tuple) else ()):
            if isinstance(row, Mapping):
                yield (key, index), row


def named(data: Tables, key: str) -> Iterator[tuple[str, Tables]]:
    """Yield the tables ``[key.NAME]`` with their names."""
    for name, row in table(data, key).items():
        if isinstance(row, Mapping):
            yield name, row


def names(data: Tables, *keys: str) -> list[str]:
    """Return the names of the rows of the tables ``[[key]]``."""
    return [row["name"] for _, row in rows(data, *keys) if isinstance(row.get("name"), str)]


def texts(row: Tables, key: str) -> list[str]:
    """Return the texts of a list, none for anything else."""
    value = row.get(key)
    return [one for one in value if isinstance(one, str)] if isinstance(value, list | tuple) else []


def has_clock(data: Tables) -> bool:
    """Return whether time passes in a scene: with inertia, or quasi-statically over a duration."""
    whole = "inertia" in data or "duration" in data
    return whole or any("duration" in stage for _, stage in rows(data, "stages"))


def unknown(path: Path, name: object, expected: str, known: list[str]) -> Iterator[Finding]:
    """Yield a name that is none of those known."""
    if isinstance(name, str) and name not in known:
        yield path, f'"{name}"', expected, suggestion(name, known)


def unknown_block(
    path: Path, name: object, blocks: list[str], others: Collection[str] = ("all",)
) -> Iterator[Finding]:
    """Yield a name that is no block, no piece "beam.12" of one, and none of ``others``."""
    if isinstance(name, str) and name not in others and name.split(".")[0] not in blocks:
        beside = [f'"{one}"' for one in others if one != "all"]
        expected = ", or ".join(["the name of a block", *beside])
        yield path, f'"{name}"', expected, suggestion(name, blocks)
