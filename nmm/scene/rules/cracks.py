"""Rules of crack growth: what grows, in time or under loads, and what one factor scales."""

from __future__ import annotations

from collections.abc import Iterator

from nmm.scene.rules.course import driven
from nmm.scene.rules.unread_tables import Finding, Tables, rows, table

# Keys of dynamic growth alone.
IN_TIME = ("speed", "branching")
# Tables beside which intensities may not be affine in one load factor.
NOT_SCALED = ("contact", "heat", "inertia", "initial_stresses", "seepage", "stages")


def fracture_contradictions(data: Tables) -> Iterator[Finding]:
    """Yield what ``[fracture]`` lacks and is incompatible with."""
    if data.get("fracture") is None:
        return
    fracture = table(data, "fracture")
    if not data.get("cracks") and not fracture.get("nucleation"):
        remedy = "add the cracks that are there from the start, or [fracture.nucleation]"
        yield ("fracture",), "no [[cracks]]", "a crack that can grow", remedy
    for key in IN_TIME if "inertia" not in data else ():
        if fracture.get(key):
            remedy = "add [inertia], or remove it"
            yield ("fracture", key), f'"{fracture[key]}"', "a scene with [inertia]", remedy
    if fracture.get("branching_length") and not fracture.get("branching"):
        remedy = "add branching, the angle of branches, or remove it"
        yield ("fracture", "branching_length"), "no branching", "tips that divide", remedy
    begins = table(fracture, "nucleation")
    for key in ("length", "crack_length") if begins.get("criterion") == "coupled" else ():
        if key in begins:
            value, expected = f'{key} with criterion = "coupled"', "lengths that energy finds"
            yield ("fracture", "nucleation", key), value, expected, f"remove {key}"
    if fracture.get("control") == "toughness":
        yield from _control(data)


def _control(data: Tables) -> Iterator[Finding]:
    path, expected = ("fracture", "control"), "loads that one factor scales"
    for key in NOT_SCALED:
        if data.get(key) not in (None, (), []):
            remedy = f'use control = "loads", or remove [{key}]'
            yield path, f'"toughness" with [{key}]', expected, remedy
    alone = "loading" in data and not data.get("loads")
    for _, row in rows(data, "supports"):
        if driven(row) and not (alone and row.get("history") is None):
            which = f"the displacement of {row.get('name')!r}, which is there in full"
            remedy = "add [loading], without [[loads]] and history beside it, or drive by loads"
            yield path, f'"toughness" with {which}', expected, remedy
