"""Consistency rules of water, on unvalidated tables as in `nmm.scene.consistency`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from nmm.scene.faults import suggestion
from nmm.scene.tables.field_rules import durations, lacking
from nmm.scene.unread_rows import Finding, Tables, rows

SEEPING = ("heads", "inflows")
PLACED = ("water_pressures", "joint_heads", *SEEPING)


def water_contradictions(data: Tables) -> Iterator[Finding]:
    """Yield names in tables of water that do not exist."""
    known = [row["name"] for _, row in rows(data, "cracks") if isinstance(row.get("name"), str)]
    for path, row in rows(data, "water_pressures"):
        name = row.get("crack")
        if isinstance(name, str) and name not in known:
            yield (*path, "crack"), f'"{name}"', "the name of a crack", suggestion(name, known)
    if data.get("joint_heads") and "joint_flow" not in data:
        remedy = "add [joint_flow], or remove [[joint_heads]]"
        yield ("joint_heads",), "no [joint_flow]", "a scene with water in joints", remedy
    if "joint_flow" in data:
        yield from durations(data, "joint_flow")
    if "joint_flow" in data and not data.get("joint_heads"):
        remedy = "add [[joint_heads]] with a point and a head"
        yield ("joint_flow",), "no head", "at least one of [[joint_heads]]", remedy


def seepage_contradictions(data: Tables) -> Iterator[Finding]:
    """Yield what seepage lacks, and tables of seepage without ``[seepage]``."""
    if "seepage" not in data:
        for key in SEEPING:
            if data.get(key):
                expected = "a scene with seepage"
                yield (key,), "no [seepage]", expected, f"add [seepage], or remove [[{key}]]"
        return
    table = data["seepage"] if isinstance(data["seepage"], Mapping) else {}
    transient = table.get("transient") is True
    if table.get("coupled") is True and data.get("plane") == "stress":
        expected = "plane strain: pores widen across a plate, too"
        yield ("seepage", "coupled"), "true in plane stress", expected, 'use plane = "strain"'
    yield from durations(data, "seepage")
    needs = ["hydraulic_conductivity", *(["specific_storage"] if transient else [])]
    if transient and table.get("free_surface") is True:
        needs.append("drainable_porosity")
    expected = "one, as [seepage] is named and [[heads]] does not give its blocks"
    yield from lacking(data, "heads", needs, expected)
