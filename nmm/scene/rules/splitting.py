"""Rules of blocks that split: their materials exist, and their pieces can meet."""

from __future__ import annotations

from collections.abc import Iterator

from nmm.scene.rules.unread_tables import Finding, Tables, table, unknown


def splitting_contradictions(data: Tables) -> Iterator[Finding]:
    """Yield materials that do not exist, and what blocks cannot split without."""
    splitting, materials = table(data, "splitting"), list(table(data, "materials"))
    for name in splitting:
        yield from unknown(("splitting", name), name, "the name of a material", materials)
    if splitting and "contact" not in data:
        remedy = "add [contact] and an interface, through which the pieces meet"
        yield ("splitting",), "no [contact]", "a scene with contact", remedy
