"""Rules of ``[output]``: times need a clock, and events of contact need contact."""

from __future__ import annotations

from collections.abc import Iterator

from nmm.scene.rules.unread_tables import Finding, Tables, has_clock, table


def output_contradictions(data: Tables) -> Iterator[Finding]:
    """Yield times of frames and checkpoints without a clock, and events without contact."""
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
