"""Rules of heat and water in blocks and joints."""

from __future__ import annotations

from collections.abc import Iterator

from nmm.scene.rules.unread_tables import (
    SOLIDS,
    Finding,
    Tables,
    named,
    names,
    rows,
    table,
    unknown,
)

HEAT = ("temperatures", "heat_fluxes", "heat_sources", "convections")
SEEPING = ("heads", "inflows")
WET = ("water_pressures", "joint_heads", *SEEPING)


def heat_contradictions(data: Tables) -> Iterator[Finding]:
    """Yield what heat lacks, and tables of heat without ``[heat]``."""
    if "heat" not in data:
        yield from _without(data, "heat", "heat", HEAT)
        return
    yield from _durations(data, "heat")
    transient = table(data, "heat").get("transient") is True
    needs = ["conductivity", *(["heat_capacity", "density"] if transient else [])]
    expected = "one, as [heat] is named and [[temperatures]] does not give its blocks"
    yield from _lacking(data, "temperatures", needs, expected)


def water_contradictions(data: Tables) -> Iterator[Finding]:
    """Yield what water lacks in blocks, joints and cracks, and tables of it without its effect."""
    cracks = names(data, "cracks")
    for path, row in rows(data, "water_pressures"):
        yield from unknown((*path, "crack"), row.get("crack"), "the name of a crack", cracks)
    if "joint_flow" not in data:
        yield from _without(data, "joint_flow", "water in joints", ("joint_heads",))
    else:
        yield from _durations(data, "joint_flow")
        if not data.get("joint_heads"):
            remedy = "add [[joint_heads]] with a point and a head"
            yield ("joint_flow",), "no head", "at least one of [[joint_heads]]", remedy
    if "seepage" not in data:
        yield from _without(data, "seepage", "seepage", SEEPING)
    else:
        yield from _seepage(data)


def _seepage(data: Tables) -> Iterator[Finding]:
    seepage = table(data, "seepage")
    transient = seepage.get("transient") is True
    if seepage.get("coupled") is True and data.get("plane") == "stress":
        expected = "plane strain: pores widen across a plate, too"
        yield ("seepage", "coupled"), "true in plane stress", expected, 'use plane = "strain"'
    yield from _durations(data, "seepage")
    needs = ["hydraulic_conductivity", *(["specific_storage"] if transient else [])]
    if transient and seepage.get("free_surface") is True:
        needs.append("drainable_porosity")
    expected = "one, as [seepage] is named and [[heads]] does not give its blocks"
    yield from _lacking(data, "heads", needs, expected)


def _without(data: Tables, effect: str, what: str, keys: tuple[str, ...]) -> Iterator[Finding]:
    """Yield tables of an effect that is not named."""
    for key in keys:
        if data.get(key):
            remedy = f"add [{effect}], or remove [[{key}]]"
            yield (key,), f"no [{effect}]", f"a scene with {what}", remedy


def _durations(data: Tables, key: str) -> Iterator[Finding]:
    """Yield a duration of ``[key]`` that is given twice or missing."""
    field = table(data, key)
    if "inertia" in data and "duration" in field:
        remedy = f"remove it: {key} has the time of the run"
        yield (key, "duration"), "duration with [inertia]", "the duration of the scene", remedy
    if "inertia" not in data and field.get("transient") is True and "duration" not in field:
        remedy = 'add duration = "1 h", or [inertia]'
        yield (key, "transient"), "duration missing", "a duration", remedy


def _lacking(data: Tables, given: str, needs: list[str], expected: str) -> Iterator[Finding]:
    """Yield materials that lack constants of a field that is solved in their blocks.

    ``given`` is the table that may prescribe it in whole blocks.
    """
    # A list, not a set, as unvalidated names may be unhashable.
    known = [row.get("block") for _, row in rows(data, given) if "segment" not in row]
    solved = [
        row.get("material")
        for _, row in rows(data, *SOLIDS)
        if row.get("name") not in known and "all" not in known
    ]
    for name, row in named(data, "materials"):
        for key in needs if name in solved else ():
            if key not in row:
                yield ("materials", name), f"{key} missing", expected, f"add {key}"
