"""Consistency rules of members, on unvalidated tables."""

from __future__ import annotations

from collections.abc import Iterator

from nmm.scene.faults import suggestion
from nmm.scene.lines import Path
from nmm.scene.tables.members import GROUND, MEMBERS
from nmm.scene.unread_rows import Finding, Tables, rows


def member_contradictions(data: Tables) -> Iterator[Finding]:
    """Yield repeated names, blocks that do not exist, and effects that members need."""
    seen: dict[str, str] = {}
    solids = [row.get("name") for key in ("blocks", "tessellations") for _, row in rows(data, key)]
    known = [name for name in solids if isinstance(name, str)]
    for key in MEMBERS:
        for path, row in rows(data, key):
            name = row.get("name")
            if isinstance(name, str):
                if name in seen:
                    yield (*path, "name"), f'"{name}"', "a name of its own", f"{seen[name]} has it"
                seen.setdefault(name, f"one of [[{key}]]")
            yield from _blocks(path, row, known)
    if data.get("dashpots") and "inertia" not in data:
        yield ("dashpots",), "no [inertia]", "a dynamic scene", "add [inertia], or remove them"
    if data.get("masses") and not {"inertia", "gravity"} & set(data):
        remedy = "add one of them, or remove the masses"
        yield ("masses",), "neither [gravity] nor [inertia]", "what acts on a mass", remedy
    for path, row in rows(data, "stages"):
        for name in _texts(row.get("members")):
            if name not in seen:
                expected, remedy = "the name of a member", suggestion(name, list(seen))
                yield (*path, "members"), f'"{name}"', expected, remedy


def _blocks(path: Path, row: Tables, known: list[str]) -> Iterator[Finding]:
    named = [("block", row.get("block")), *(("blocks", one) for one in _texts(row.get("blocks")))]
    for key, name in named:
        if not isinstance(name, str) or name == "all" or name.split(".")[0] in known:
            continue
        if key == "blocks" and name == GROUND:
            continue
        wanted = f'the name of a block, or "{GROUND}"' if key == "blocks" else "the name of a block"
        yield (*path, key), f'"{name}"', wanted, suggestion(name, known)


def _texts(value: object) -> list[str]:
    listed = value if isinstance(value, list | tuple) else ()
    return [name for name in listed if isinstance(name, str)]
