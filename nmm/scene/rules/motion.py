"""Rules of ground motion, damping, absorbing boundaries and moving loads."""

from __future__ import annotations

from collections.abc import Iterator

from nmm.scene.rules.unread_tables import Finding, Tables, has_clock, names, rows, table, unknown

EDGES = ("viscous_boundaries", "free_fields")


def motion_contradictions(data: Tables) -> Iterator[Finding]:
    """Yield records, bases and fields that do not exist, and motion in scenes without time."""
    if "damping" in data and "inertia" not in data:
        yield ("damping",), "no [inertia]", "a dynamic scene", "add [inertia], or remove [damping]"
    for path, row in rows(data, "supports"):
        if row.get("motion") and "inertia" not in data:
            remedy = "add [inertia], or give displacement with a history"
            yield (*path, "motion"), "no [inertia]", "a dynamic scene", remedy
    for path, row in rows(data, "viscous_boundaries"):
        if row.get("reactions") is True and not data.get("stages"):
            remedy = "remove it, or add a stage at rest on supports, and one without them"
            yield (*path, "reactions"), "no [[stages]]", "supports that a stage takes away", remedy
    for key in EDGES:
        if data.get(key) and "inertia" not in data:
            yield (key,), "no [inertia]", "a dynamic scene", f"add [inertia], or remove [[{key}]]"
    yield from _grounds(data)
    yield from _records(data)
    yield from _fields(data)


def _grounds(data: Tables) -> Iterator[Finding]:
    """Yield grounds of damping that do not move, and bases of free fields that are none."""
    moving = [
        row["name"]
        for _, row in rows(data, "supports")
        if row.get("motion") and isinstance(row.get("name"), str)
    ]
    ground, expected = table(data, "damping").get("ground"), "the name of a support with a motion"
    yield from unknown(("damping", "ground"), ground, expected, moving)
    bases = [*names(data, "viscous_boundaries"), *moving]
    expected = "the name of a viscous boundary or of a support with a motion"
    for path, row in rows(data, "free_fields"):
        yield from unknown((*path, "base"), row.get("base"), expected, bases)


def _records(data: Tables) -> Iterator[Finding]:
    """Yield records that do not exist."""
    known, expected = list(table(data, "records")), "the name of one of [records.NAME]"
    for key, motion in (("supports", "motion"), ("viscous_boundaries", "incoming")):
        for path, row in rows(data, key):
            for axis, name in table(row, motion).items():
                yield from unknown((*path, motion, axis), name, expected, known)


def _fields(data: Tables) -> Iterator[Finding]:
    """Yield fields that do not exist, and moving forces without time."""
    known, timed = list(table(data, "fields")), has_clock(data)
    for path, row in rows(data, "loads", "supports"):
        expected = "the name of one of [fields.NAME], or two expressions"
        yield from unknown((*path, "field"), row.get("field"), expected, known)
        if row.get("kind") == "moving" and not timed:
            remedy = "add a duration, over which it travels at rest, or [inertia]"
            yield (*path, "kind"), '"moving" in a scene without time', "a clock", remedy
