"""Consistency rules of crack growth, on unvalidated tables."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from nmm.scene.lines import Path
from nmm.scene.unread_rows import Finding, Tables, rows

# Keys of dynamic growth alone.
IN_TIME = ("speed", "branching")
# Tables whose actions one load factor does not scale.
NOT_SCALED = ("contact", "gravity", "heat", "inertia", "initial_stresses", "seepage", "stages")


def fracture_contradictions(data: Tables) -> Iterator[Finding]:
    """Yield what ``[fracture]`` lacks and is incompatible with."""
    table = data.get("fracture")
    if table is None:
        return
    begins = isinstance(table, Mapping) and table.get("nucleation")
    if not data.get("cracks") and not begins:
        remedy = "add the cracks that are there from the start, or [fracture.nucleation]"
        yield ("fracture",), "no [[cracks]]", "a crack that can grow", remedy
    for key in IN_TIME if isinstance(table, Mapping) and "inertia" not in data else ():
        if table.get(key):
            remedy = "add [inertia], or remove it"
            yield ("fracture", key), f'"{table[key]}"', "a scene with [inertia]", remedy
    if isinstance(table, Mapping) and table.get("branching_length") and not table.get("branching"):
        remedy = "add branching, the angle of branches, or remove it"
        yield ("fracture", "branching_length"), "no branching", "tips that divide", remedy
    if isinstance(begins, Mapping) and begins.get("criterion") == "coupled":
        for key in ("length", "crack_length"):
            if key in begins:
                value, expected = f'{key} with criterion = "coupled"', "lengths that energy finds"
                yield ("fracture", "nucleation", key), value, expected, f"remove {key}"
    if isinstance(table, Mapping) and table.get("control") == "toughness":
        yield from _control(data)


def _control(data: Tables) -> Iterator[Finding]:
    path: Path = ("fracture", "control")
    for key in NOT_SCALED:
        if data.get(key) not in (None, (), []):
            remedy = f'use control = "loads", or remove [{key}]'
            yield path, f'"toughness" with [{key}]', "loads that one factor scales", remedy
    loading = data.get("loading")
    scaled = loading.get("scaled", "all") if isinstance(loading, Mapping) else "all"
    if scaled != "all":
        remedy = 'use control = "loads", or scaled = "all"'
        yield path, f'"toughness" with scaled = {scaled}', "loads that one factor scales", remedy
    alone = isinstance(loading, Mapping) and not data.get("loads")
    for _, row in rows(data, "supports"):
        if _driven(row) and not (alone and row.get("history") is None):
            value = (
                f'"toughness" with the displacement of {row.get("name")!r}, which is there in full'
            )
            remedy = "add [loading], without [[loads]] and history beside it, or drive by loads"
            yield path, value, "loads that one factor scales", remedy


def _driven(support: Mapping[str, object]) -> bool:
    """Whether a support has a prescribed displacement."""
    way = support.get("displacement")
    parts = way if isinstance(way, list | tuple) else ()
    return support.get("field") is not None or any(part not in (0, 0.0) for part in parts)
