"""Consistency rules of heat, on unvalidated tables as in `nmm.scene.consistency`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from nmm.scene.tables.field_rules import durations, lacking
from nmm.scene.unread_rows import Finding, Tables

PARTS = ("temperatures", "heat_fluxes", "heat_sources", "convections")


def heat_contradictions(data: Tables) -> Iterator[Finding]:
    """Yield what heat lacks, and tables of heat without ``[heat]``."""
    if "heat" not in data:
        for key in PARTS:
            if data.get(key):
                yield (key,), "no [heat]", "a scene with heat", f"add [heat], or remove [[{key}]]"
        return
    yield from durations(data, "heat")
    yield from _constants(data)


def _constants(data: Tables) -> Iterator[Finding]:
    """Materials of blocks in which heat is conducted need its constants."""
    heat = data["heat"]
    transient = isinstance(heat, Mapping) and heat.get("transient") is True
    needs = ["conductivity", *(["heat_capacity", "density"] if transient else [])]
    expected = "one, as [heat] is named and [[temperatures]] does not give its blocks"
    yield from lacking(data, "temperatures", needs, expected)
