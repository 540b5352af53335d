"""What heat must not contradict; works on unvalidated tables as `nmm.scene.consistency` does."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from nmm.scene.lines import Path

Finding = tuple[Path, str, str, str]
Tables = Mapping[str, Any]

PARTS = ("temperatures", "heat_fluxes", "heat_sources", "convections")


def heat_contradictions(data: Tables) -> Iterator[Finding]:
    """Yield what heat lacks, and what is of heat where no heat is named."""
    if "heat" not in data:
        for key in PARTS:
            if data.get(key):
                yield (key,), "no [heat]", "a scene with heat", f"add [heat], or remove [[{key}]]"
        return
    yield from _durations(data)
    yield from _constants(data)


def _durations(data: Tables) -> Iterator[Finding]:
    heat = data["heat"] if isinstance(data["heat"], Mapping) else {}
    path: Path = ("heat", "duration")
    if "inertia" in data and "duration" in heat:
        remedy = "remove it: heat has the time of the run"
        yield path, "duration with [inertia]", "the duration of the scene", remedy
    if "inertia" not in data and heat.get("transient") is True and "duration" not in heat:
        remedy = 'add duration = "1 h", or [inertia]'
        yield ("heat", "transient"), "duration missing", "a duration", remedy


def _constants(data: Tables) -> Iterator[Finding]:
    """Materials of blocks in which heat is conducted need its constants."""
    heat, materials = data["heat"], data.get("materials")
    transient = isinstance(heat, Mapping) and heat.get("transient") is True
    needs = ["conductivity", *(["heat_capacity", "density"] if transient else [])]
    given = {row.get("block") for row in _rows(data, "temperatures") if "segment" not in row}
    conducting = [
        row.get("material")
        for key in ("blocks", "tessellations")
        for row in _rows(data, key)
        if row.get("name") not in given and "all" not in given
    ]
    for name, row in materials.items() if isinstance(materials, Mapping) else ():
        if name not in conducting or not isinstance(row, Mapping):
            continue
        for key in needs:
            if key not in row:
                expected = "one, as [heat] is named and [[temperatures]] does not give its blocks"
                yield ("materials", name), f"{key} missing", expected, f"add {key}"


def _rows(data: Tables, key: str) -> list[Mapping[str, Any]]:
    value = data.get(key)
    rows = value if isinstance(value, list | tuple) else ()
    return [row for row in rows if isinstance(row, Mapping)]
