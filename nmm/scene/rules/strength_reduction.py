"""Rules of ``[strength_reduction]``: statics under full load, and strengths to be divided."""

from __future__ import annotations

from collections.abc import Iterator

from nmm.scene.lines import Path
from nmm.scene.rules.unread_tables import Finding, Tables, named, rows

# Tables that are incompatible with runs under reduced strengths.
OTHERS = ("inertia", "duration", "loading", "fracture")
# The same for tables of several entries.
SEVERAL = ("splitting",)
STRENGTHS = ("cohesion", "friction_angle", "tensile_strength", "yield_stress")


def reduction_contradictions(data: Tables) -> Iterator[Finding]:
    """Yield what a scene with ``[strength_reduction]`` lacks and is incompatible with."""
    if "strength_reduction" not in data:
        return
    place: Path = ("strength_reduction",)
    beside = [key for key in OTHERS if data.get(key) is not None]
    for key in [*beside, *(key for key in SEVERAL if data.get(key))]:
        remedy = f"remove {key}, or [strength_reduction]"
        yield place, f"[strength_reduction] with {key}", "statics under full load", remedy
    for number, row in rows(data, "stages"):
        if "duration" in row:
            found = f"[strength_reduction] with duration = {row['duration']}"
            yield (*number, "duration"), found, "stages that come to rest", "remove one of them"
    parts = [row for key in ("materials", "interfaces") for _, row in named(data, key)]
    if not any(key in part for part in parts for key in STRENGTHS):
        remedy = "give a material a law with strength, or add [interfaces.NAME]"
        yield place, "nothing has strength", "strength to be reduced", remedy
