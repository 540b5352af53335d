"""What heat must not contradict; works on unvalidated tables as `nmm.scene.consistency` does."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from nmm.scene.lines import Path
from nmm.scene.tables.water_rules import lacking

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
    heat = data["heat"]
    transient = isinstance(heat, Mapping) and heat.get("transient") is True
    needs = ["conductivity", *(["heat_capacity", "density"] if transient else [])]
    expected = "one, as [heat] is named and [[temperatures]] does not give its blocks"
    yield from lacking(data, "temperatures", needs, expected)
