"""Rules of what drives a scene: time, growing loads, and paths."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from nmm.scene.lines import Path
from nmm.scene.rules.unread_tables import Finding, Tables, names, rows, table, texts, unknown


def course_contradictions(data: Tables) -> Iterator[Finding]:
    """Yield what the named effects lack, and ways to drive a scene that exclude each other."""
    if "inertia" in data and "duration" not in data and not data.get("stages"):
        yield ("inertia",), "duration missing", "a duration", 'add duration = "1 s" at the top'
    if "contact" in data and not data.get("interfaces"):
        remedy = "add [interfaces.NAME] with friction_angle"
        yield ("contact",), "no interface", "at least one interface", remedy
    if "loading" in data and "inertia" in data:
        remedy = "remove [loading], or [inertia]; in dynamics loads follow their history"
        yield ("loading",), "[loading] with [inertia]", "a static scene", remedy
    if "duration" in data and "inertia" not in data:
        if "loading" in data:
            remedy = "remove duration, or [loading]: over time loads follow their history"
            yield ("duration",), "duration with [loading]", "one of the two", remedy
        yield from two_clocks(data, ("duration",))
    if data.get("initial_velocities") and "inertia" not in data:
        remedy = "add [inertia], or remove [[initial_velocities]]"
        yield ("initial_velocities",), "no [inertia]", "a dynamic scene", remedy
    yield from _scaled_loads(data)
    yield from _control(data)


def two_clocks(data: Tables, duration: Path) -> Iterator[Finding]:
    """Yield a duration of quasi-static time beside a transient field with a clock of its own."""
    for key in ("heat", "seepage", "joint_flow"):
        if table(data, key).get("transient") is True:
            remedy = f"remove it, and let [{key}] have its duration, or add [inertia]"
            yield duration, f"duration with transient [{key}]", "one clock", remedy


def driven(support: Mapping[str, object]) -> bool:
    """Whether a support has a prescribed displacement that is not zero."""
    way = support.get("displacement")
    parts = way if isinstance(way, list | tuple) else ()
    return support.get("field") is not None or any(part not in (0, 0.0) for part in parts)


def _scaled_loads(data: Tables) -> Iterator[Finding]:
    loads = [row for _, row in rows(data, "loads", "water_pressures")]
    loads += [
        row for _, row in rows(data, "supports") if row.get("displacement") or row.get("field")
    ]
    known = [row["name"] for row in loads if isinstance(row.get("name"), str)]
    for name in texts(table(data, "loading"), "scaled"):
        expected = "the name of a load, or of a support with a displacement"
        yield from unknown(("loading", "scaled"), name, expected, known)
    if "loading" in data and not loads:
        remedy = "add [[loads]] or the displacement of a support, or remove [loading]"
        yield ("loading",), "no load", "at least one load to scale", remedy


def _control(data: Tables) -> Iterator[Finding]:
    control, place = table(table(data, "loading"), "control"), ("loading", "control")
    if not control:
        return
    if "contact" not in data:
        remedy = "add [contact], or remove [loading.control]"
        yield place, "no [contact]", "a scene with contact", remedy
    if data.get("stages"):
        remedy = "remove stages, or [loading.control]"
        yield place, "stages besides", "a path without stages", remedy
    named = control.get("monitors", ())
    for number, name in enumerate(named if isinstance(named, list | tuple) else ()):
        at = (*place, "monitors", number)
        yield from unknown(at, name, "the name of a monitor", names(data, "monitors"))
