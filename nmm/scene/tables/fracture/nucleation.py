"""The table ``[fracture.nucleation]``: strength, length of the mean, and size of nuclei."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from nmm.scene.fields import Count, Frozen, Length, Stress


class NucleationTable(Frozen):
    """Cracks begin at edges and inside where the mean stress along a line reaches the strength.

    The line runs from an edge inwards, or both ways from a place inside, normal to the largest
    principal stress of the mean; the stress where it begins must have reached the strength too. The
    crack is laid along it. By the coupled criterion lines of all lengths are asked, and a crack
    must free what its faces take by the toughness, too.
    """

    criterion: Literal["strength", "coupled"] = Field(
        default="strength",
        description='"strength" or "coupled": the mean reaches the strength over one length, or '
        "over a length at which a crack frees what its faces take, too, and which it then has",
        examples=["coupled"],
    )

    tensile_strength: Stress = Field(
        gt=0, description="a tensile strength in Pa, > 0", examples=["3 MPa"]
    )
    length: Length | None = Field(
        default=None,
        gt=0,
        description="a length in m, > 0, along which stress is averaged, from an edge, and both "
        "ways inside; 2 (K_Ic / f_t)^2 / pi if not given",
        examples=["15 mm"],
    )
    crack_length: Length | None = Field(
        default=None,
        gt=0,
        description="the length in m, > 0, of a crack that begins, from an edge, and both ways "
        "inside; that of the mean if not given",
        examples=["20 mm"],
    )
    stress: Literal["effective", "total"] = Field(
        default="effective",
        description='"effective" or "total": whether the pressure of water in the pores helps to '
        "open cracks, as in stone (Terzaghi), or the stress of grains and water together does",
        examples=["total"],
    )
    number: Count | None = Field(
        default=None, ge=1, description="how many cracks may begin, >= 1", examples=[1]
    )
