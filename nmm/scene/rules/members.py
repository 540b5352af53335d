"""Rules of members: names among all of them, the blocks of their ends, and what acts on them."""

from __future__ import annotations

from collections.abc import Iterator

from nmm.scene.rules.unread_tables import (
    SOLIDS,
    Finding,
    Tables,
    names,
    rows,
    texts,
    unknown,
    unknown_block,
)
from nmm.scene.tables.members import GROUND, MEMBERS


def member_contradictions(data: Tables) -> Iterator[Finding]:
    """Yield repeated names, blocks that do not exist, and effects that members need."""
    seen: dict[str, str] = {}
    blocks = names(data, *SOLIDS)
    for path, row in rows(data, *MEMBERS):
        name = row.get("name")
        if isinstance(name, str):
            if name in seen:
                yield (*path, "name"), f'"{name}"', "a name of its own", f"{seen[name]} has it"
            seen.setdefault(name, f"one of [[{path[0]}]]")
        yield from unknown_block((*path, "block"), row.get("block"), blocks)
        for end in texts(row, "blocks"):
            yield from unknown_block((*path, "blocks"), end, blocks, ("all", GROUND))
    if data.get("dashpots") and "inertia" not in data:
        yield ("dashpots",), "no [inertia]", "a dynamic scene", "add [inertia], or remove them"
    if data.get("masses") and not {"inertia", "gravity"} & set(data):
        remedy = "add one of them, or remove the masses"
        yield ("masses",), "neither [gravity] nor [inertia]", "what acts on a mass", remedy
    for path, row in rows(data, "stages"):
        for name in texts(row, "members"):
            yield from unknown((*path, "members"), name, "the name of a member", list(seen))
