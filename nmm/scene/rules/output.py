"""Rules of ``[output]``: times need a clock, events contact, and openings cracks or bonds."""

from __future__ import annotations

from collections.abc import Iterator

from nmm.scene.rules.bonds import has_bond
from nmm.scene.rules.unread_tables import Finding, Tables, has_clock, table, texts

# Tables of cracks that are there, and of what makes some.
CRACKED = ("cracks", "fracture", "cohesive_zones", "splitting")


def output_contradictions(data: Tables) -> Iterator[Finding]:
    """Yield times without a clock, events without contact, and openings of nothing."""
    output, timed = table(data, "output"), has_clock(data)
    moves = timed or "motion_after_failure" in table(data, "loading")
    if "every_time" in output and not moves:
        remedy = "use every_steps, or add [inertia]; growing loads have no time"
        yield ("output", "every_time"), "no [inertia]", "a scene that moves in time", remedy
    if "every_time" in table(output, "checkpoint") and not timed:
        remedy = "use every_steps; growing loads have no time"
        place = ("output", "checkpoint", "every_time")
        yield place, "no [inertia]", "a scene that moves in time", remedy
    if output.get("events") and "contact" not in data:
        remedy = "remove events, or add [contact]"
        yield ("output", "events"), "no [contact]", "a scene with contact", remedy
    if "crack_opening" in texts(output, "quantities") and not _may_open(data):
        remedy = "remove it, or add [[cracks]] or an interface with bonded = true"
        value = '"crack_opening" without cracks or bonds'
        yield ("output", "quantities"), value, "what may open", remedy


def _may_open(data: Tables) -> bool:
    """Whether a scene has cracks, may come to have some, or has bonds that break."""
    return any(data.get(key) for key in CRACKED) or has_bond(data)
