"""What water must not contradict; works on unvalidated tables as `nmm.scene.consistency` does."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from nmm.scene.faults import suggestion
from nmm.scene.lines import Path

Finding = tuple[Path, str, str, str]
Tables = Mapping[str, Any]

PLACED = ("water_pressures",)


def water_contradictions(data: Tables) -> Iterator[Finding]:
    """Yield what water names that does not exist."""
    known = [row["name"] for row in _rows(data, "cracks") if isinstance(row.get("name"), str)]
    for number, row in enumerate(_rows(data, "water_pressures")):
        name = row.get("crack")
        if isinstance(name, str) and name not in known:
            path: Path = ("water_pressures", number, "crack")
            yield path, f'"{name}"', "the name of a crack", suggestion(name, known)


def _rows(data: Tables, key: str) -> list[Mapping[str, Any]]:
    value = data.get(key)
    rows = value if isinstance(value, list | tuple) else ()
    return [row for row in rows if isinstance(row, Mapping)]
