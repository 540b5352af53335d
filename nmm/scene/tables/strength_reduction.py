"""The table ``[strength_reduction]``: the factor of safety by division of strengths."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from pydantic import Field, model_validator

from nmm.scene.fields import Frozen, Number, fault
from nmm.scene.lines import Path
from nmm.scene.unread_rows import Finding, rows

# Tables that are incompatible with runs under reduced strengths.
OTHERS = ("inertia", "duration", "loading", "fracture")
# The same for tables of several entries.
SEVERAL = ("splitting",)
STRENGTHS = ("cohesion", "friction_angle", "tensile_strength", "yield_stress")


class StrengthReductionTable(Frozen):
    """Finds the factor of safety, by which strengths are divided until there is no equilibrium.

    Cohesion, the tangents of friction angles, tensile strengths and yield stresses of all materials
    and interfaces are divided. A factor holds where the scene finds equilibrium under all its
    loads, and fails where it finds none. The answer is bracketed: the largest factor that holds and
    the smallest that fails. With stages a factor holds where all of them find equilibrium.
    """

    lowest: Number = Field(
        default=0.1, gt=0, description="a factor > 0 below which is not sought", examples=[0.5]
    )
    highest: Number = Field(
        default=10.0, gt=0, description="a factor above which is not sought", examples=[4.0]
    )
    tolerance: Number = Field(
        default=0.01, gt=0, description="a width of the bracket, > 0", examples=[0.01]
    )

    @model_validator(mode="after")
    def _check(self) -> StrengthReductionTable:
        if not self.lowest < self.highest:
            remedy = "raise highest, or lower lowest"
            raise fault(f"lowest = {self.lowest:g}", f"less than {self.highest:g}", remedy)
        return self


def reduction_contradictions(data: Mapping[str, Any]) -> Iterator[Finding]:
    """Yield what a scene with ``[strength_reduction]`` lacks and is incompatible with."""
    if "strength_reduction" not in data:
        return
    place: Path = ("strength_reduction",)
    named = [key for key in OTHERS if data.get(key) is not None]
    for key in [*named, *(key for key in SEVERAL if data.get(key))]:
        remedy = f"remove {key}, or [strength_reduction]"
        yield place, f"[strength_reduction] with {key}", "statics under full load", remedy
    for number, row in rows(data, "stages"):
        if "duration" in row:
            found = f"[strength_reduction] with duration = {row['duration']}"
            yield (*number, "duration"), found, "stages that come to rest", "remove one of them"
    tables = [data.get(key) for key in ("materials", "interfaces")]
    parts = [part for one in tables if isinstance(one, Mapping) for part in one.values()]
    if not any(
        isinstance(part, Mapping) and any(key in part for key in STRENGTHS) for part in parts
    ):
        remedy = "give a material a law with strength, or add [interfaces.NAME]"
        yield place, "nothing has strength", "strength to be reduced", remedy
