"""Tables of the blocks of a scene: by corners, by tessellation, cut by joints and cracks."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, model_validator

from nmm.scene.fields import (
    NAME,
    Angle,
    BlockName,
    Count,
    Flag,
    Frozen,
    Length,
    Name,
    Number,
    Point,
    Ring,
    example,
    fault,
)
from nmm.scene.matter.interfaces import Conductance, Leakage


class Block(Frozen):
    """One block given by its corners.

    Blocks may overlap by a millionth of the area of the smaller one, as rounded corners do, without
    a force or energy from it; more is refused.
    """

    name: Name | None = Field(default=None, description=NAME, examples=["base"])
    material: str = Field(description="the name of a material", examples=["rock"])
    vertices: Ring = Field(
        description="three or more points [x, y] in m", examples=[[[0, 0], [1, 0], [1, 1]]]
    )
    holes: tuple[Ring, ...] = Field(default=(), description="a list of rings of points [x, y] in m")


class Crack(Frozen):
    """A crack that is there from the start: a polyline that may end inside blocks.

    Faces that are bonded hold together until the law of the interface of the material with itself
    lets them go: a plane on which a cohesive zone may open.
    """

    name: Name = Field(description=NAME, examples=["notch"])
    points: Annotated[tuple[Point, ...], Field(min_length=2)] = Field(
        description="two or more points [x, y] in m", examples=[[[0, 0], [0.5, 0]]]
    )
    bonded: Flag = Field(
        default=False,
        description="true or false: whether its faces hold together by the bond of the interface "
        "of the material with itself",
        examples=[True],
    )
    conductance: Conductance | None = Field(
        default=None,
        description='a heat flux for each kelvin between the faces in W/(m2 K), > 0, or "perfect"; '
        "it insulates if not given",
        examples=["100 W/m^2/K"],
    )
    leakage: Leakage | None = Field(
        default=None,
        description="a velocity of seepage for each metre of head across it in 1/s, > 0, or "
        '"perfect"; it is tight if not given',
        examples=["perfect"],
    )


class Tessellation(Frozen):
    """A region filled with Voronoi blocks, named `name.0`, `name.1`, ..."""

    name: Name = Field(description=NAME, examples=["beam"])
    material: str = Field(description="the name of a material", examples=["concrete"])
    region: Ring = Field(
        description="three or more points [x, y] in m", examples=[[[0, 0], [1, 0], [1, 1]]]
    )
    holes: tuple[Ring, ...] = Field(default=(), description="a list of rings of points [x, y] in m")
    blocks: Count = Field(gt=0, description="a number of blocks, > 0", examples=[130])
    seed: Count | None = Field(
        default=None, ge=0, description="a seed, an integer >= 0", examples=[1]
    )
    shortest_edge: Number = Field(
        default=0.2,
        ge=0,
        lt=1,
        description="a fraction of the mean edge length in [0, 1)",
        examples=[0.2],
    )
    smoothing: Count = Field(
        default=2, ge=0, le=1000, description="Lloyd iterations, 0 to 1000", examples=[2]
    )
    keep: tuple[Point, ...] = Field(
        default=(), description="a list of points [x, y] in m on the boundary that become vertices"
    )


class JointSet(Frozen):
    """Parallel joints that cut blocks, with normally distributed dip, spacing and trace."""

    name: Name = Field(description=NAME, examples=["bedding"])
    block: BlockName = Field(
        default="all", description='the block to cut, or "all"', examples=["slope"]
    )
    dip: Angle = Field(
        description="the joints' angle from the x axis, counter-clockwise, in rad",
        examples=example("rad"),
    )
    dip_scatter: Angle = Field(
        default=0.0,
        ge=0,
        description="the dip's standard deviation in rad, >= 0",
        examples=["3 deg"],
    )
    spacing: Length = Field(gt=0, description="a mean distance in m, > 0", examples=["0.5 m"])
    spacing_scatter: Length = Field(
        default=0.0,
        ge=0,
        description="the spacing's standard deviation in m, >= 0",
        examples=["5 cm"],
    )
    persistence: Number = Field(
        default=1.0,
        gt=0,
        le=1,
        description="the joined fraction of a trace line in (0, 1]",
        examples=[0.8],
    )
    trace: Length | None = Field(
        default=None, gt=0, description="a mean trace length in m, > 0", examples=["2 m"]
    )
    trace_scatter: Length = Field(
        default=0.0,
        ge=0,
        description="the trace's standard deviation in m, >= 0",
        examples=["0.2 m"],
    )
    origin: Point | None = Field(
        default=None, description="a point [x, y] in m that one joint meets"
    )
    seed: Count | None = Field(
        default=None, ge=0, description="a seed, an integer >= 0", examples=[1]
    )

    @model_validator(mode="after")
    def _check(self) -> JointSet:
        if self.persistence < 1 and self.trace is None:
            raise fault("persistence < 1 without trace", "a trace length", 'add trace = "2 m"')
        if self.persistence == 1 and (self.trace is not None or self.trace_scatter):
            remedy = "add persistence = 0.8, or leave trace and trace_scatter out"
            raise fault("a trace with persistence = 1", "a persistence below 1", remedy)
        return self
