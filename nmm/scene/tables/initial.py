"""Tables of the initial state of blocks: velocity and stress."""

from __future__ import annotations

from pydantic import Field, model_validator

from nmm.scene.actions import given
from nmm.scene.fields import (
    AngularVelocity,
    BlockName,
    Coordinate,
    ForceDensity,
    Frozen,
    Number,
    Stress,
    Velocity,
    fault,
)


class InitialVelocityTable(Frozen):
    """Velocity of blocks at the start, or as the first stage with a duration sets them in motion.

    A block spins about its own centroid, with all pieces into which cracks part it; pieces of a
    tessellation, or of a block that joints cut, are blocks.
    """

    block: BlockName = Field(description='the name of a block, or "all"', examples=["all"])
    velocity: tuple[Velocity, Velocity] = Field(
        default=(0.0, 0.0), description="a velocity [vx, vy] in m/s", examples=[[3, 4]]
    )
    angular_velocity: AngularVelocity = Field(
        default=0.0, description="an angular velocity in rad/s", examples=[2.0]
    )


class InitialStressTable(Frozen):
    """Stress in blocks at the start: one `stress`, or one that grows with depth.

    Depth is that below `surface`. The vertical stress there is a pressure of `unit_weight` times
    it, and of the `surcharge`; the horizontal one is `ratio` times the vertical one.
    """

    block: BlockName = Field(description='the name of a block, or "all"', examples=["all"])
    stress: tuple[Stress, Stress, Stress] | None = Field(
        default=None, description="stresses [sxx, syy, sxy] in Pa", examples=[[0, "-1 MPa", 0]]
    )
    across: Stress | None = Field(
        default=None,
        description="a stress out of the plane in Pa, of matter that flows; elastic if not given",
        examples=["-1 MPa"],
    )
    surface: Coordinate | None = Field(
        default=None, description="y of the ground's surface in m", examples=["30 m"]
    )
    unit_weight: ForceDensity | None = Field(
        default=None,
        gt=0,
        description="a weight of the ground in N/m3, > 0",
        examples=["25 kN/m^3"],
    )
    surcharge: Stress = Field(
        default=0.0, ge=0, description="a pressure on the surface in Pa, >= 0", examples=["50 kPa"]
    )
    ratio: Number | None = Field(
        default=None, description="of horizontal to vertical stress", examples=[0.5]
    )
    ratio_across: Number | None = Field(
        default=None,
        description="of the stress out of the plane to the vertical one; elastic if not given",
        examples=[0.5],
    )

    @model_validator(mode="after")
    def _one_way(self) -> InitialStressTable:
        needed = ("surface", "unit_weight", "ratio")
        depth = [key for key in (*needed, "ratio_across") if getattr(self, key) is not None]
        depth += ["surcharge"] if self.surcharge else []
        even = given(self, "stress", "across")
        if even and depth:
            remedy = f"remove {' and '.join(depth)}, or stress and across"
            raise fault(f"{even[0]} and {depth[0]}", "one stress, or one by depth", remedy)
        if not depth and self.stress is None:
            raise fault(even[0] if even else "no stress", "stress, or surface", "add stress")
        if depth and (missing := [key for key in needed if key not in depth]):
            said, expected = f"no {' and no '.join(missing)}", ", ".join(needed)
            raise fault(said, f"{expected} together", f"add {' and '.join(missing)}")
        return self
