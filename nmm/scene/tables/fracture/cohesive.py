"""The table ``[cohesive_zones]``: length, strength ahead and beginning of zones."""

from __future__ import annotations

from pydantic import Field

from nmm.scene.fields import Flag, Frozen, Length, Number


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
