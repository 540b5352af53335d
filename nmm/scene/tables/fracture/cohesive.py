"""The table ``[cohesive_zones]``, and its consistency rules."""

from __future__ import annotations

from collections.abc import Iterator

from pydantic import Field

from nmm.scene.fields import Flag, Frozen, Length, Number
from nmm.scene.tables.fracture.bond_rules import has_bond
from nmm.scene.unread_rows import Finding, Tables


class CohesiveZonesTable(Frozen):
    """Cohesive zones grow from the tips of cracks, and begin where the strength is reached.

    Where the largest principal stress ahead of a tip, its mean over a length, reaches a part of the
    tensile strength of the interface of the material with itself, bonded faces are laid normal to
    it. They open as the law of that interface says; no tip carries singular functions. A piece
    that would meet the boundary, a hole or another crack, or end less than a quarter of its length
    short of it, ends there.
    """

    increment: Length = Field(
        gt=0, description="the length of a new piece in m, > 0", examples=["10 mm"]
    )
    length: Length | None = Field(
        default=None,
        gt=0,
        description="a length in m, > 0, over which stress is averaged: the standard deviation of "
        "the weights; that of a piece if not given",
        examples=["15 mm"],
    )
    ahead: Number = Field(
        default=0.3,
        gt=0,
        le=1,
        description="a part of the tensile strength in (0, 1] at which faces are laid normal to "
        "the stress",
        examples=[0.5],
    )
    nucleation: Flag = Field(
        default=False,
        description="true or false: whether zones begin where the mean stress reaches the strength "
        "away from all cracks",
        examples=[True],
    )
    max_growth: Length | None = Field(
        default=None,
        gt=0,
        description="a length in m, > 0, at which a zone stops",
        examples=["200 mm"],
    )


# Tables that are incompatible with cohesive zones.
BESIDE = ("fracture", "splitting", "heat", "initial_stresses")


def cohesive_contradictions(data: Tables) -> Iterator[Finding]:
    """Yield what ``[cohesive_zones]`` lacks and is incompatible with, on unvalidated tables."""
    table = data.get("cohesive_zones")
    if table is None:
        return
    path = ("cohesive_zones",)
    if "contact" not in data:
        yield path, "no [contact]", "a scene with contact", "add [contact]"
    elif not has_bond(data):
        remedy = "add bonded = true and tensile_strength to an interface"
        yield path, "no interface that is bonded", "a strength", remedy
    begins = isinstance(table, dict) and table.get("nucleation") is True
    if not data.get("cracks") and not begins:
        remedy = "add the cracks that are there from the start, or nucleation = true"
        yield path, "no [[cracks]]", "where zones begin", remedy
    for key in BESIDE:
        if data.get(key):
            yield path, f"[{key}]", f"a scene without {key}", "remove one of the two"
