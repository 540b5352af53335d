"""Consistency rules of fields in blocks: heat and seepage."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from nmm.scene.unread_rows import Finding, Tables, rows


def durations(data: Tables, key: str) -> Iterator[Finding]:
    """Yield a duration of ``[key]`` that is given twice or missing."""
    table = data[key] if isinstance(data[key], Mapping) else {}
    if "inertia" in data and "duration" in table:
        remedy = f"remove it: {key} has the time of the run"
        yield (key, "duration"), "duration with [inertia]", "the duration of the scene", remedy
    if "inertia" not in data and table.get("transient") is True and "duration" not in table:
        remedy = 'add duration = "1 h", or [inertia]'
        yield (key, "transient"), "duration missing", "a duration", remedy


def lacking(data: Tables, given: str, needs: list[str], expected: str) -> Iterator[Finding]:
    """Yield materials that lack constants of a field that is solved in their blocks.

    ``given`` is the table that may prescribe it in whole blocks.
    """
    # A list, not a set, as unvalidated names may be unhashable.
    known = [row.get("block") for _, row in rows(data, given) if "segment" not in row]
    solved = [
        row.get("material")
        for _, row in rows(data, "blocks", "tessellations")
        if row.get("name") not in known and "all" not in known
    ]
    materials = data.get("materials")
    for name, row in materials.items() if isinstance(materials, Mapping) else ():
        if name in solved and isinstance(row, Mapping):
            for key in needs:
                if key not in row:
                    yield ("materials", name), f"{key} missing", expected, f"add {key}"
