"""Tables of interfaces: laws and constants of joints and contacts between materials."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BeforeValidator, Field, model_validator

from nmm.errors import shown
from nmm.scene.fields import (
    Flag,
    FrictionAngle,
    Frozen,
    InUnit,
    Length,
    Number,
    Options,
    PartName,
    SpringStiffness,
    Stress,
    SurfaceEnergy,
    example,
    fault,
    quantity,
)


def _passage(unit: str) -> InUnit:
    """Return a validator of conductances: a number in ``unit``, or "perfect"."""
    read = quantity(unit).func

    def checked(value: object) -> object:
        found = value if value == "perfect" else read(value)  # type: ignore[call-arg]
        if found == "perfect" or (isinstance(found, float) and found > 0):
            return found
        expected = f'a conductance in {unit}, > 0, or "perfect"'
        raise fault(value, expected, f'write for example "100 {unit}"')

    return InUnit(checked, unit=unit)


Conductance = Annotated[float | Literal["perfect"], _passage("W/m^2/K")]
Leakage = Annotated[float | Literal["perfect"], _passage("1/s")]


def _pair(value: object) -> object:
    if value == "any" or (isinstance(value, list | tuple) and len(value) == 2):
        return value
    raise fault(
        shown(value), 'two materials or "any"', 'write for example between = ["rock", "rock"]'
    )


class InterfaceTable(Frozen):
    """Law and constants of the joints and contacts between two materials."""

    law: PartName = Field(
        default="mohr_coulomb",
        description='"mohr_coulomb", "linear_softening", "bilinear_softening", '
        '"exponential_softening" or "module:Name"',
    )
    between: Annotated[tuple[str, str] | Literal["any"], BeforeValidator(_pair)] = Field(
        default="any", description='two materials or "any"', examples=[["rock", "rock"]]
    )
    friction_angle: FrictionAngle = Field(
        description="a friction angle in [0, pi/2) rad", examples=example("rad")
    )
    cohesion: Stress = Field(
        default=0.0, ge=0, description="a cohesion in Pa, >= 0", examples=["4.7 MPa"]
    )
    tensile_strength: Stress = Field(
        default=0.0, ge=0, description="a tensile strength in Pa, >= 0", examples=["2.9 MPa"]
    )
    bonded: Flag = Field(
        default=False,
        description="true or false: whether strength acts until the joint fails for the first time",
        examples=[True],
    )
    normal_stiffness: SpringStiffness | None = Field(
        default=None, gt=0, description="a normal stiffness in Pa/m, > 0", examples=example("Pa/m")
    )
    shear_stiffness: SpringStiffness | None = Field(
        default=None, gt=0, description="a shear stiffness in Pa/m, > 0", examples=example("Pa/m")
    )
    fracture_energy: SurfaceEnergy | None = Field(
        default=None, gt=0, description="a fracture energy in J/m2, > 0", examples=example("J/m^2")
    )
    shear_fracture_energy: SurfaceEnergy | None = Field(
        default=None,
        gt=0,
        description="a fracture energy of sliding in J/m2, > 0; that of opening if not given",
        examples=example("J/m^2"),
    )
    residual_friction_angle: FrictionAngle | None = Field(
        default=None,
        description="a friction angle of broken bonds in [0, pi/2) rad",
        examples=example("rad"),
    )
    dilation_angle: FrictionAngle | None = Field(
        default=None, description="a dilation angle in [0, pi/2) rad", examples=example("rad")
    )
    dilation_slip: Length | None = Field(
        default=None,
        gt=0,
        description="a slip in m, > 0, after which dilation ends",
        examples=["5 mm"],
    )
    damping: Number | None = Field(
        default=None,
        ge=0,
        description="a damping ratio of closed contacts, >= 0",
        examples=[0.1],
    )
    restitution: Number | None = Field(
        default=None,
        gt=0,
        le=1,
        description="a coefficient of restitution in (0, 1], in place of damping",
        examples=[0.5],
    )
    conductance: Conductance | None = Field(
        default=None,
        description='a thermal conductance of the faces in W/(m2 K), > 0, or "perfect" '
        "for equal temperatures; edges that blocks share insulate if not given",
        examples=["100 W/m^2/K"],
    )
    aperture: Length | None = Field(
        default=None,
        ge=0,
        description="an initial aperture of the joint in m, >= 0, through which water flows",
        examples=["0.2 mm"],
    )
    residual_aperture: Length | None = Field(
        default=None,
        ge=0,
        description="the residual aperture of the closed joint in m, >= 0; 0 if not given",
        examples=["0.02 mm"],
    )
    leakage: Leakage | None = Field(
        default=None,
        description="a velocity of seepage for each metre of head across it in 1/s, > 0, or "
        '"perfect" where the head is one; edges that blocks share are tight if not given',
        examples=["perfect"],
    )
    options: Options = Field(default={}, description="a table of options of a law of one's own")

    @model_validator(mode="after")
    def _check(self) -> InterfaceTable:
        if self.tensile_strength > 0 and not self.bonded:
            remedy = "add bonded = true, or leave tensile_strength out"
            raise fault("tensile_strength > 0, bonded = false", "a bonded interface", remedy)
        if self.restitution is not None and self.damping is not None:
            raise fault("damping and restitution", "one of them", "leave the other out")
        if self.dilation_slip is not None and self.dilation_angle is None:
            remedy = "add dilation_angle, or leave dilation_slip out"
            raise fault("dilation_slip without dilation_angle", "an angle that it ends", remedy)
        residual, drawn = self.residual_aperture, self.aperture
        if residual is not None and drawn is not None and residual > drawn:
            value = f"residual_aperture = {residual:g} m, aperture = {drawn:g} m"
            raise fault(value, "what closing leaves of the aperture", "lower it, or raise aperture")
        # Sliding by s under N, friction takes N s tan(phi), and dilation gives back N s tan(psi).
        broken = self.residual_friction_angle
        friction = self.friction_angle if broken is None else min(self.friction_angle, broken)
        if self.dilation_angle is not None and self.dilation_angle > friction:
            expected = (
                f"at most the friction angle, {friction:.6g} rad: beyond it sliding gives energy"
            )
            value = f"dilation_angle = {self.dilation_angle:.6g} rad"
            raise fault(value, expected, "lower it, or raise friction")
        return self
