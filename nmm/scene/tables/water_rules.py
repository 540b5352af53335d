"""What water must not contradict; works on unvalidated tables as `nmm.scene.consistency` does."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from nmm.scene.faults import suggestion
from nmm.scene.lines import Path

Finding = tuple[Path, str, str, str]
Tables = Mapping[str, Any]

SEEPING = ("heads", "inflows")
PLACED = ("water_pressures", "joint_heads", *SEEPING)


def water_contradictions(data: Tables) -> Iterator[Finding]:
    """Yield what water names that does not exist."""
    known = [row["name"] for row in _rows(data, "cracks") if isinstance(row.get("name"), str)]
    for number, row in enumerate(_rows(data, "water_pressures")):
        name = row.get("crack")
        if isinstance(name, str) and name not in known:
            path: Path = ("water_pressures", number, "crack")
            yield path, f'"{name}"', "the name of a crack", suggestion(name, known)
    if data.get("joint_heads") and "joint_flow" not in data:
        remedy = "add [joint_flow], or remove [[joint_heads]]"
        yield ("joint_heads",), "no [joint_flow]", "a scene with water in joints", remedy
    if "joint_flow" in data and not data.get("joint_heads"):
        remedy = "add [[joint_heads]] with a point and a head"
        yield ("joint_flow",), "no head", "at least one of [[joint_heads]]", remedy


def seepage_contradictions(data: Tables) -> Iterator[Finding]:
    """Yield what seepage lacks, and what is of seepage where none is named."""
    if "seepage" not in data:
        for key in SEEPING:
            if data.get(key):
                expected = "a scene with seepage"
                yield (key,), "no [seepage]", expected, f"add [seepage], or remove [[{key}]]"
        return
    table = data["seepage"] if isinstance(data["seepage"], Mapping) else {}
    transient = table.get("transient") is True
    if "inertia" in data and "duration" in table:
        remedy = "remove it: seepage has the time of the run"
        path: Path = ("seepage", "duration")
        yield path, "duration with [inertia]", "the duration of the scene", remedy
    if "inertia" not in data and transient and "duration" not in table:
        remedy = 'add duration = "1 h", or [inertia]'
        yield ("seepage", "transient"), "duration missing", "a duration", remedy
    needs = ["hydraulic_conductivity", *(["specific_storage"] if transient else [])]
    expected = "one, as [seepage] is named and [[heads]] does not give its blocks"
    yield from lacking(data, "heads", needs, expected)


def lacking(data: Tables, given: str, needs: list[str], expected: str) -> Iterator[Finding]:
    """Yield materials of blocks in which a field is solved that lack its constants.

    ``given`` are the tables that may give it in whole blocks.
    """
    known = {row.get("block") for row in _rows(data, given) if "segment" not in row}
    solved = [
        row.get("material")
        for key in ("blocks", "tessellations")
        for row in _rows(data, key)
        if row.get("name") not in known and "all" not in known
    ]
    materials = data.get("materials")
    for name, row in materials.items() if isinstance(materials, Mapping) else ():
        if name in solved and isinstance(row, Mapping):
            for key in needs:
                if key not in row:
                    yield ("materials", name), f"{key} missing", expected, f"add {key}"


def _rows(data: Tables, key: str) -> list[Mapping[str, Any]]:
    value = data.get(key)
    rows = value if isinstance(value, list | tuple) else ()
    return [row for row in rows if isinstance(row, Mapping)]
