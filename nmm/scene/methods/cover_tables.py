"""The tables of ``[cover]``: type and size of covers, and their local functions."""

from __future__ import annotations

from typing import Literal

from pydantic import Field, model_validator

from nmm.scene.fields import (
    Angle,
    BlockName,
    Count,
    Flag,
    Frozen,
    Length,
    Number,
    Options,
    PartName,
    Point,
    Ring,
    fault,
)

OWN = 'or "module:Name"'


class PartTable(Frozen):
    """Base of tables of exchangeable parts; `options` is checked by the part itself."""

    options: Options = Field(default={}, description="a table of options of the part")


class EnrichmentTable(Frozen):
    """Singular functions on the covers about all crack tips, and about corners that are named.

    Without the table the covers that touch a tip carry its functions.
    """

    radius: Length = Field(
        default=0.0,
        ge=0,
        description="a radius in m, >= 0: covers that are nearer to the point carry the functions; "
        "those that touch it always do",
        examples=[0.2],
    )
    tips: Flag = Field(
        default=True,
        description="true or false: whether covers about crack tips carry the functions",
        examples=[False],
    )
    corners: tuple[Point, ...] = Field(
        default=(), description="a list of re-entrant corners [x, y] in m", examples=[[[0, 0]]]
    )


class CoverRegion(Frozen):
    """Covers of another degree: those in a polygon, of a block, or near a point.

    A cover belongs to the place where the centroid of its material lies; of several regions that
    hold it the last one counts.
    """

    degree: Count = Field(ge=0, le=3, description="a degree, 0 to 3", examples=[2])
    polygon: Ring | None = Field(
        default=None,
        description="a list of three corners [x, y] in m or more",
        examples=[[[0, 0], [1, 0], [1, 1]]],
    )
    block: BlockName | None = Field(
        default=None, description='the name of a block, or of a piece "beam.12"', examples=["beam"]
    )
    point: Point | None = Field(
        default=None, description="a point [x, y] in m, with a radius", examples=[[0.5, 0]]
    )
    radius: Length | None = Field(
        default=None, gt=0, description="a distance to the point in m, > 0", examples=[0.2]
    )

    @model_validator(mode="after")
    def _one_place(self) -> CoverRegion:
        given = [name for name in ("polygon", "block", "point") if getattr(self, name) is not None]
        if len(given) != 1:
            raise fault(
                ", ".join(given) or "none",
                "one of polygon, block, point",
                "name one place a region; write a region for each further place",
            )
        if (self.point is None) != (self.radius is None):
            raise fault(
                f"point {self.point}, radius {self.radius}",
                "a point with a radius",
                "write both, or neither",
            )
        return self


class CoverNet(Frozen):
    """A net of its own for a block; what is not given is that of the common net."""

    block: BlockName = Field(description="the name of a block", examples=["beam"])
    size: Length | None = Field(
        default=None, gt=0, description="a cover size in m, > 0", examples=[0.02]
    )
    angle: Angle | None = Field(
        default=None, description="a turn of the mesh in rad", examples=["17 deg"]
    )
    shift: tuple[Number, Number] | None = Field(
        default=None,
        description="a displacement of the mesh in fractions of a cell",
        examples=[[0.3, 0.2]],
    )


class CoverTable(PartTable):
    """Physical covers and their local functions: block = DDA, meshes = manifold.

    The type "sub_blocks" divides blocks and glues the parts.

    A mesh has local functions "monomials" of degree 1 unless others are named, blocks
    "rigid_strain".
    """

    type: PartName = Field(
        default="block",
        description='"block", "sub_blocks", "triangles", "quads", "graded", "bspline", "mls" '
        f"{OWN} of a cover",
        examples=["triangles"],
    )
    functions: PartName | None = Field(
        default=None,
        description=f'"rigid_strain", "rigid", "monomials" {OWN}; without it those of the type',
        examples=["monomials"],
    )
    degree: Count | None = Field(
        default=None, ge=0, description="a degree, an integer >= 0", examples=[1]
    )
    size: Length | None = Field(
        default=None, gt=0, description="a cover size in m, > 0", examples=[0.1]
    )
    angle: Angle = Field(default=0.0, description="a turn of the mesh in rad", examples=["17 deg"])
    shift: tuple[Number, Number] = Field(
        default=(0.0, 0.0),
        description="a displacement of the mesh in fractions of a cell",
        examples=[[0.3, 0.2]],
    )
    volumetric: Literal["full", "projected"] = Field(
        default="full",
        description='"full" or "projected": whether changes of volume are resisted in every point, '
        "or by pressures of one degree less than the strains, which do not lock near a Poisson "
        "ratio of 1/2",
        examples=["projected"],
    )
    enrichment: EnrichmentTable | None = Field(
        default=None, description="a table [cover.enrichment]"
    )
    regions: tuple[CoverRegion, ...] | None = Field(
        default=None, description="tables [[cover.regions]]"
    )
    nets: tuple[CoverNet, ...] | None = Field(default=None, description="tables [[cover.nets]]")

    @property
    def finest(self) -> float | None:
        """Smallest size of a mesh (m)."""
        sizes = [self.size, *(item.size for item in self.nets or ())]
        return min((size for size in sizes if size is not None), default=None)
