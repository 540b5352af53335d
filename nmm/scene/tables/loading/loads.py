"""Tables of loads: at points, along edges, on volume, follower pressures, moving forces."""

from __future__ import annotations

from typing import Literal, NamedTuple

from pydantic import Field, model_validator

from nmm.scene.actions import PlacedTable, given
from nmm.scene.fields import Force, ForceDensity, Length, Stress, Time, Velocity, fault
from nmm.scene.tables.loading.expressions import FieldOf


class _Kind(NamedTuple):
    """The magnitudes and the places of a kind of load, one of each."""

    magnitudes: tuple[str, ...]
    places: tuple[tuple[str, ...], ...]


_LOADS = {
    "point": _Kind(("force",), (("point",),)),
    "edge": _Kind(("traction", "field"), (("segment",),)),
    "body": _Kind(("density", "field"), ((),)),
    "pressure": _Kind(("pressure",), (("segment",), ())),
    "moving": _Kind(("force",), (("segment",),)),
}
_MAGNITUDES = ("force", "traction", "density", "pressure", "field")


class LoadTable(PlacedTable):
    """A force at a point, a traction on a segment of the boundary, or a force on volume.

    Forces and tractions keep their direction while blocks turn; a "pressure" turns with the
    surface that it acts on, a segment or the whole boundary of a block, and grows with it. A
    "moving" force travels along the segment, from its first point to its second, with `speed`;
    without inertia it passes in equilibrium, over the `duration` of the scene or of a stage.
    A `field` gives the traction (Pa) or the force on volume (N/m3) by expressions of the place
    x, y (m) in the drawn state and the time t (s; in statics the load factor), or by a table.
    """

    kind: Literal["point", "edge", "body", "pressure", "moving"] = Field(
        description='"point", "edge", "body", "pressure" or "moving"', examples=["edge"]
    )
    force: tuple[Force, Force] | None = Field(
        default=None, description="a force [fx, fy] in N", examples=[[0, "-10 kN"]]
    )
    traction: tuple[Stress, Stress] | None = Field(
        default=None, description="a traction [tx, ty] in Pa", examples=[[0, "-1 MPa"]]
    )
    density: tuple[ForceDensity, ForceDensity] | None = Field(
        default=None, description="a force on volume [bx, by] in N/m3", examples=[[0, "-25 kN/m^3"]]
    )
    field: FieldOf | None = Field(
        default=None,
        description="two expressions of x, y, t in place of traction or density, in SI units, or "
        "a name of [fields]",
        examples=[["-9.81e3*(10 - y)", "0"]],
    )
    pressure: Stress | None = Field(
        default=None,
        description="a pressure in Pa that pushes on the surface when it is > 0",
        examples=["1 MPa"],
    )
    speed: Velocity | None = Field(
        default=None, gt=0, description="a speed in m/s, > 0", examples=["20 m/s"]
    )
    start: Time = Field(
        default=0.0, description="the time in s at which a moving force sets out", examples=["1 s"]
    )
    spread: Length = Field(
        default=0.0,
        ge=0,
        description="a length in m behind the front over which a moving force is even, >= 0",
        examples=["0.5 m"],
    )

    @model_validator(mode="after")
    def _check(self) -> LoadTable:
        kind = _LOADS[self.kind]
        found, wanted = given(self, *_MAGNITUDES), " or ".join(kind.magnitudes)
        if len(found) != 1 or found[0] not in kind.magnitudes:
            shown = ", ".join(found) or "no magnitude"
            raise fault(shown, f"{wanted}, as kind is {self.kind}", f"give {wanted} and no other")
        places = tuple(given(self, "point", "segment"))
        if places not in kind.places or (self.kind == "pressure" and not (places or self.block)):
            wanted = " or ".join(one[0] if one else "block" for one in kind.places)
            wanted = wanted.replace("block", "block or no place") if self.kind == "body" else wanted
            shown = ", ".join(places) or "no place"
            raise fault(shown, f"{wanted}, as kind is {self.kind}", f"give {wanted}")
        self._check_motion()
        return self

    def _check_motion(self) -> None:
        moves = self.kind == "moving"
        if moves and self.speed is None:
            raise fault("no speed", "a speed, as kind is moving", 'add speed = "20 m/s"')
        if not moves and (self.speed is not None or self.start or self.spread):
            expected = 'kind = "moving" with speed, start or spread'
            raise fault(f"kind is {self.kind}", expected, "remove them, or change the kind")
