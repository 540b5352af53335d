"""Consistency rules of ground motion, damping and moving loads.

Works on unvalidated tables as `nmm.scene.consistency` does.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from nmm.scene.faults import suggestion
from nmm.scene.lines import Path
from nmm.scene.unread_rows import Finding, Tables, has_clock, rows

EDGES = ("viscous_boundaries", "free_fields")


def motion_contradictions(data: Tables) -> Iterator[Finding]:
    """Yield records that do not exist, and motion in scenes without time."""
    if "damping" in data and "inertia" not in data:
        yield ("damping",), "no [inertia]", "a dynamic scene", "add [inertia], or remove [damping]"
    yield from _moving_ground(data)
    for path, row in rows(data, "supports"):
        yield from _named_records(data, (*path, "motion"), row.get("motion"))
        if row.get("motion") and "inertia" not in data:
            remedy = "add [inertia], or give displacement with a history"
            yield (*path, "motion"), "no [inertia]", "a dynamic scene", remedy
    for path, row in rows(data, "viscous_boundaries"):
        yield from _named_records(data, (*path, "incoming"), row.get("incoming"))
        if row.get("reactions") is True and not data.get("stages"):
            remedy = "remove it, or add a stage at rest on supports, and one without them"
            yield (*path, "reactions"), "no [[stages]]", "supports that a stage takes away", remedy
    for key in EDGES:
        if data.get(key) and "inertia" not in data:
            yield (key,), "no [inertia]", "a dynamic scene", f"add [inertia], or remove [[{key}]]"
    yield from _bases(data)
    yield from _fields(data)


def _moving_ground(data: Tables) -> Iterator[Finding]:
    """Yield a ground of damping that is no moving support."""
    damping = data.get("damping")
    name = damping.get("ground") if isinstance(damping, Mapping) else None
    moving = [row.get("name") for _, row in rows(data, "supports") if row.get("motion")]
    if isinstance(name, str) and name not in moving:
        known = [one for one in moving if isinstance(one, str)]
        expected = "the name of a support with a motion"
        yield ("damping", "ground"), f'"{name}"', expected, suggestion(name, known)


def _bases(data: Tables) -> Iterator[Finding]:
    """Yield bases of free fields that are neither a boundary nor a moving support."""
    bases = [row.get("name") for _, row in rows(data, "viscous_boundaries")]
    bases += [row.get("name") for _, row in rows(data, "supports") if row.get("motion")]
    for path, row in rows(data, "free_fields"):
        name = row.get("base")
        if isinstance(name, str) and name not in bases:
            expected = "the name of a viscous boundary or of a support with a motion"
            known = [one for one in bases if isinstance(one, str)]
            yield (*path, "base"), f'"{name}"', expected, suggestion(name, known)


def _fields(data: Tables) -> Iterator[Finding]:
    """Yield fields that do not exist, and moving forces without time."""
    known = data.get("fields")
    names = list(known) if isinstance(known, Mapping) else []
    timed = has_clock(data)
    for key in ("loads", "supports"):
        for path, row in rows(data, key):
            name = row.get("field")
            if isinstance(name, str) and name not in names:
                expected = "the name of one of [fields.NAME], or two expressions"
                yield (*path, "field"), f'"{name}"', expected, suggestion(name, names)
            if row.get("kind") == "moving" and not timed:
                remedy = "add a duration, over which it travels at rest, or [inertia]"
                yield (*path, "kind"), '"moving" in a scene without time', "a clock", remedy


def _named_records(data: Tables, path: Path, motion: object) -> Iterator[Finding]:
    known = data.get("records")
    names = list(known) if isinstance(known, Mapping) else []
    for axis, name in motion.items() if isinstance(motion, Mapping) else ():
        if isinstance(name, str) and name not in names:
            expected = "the name of one of [records.NAME]"
            yield (*path, axis), f'"{name}"', expected, suggestion(name, names)
