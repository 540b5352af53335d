"""Rules of bonded cracks and cohesive zones, which need contact and a bond."""

from __future__ import annotations

from collections.abc import Iterator

from nmm.scene.rules.unread_tables import Finding, Tables, named, rows, table

# Tables that are incompatible with cohesive zones.
BESIDE = ("fracture", "splitting", "heat", "initial_stresses")

_ADD_BOND = "add bonded = true and tensile_strength to an interface"


def bonded_crack_contradictions(data: Tables) -> Iterator[Finding]:
    """Yield what is missing for cracks whose faces are bonded at first."""
    for path, row in rows(data, "cracks"):
        if row.get("bonded") is not True:
            continue
        place, value = (*path, "bonded"), "bonded = true"
        if "contact" not in data:
            yield place, f"{value} without [contact]", "a scene with contact", "add [contact]"
        elif not has_bond(data):
            yield place, value, "an interface that is bonded", _ADD_BOND


def cohesive_contradictions(data: Tables) -> Iterator[Finding]:
    """Yield what ``[cohesive_zones]`` lacks and is incompatible with."""
    if data.get("cohesive_zones") is None:
        return
    path = ("cohesive_zones",)
    if "contact" not in data:
        yield path, "no [contact]", "a scene with contact", "add [contact]"
    elif not has_bond(data):
        yield path, "no interface that is bonded", "a strength", _ADD_BOND
    begins = table(data, "cohesive_zones").get("nucleation") is True
    if not data.get("cracks") and not begins:
        remedy = "add the cracks that are there from the start, or nucleation = true"
        yield path, "no [[cracks]]", "where zones begin", remedy
    for key in BESIDE:
        if data.get(key):
            yield path, f"[{key}]", f"a scene without {key}", "remove one of the two"


def has_bond(data: Tables) -> bool:
    """Whether any interface is bonded."""
    return any(row.get("bonded") is True for _, row in named(data, "interfaces"))
