"""Rules of names: each is given once, and leads to a block, a material or a pair of materials."""

from __future__ import annotations

from collections.abc import Iterator

from nmm.scene.lines import Path
from nmm.scene.rules.fields import HEAT, WET
from nmm.scene.rules.motion import EDGES
from nmm.scene.rules.unread_tables import (
    SOLIDS,
    Finding,
    Tables,
    named,
    names,
    rows,
    table,
    unknown,
    unknown_block,
)

_PLACED = ("supports", "loads", "monitors", *HEAT, *WET, *EDGES)
_NAMED = ("joint_sets", "cracks", "stages", *_PLACED)
_AT_BLOCKS = (*_PLACED, "initial_velocities", "initial_stresses", "joint_sets")


def name_contradictions(data: Tables) -> Iterator[Finding]:
    """Yield a scene without blocks, names given twice, and names that lead nowhere."""
    if not any(data.get(key) for key in SOLIDS):
        yield ("blocks",), "no block", "at least one block", "add [[blocks]] or [[tessellations]]"
    for keys in (SOLIDS, *((key,) for key in _NAMED)):
        yield from _given_twice(data, keys)
    materials, blocks = list(table(data, "materials")), names(data, *SOLIDS)
    for path, row in rows(data, *SOLIDS):
        expected = "the name of a material"
        yield from unknown((*path, "material"), row.get("material"), expected, materials)
    yield from _pairs(data, materials)
    for path, row in rows(data, *_AT_BLOCKS):
        yield from unknown_block((*path, "block"), row.get("block"), blocks)


def _given_twice(data: Tables, keys: tuple[str, ...]) -> Iterator[Finding]:
    seen: dict[str, Path] = {}
    for path, row in rows(data, *keys):
        name = row.get("name")
        if not isinstance(name, str):
            continue
        if name in seen:
            first = ".".join(str(part) for part in seen[name])
            yield (*path, "name"), f'"{name}"', "a name of its own", f"{first} has it already"
        if name in ("all", "any"):
            yield (*path, "name"), f'"{name}"', "another name", f'"{name}" means every block'
        seen.setdefault(name, path)


def _pairs(data: Tables, materials: list[str]) -> Iterator[Finding]:
    """Yield materials of interfaces that do not exist, and pairs that two interfaces have."""
    seen: dict[frozenset[str], str] = {}
    for name, row in named(data, "interfaces"):
        between = row.get("between", "any")
        pair = (between,) if isinstance(between, str) else between
        if not isinstance(pair, list | tuple) or not all(isinstance(item, str) for item in pair):
            continue
        path: Path = ("interfaces", name, "between")
        for material in pair if between != "any" else ():
            yield from unknown(path, material, "the name of a material", materials)
        key = frozenset(pair)
        if key in seen:
            remedy = f'interface "{seen[key]}" has it already; keep one'
            yield path, str(between), "a pair of its own", remedy
        seen.setdefault(key, name)
