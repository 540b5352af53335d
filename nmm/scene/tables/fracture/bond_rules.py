"""Consistency rules of bonded cracks, on unvalidated tables."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from nmm.scene.unread_rows import Finding, Tables, rows


def bonded_crack_contradictions(data: Tables) -> Iterator[Finding]:
    """Yield what is missing for cracks whose faces are bonded at first."""
    for path, row in rows(data, "cracks"):
        if row.get("bonded") is not True:
            continue
        place, value = (*path, "bonded"), "bonded = true"
        if "contact" not in data:
            yield place, f"{value} without [contact]", "a scene with contact", "add [contact]"
        elif not has_bond(data):
            remedy = "add bonded = true and tensile_strength to an interface"
            yield place, value, "an interface that is bonded", remedy


def has_bond(data: Tables) -> bool:
    """Whether any interface is bonded."""
    tables = data.get("interfaces")
    found = tables.values() if isinstance(tables, Mapping) else ()
    return any(isinstance(one, Mapping) and one.get("bonded") is True for one in found)
