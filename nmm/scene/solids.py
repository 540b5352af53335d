"""What the scene is made of: materials, interfaces between them, blocks."""

from __future__ import annotations

import math
from typing import Annotated, Literal

from pydantic import AfterValidator, BeforeValidator, Field, model_validator

from nmm.scene.fields import (
    NAME,
    Angle,
    BlockName,
    Count,
    Density,
    Flag,
    Frozen,
    Length,
    Name,
    Number,
    Options,
    PartName,
    Point,
    Ring,
    SpringStiffness,
    Stress,
    SurfaceEnergy,
    example,
    fault,
    quantity,
)


def _friction(value: float) -> float:
    if 0 <= value < math.pi / 2:
        return value
    remedy = 'numbers are radians; write for example friction_angle = "37 deg"'
    raise fault(value, "a friction angle in [0, pi/2) rad", remedy)


class Material(Frozen):
    """Law and constants of the inside of blocks."""

    law: PartName = Field(
        default="elastic",
        description='"elastic", "von_mises", "mohr_coulomb", "drucker_prager", "maxwell", '
        '"kelvin", "standard_solid", "burgers", "orthotropic", or "module:Name" of a law of '
        "one's own",
    )
    density: Density | None = Field(
        default=None, gt=0, description="a density in kg/m3, > 0", examples=example("kg/m^3")
    )
    young_modulus: Stress = Field(
        gt=0, description="Young's modulus in Pa, > 0", examples=example("Pa")
    )
    poisson_ratio: Number = Field(
        gt=-1, le=0.5, description="Poisson's ratio in (-1, 0.5]", examples=[0.2]
    )
    yield_stress: Stress | None = Field(
        default=None,
        gt=0,
        description='a yield stress in uniaxial tension in Pa, > 0, of "von_mises"',
        examples=["250 MPa"],
    )
    hardening_modulus: Stress | None = Field(
        default=None,
        ge=0,
        description="a slope of stress over plastic strain in Pa, >= 0; none is perfectly plastic",
        examples=["2 GPa"],
    )
    cohesion: Stress | None = Field(
        default=None,
        ge=0,
        description='a cohesion in Pa, >= 0, of "mohr_coulomb" and "drucker_prager"',
        examples=["20 kPa"],
    )
    friction_angle: Annotated[Angle, AfterValidator(_friction)] | None = Field(
        default=None,
        description='a friction angle in [0, pi/2) rad, of "mohr_coulomb" and "drucker_prager"',
        examples=example("rad"),
    )
    dilation_angle: Annotated[Angle, AfterValidator(_friction)] | None = Field(
        default=None,
        description="a dilation angle from 0, no change of volume, to the friction angle, rad",
        examples=["10 deg"],
    )
    tensile_strength: Stress | None = Field(
        default=None,
        ge=0,
        description='a largest tension in Pa, >= 0, of "mohr_coulomb" (principal stress) and '
        '"drucker_prager" (mean stress)',
        examples=["10 kPa"],
    )
    match: Literal["plane_strain", "compression", "extension"] | None = Field(
        default=None,
        description='where the cone of "drucker_prager" meets Mohr-Coulomb: "plane_strain" if not '
        'given, triaxial "compression" or "extension"',
        examples=["compression"],
    )
    viscosity: Annotated[float, quantity("Pa s")] | None = Field(
        default=None,
        gt=0,
        description='a shear viscosity in Pa s, > 0, of "maxwell", "kelvin" and "burgers"',
        examples=["1e18 Pa s"],
    )
    delayed_modulus: Stress | None = Field(
        default=None,
        gt=0,
        description='a shear modulus in Pa, > 0, of what gives way in time in "standard_solid" and '
        '"burgers"',
        examples=["5 GPa"],
    )
    delayed_viscosity: Annotated[float, quantity("Pa s")] | None = Field(
        default=None,
        gt=0,
        description="a shear viscosity in Pa s, > 0, beside it",
        examples=["1e16 Pa s"],
    )
    young_modulus_2: Stress | None = Field(
        default=None,
        gt=0,
        description='Young\'s modulus of axis 2 in Pa, > 0, of "orthotropic"; young_modulus and '
        "poisson_ratio are those of axis 1",
        examples=["0.9 GPa"],
    )
    shear_modulus: Stress | None = Field(
        default=None,
        gt=0,
        description="a shear modulus between both axes in Pa, > 0",
        examples=["0.7 GPa"],
    )
    axis_angle: Angle | None = Field(
        default=None, description="an angle of axis 1 from x in rad", examples=["30 deg"]
    )
    young_modulus_3: Stress | None = Field(
        default=None,
        gt=0,
        description="Young's modulus out of the plane in Pa, > 0; that of axis 2 if not given",
        examples=["0.9 GPa"],
    )
    poisson_ratio_13: Number | None = Field(
        default=None,
        description="a contraction out of the plane under pull along axis 1; poisson_ratio if not "
        "given",
        examples=[0.3],
    )
    poisson_ratio_23: Number | None = Field(
        default=None,
        description="a contraction out of the plane under pull along axis 2; poisson_ratio if not "
        "given",
        examples=[0.3],
    )
    conductivity: Annotated[float, quantity("W/m/K")] | None = Field(
        default=None,
        gt=0,
        description="a conductivity of heat in W/(m K), > 0",
        examples=example("W/m/K"),
    )
    heat_capacity: Annotated[float, quantity("J/kg/K")] | None = Field(
        default=None,
        gt=0,
        description="a heat capacity in J/(kg K), > 0",
        examples=example("J/kg/K"),
    )
    thermal_expansion: Annotated[float, quantity("1/K")] | None = Field(
        default=None, description="a strain for each kelvin in 1/K", examples=example("1/K")
    )
    hydraulic_conductivity: Annotated[float, quantity("m/s")] | None = Field(
        default=None,
        gt=0,
        description="a hydraulic conductivity in m/s, > 0",
        examples=["1e-6 m/s"],
    )
    specific_storage: Annotated[float, quantity("1/m")] | None = Field(
        default=None,
        gt=0,
        description="a volume of water stored in a volume for each metre of head in 1/m, > 0",
        examples=["1e-5 1/m"],
    )
    biot: Number | None = Field(
        default=None,
        ge=0,
        le=1,
        description="Biot's coefficient in [0, 1], 1 if not given",
        examples=[0.8],
    )
    options: Options = Field(default={}, description="a table of options of a law of one's own")


