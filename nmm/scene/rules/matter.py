"""Rules of materials: the plane that their constants allow, and densities where mass counts."""

from __future__ import annotations

from collections.abc import Iterator

from nmm.scene.rules.unread_tables import SOLIDS, Finding, Tables, named, rows, table


def matter_contradictions(data: Tables) -> Iterator[Finding]:
    """Yield constants that the plane of the scene excludes, and densities that are missing."""
    for name, row in named(data, "materials"):
        if data.get("plane") == "strain" and row.get("poisson_ratio") == 0.5:
            remedy = "plane strain has no stiffness matrix at 0.5; use for example 0.4999"
            path = ("materials", name, "poisson_ratio")
            yield path, "0.5", "less than 0.5 in plane strain", remedy
        if data.get("plane") == "stress" and "softening_energy" in row:
            path = ("materials", name, "softening_energy")
            yield path, f"{row['softening_energy']} in plane stress", "plane strain", "remove it"
    yield from _densities(data)


def _densities(data: Tables) -> Iterator[Finding]:
    needs = [f"[{key}]" for key in ("gravity", "inertia") if key in data]
    needs += ["motion_after_failure"] if "motion_after_failure" in table(data, "loading") else []
    used = [row.get("material") for _, row in rows(data, *SOLIDS)]
    for name, row in named(data, "materials"):
        if needs and name in used and "density" not in row:
            expected = f"a density in kg/m3, as {needs[0]} is named"
            remedy = 'add for example density = "2400 kg/m^3"'
            yield ("materials", name), "density missing", expected, remedy