def _passage(unit: str) -> BeforeValidator:
    """Validator of what joints let through: a number in ``unit``, or "perfect"."""
    read = quantity(unit).func

    def checked(value: object) -> object:
        found = value if value == "perfect" else read(value)  # type: ignore[call-arg]
        if found == "perfect" or (isinstance(found, float) and found > 0):
            return found
        expected = f'a conductance in {unit}, > 0, or "perfect"'
        raise fault(value, expected, f'write for example "100 {unit}"')

    return BeforeValidator(checked)


Conductance = Annotated[float | Literal["perfect"], _passage("W/m^2/K")]
Leakage = Annotated[float | Literal["perfect"], _passage("1/s")]


def _pair(value: object) -> object:
    if value == "any" or (isinstance(value, list | tuple) and len(value) == 2):
        return value
    raise fault(
        repr(value), 'two materials or "any"', 'write for example between = ["rock", "rock"]'
    )


class InterfaceTable(Frozen):
    """Law and constants of the joints and contacts between two materials."""

    law: PartName = Field(
        default="mohr_coulomb",
        description='"mohr_coulomb", "linear_softening", "bilinear_softening" or "module:Name"',
    )
    between: Annotated[tuple[str, str] | Literal["any"], BeforeValidator(_pair)] = Field(
        default="any", description='two materials or "any"', examples=[["rock", "rock"]]
    )
    friction_angle: Annotated[Angle, AfterValidator(_friction)] = Field(
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
    residual_friction_angle: Annotated[Angle, AfterValidator(_friction)] | None = Field(
        default=None,
        description="a friction angle in [0, pi/2) rad of broken bonds",
        examples=example("rad"),
    )
    dilation_angle: Annotated[Angle, AfterValidator(_friction)] | None = Field(
        default=None, description="a dilation angle in [0, pi/2) rad", examples=example("rad")
    )
    dilation_slip: Length | None = Field(
        default=None,
        gt=0,
        description="a way slid in m, > 0, after which nothing dilates any more",
        examples=["5 mm"],
    )
    damping: Number | None = Field(
        default=None,
        ge=0,
        description="a share of critical damping of the pressed contact, >= 0",
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
        description='a heat flux for each kelvin between the faces in W/(m2 K), > 0, or "perfect" '
        "where the temperature is one; edges that blocks share insulate if not given",
        examples=["100 W/m^2/K"],
    )
    aperture: Length | None = Field(
        default=None,
        ge=0,
        description="an aperture in m, >= 0, of the joint as drawn, through which water flows",
        examples=["0.2 mm"],
    )
    residual_aperture: Length | None = Field(
        default=None,
        ge=0,
        description="the least aperture in m, >= 0, that closing leaves; 0 if not given",
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
        return self


class Block(Frozen):
    """One block given by its corners."""

    name: Name | None = Field(default=None, description=NAME, examples=["base"])
    material: str = Field(description="the name of a material", examples=["rock"])
    vertices: Ring = Field(
        description="three or more points [x, y] in m", examples=[[[0, 0], [1, 0], [1, 1]]]
    )
    holes: tuple[Ring, ...] = Field(default=(), description="a list of rings of points [x, y] in m")


class Crack(Frozen):
    """A crack that is there from the start: a polyline that may end inside blocks."""

    name: Name = Field(description=NAME, examples=["notch"])
    points: Annotated[tuple[Point, ...], Field(min_length=2)] = Field(
        description="two or more points [x, y] in m", examples=[[[0, 0], [0.5, 0]]]
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
