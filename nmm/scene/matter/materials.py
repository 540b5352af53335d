"""Tables of materials: laws and constants of the inside of blocks."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from nmm.scene.fields import (
    Angle,
    Density,
    FrictionAngle,
    Frozen,
    Number,
    Options,
    PartName,
    Stress,
    SurfaceEnergy,
    example,
    quantity,
)


class Material(Frozen):
    """Law and constants of the inside of blocks."""

    law: PartName = Field(
        default="elastic",
        description='"elastic", "von_mises", "mohr_coulomb", "drucker_prager", "maxwell", '
        '"kelvin", "standard_solid", "burgers", "orthotropic", "neo_hookean", or "module:Name" of '
        "a law of one's own",
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
        description="a slope of stress over plastic strain in Pa, >= 0; perfectly plastic if not "
        "given",
        examples=["2 GPa"],
    )
    softening_energy: SurfaceEnergy | None = Field(
        default=None,
        gt=0,
        description="an energy in J/m2, > 0, that a band of flow takes for its area until its "
        "strength is the residual one, beyond what that takes: of "
        '"von_mises", "mohr_coulomb" and "drucker_prager" in plane strain; none if not given',
        examples=example("J/m^2"),
    )
    residual_stress: Stress | None = Field(
        default=None,
        ge=0,
        description='the yield stress in Pa, >= 0, that softening leaves of "von_mises"; 0 if not '
        "given",
        examples=["50 kPa"],
    )
    residual_cohesion: Stress | None = Field(
        default=None,
        ge=0,
        description='the cohesion in Pa, >= 0, that softening leaves of "mohr_coulomb" and '
        '"drucker_prager", and of tensile_strength the same share; 0 if not given',
        examples=["5 kPa"],
    )
    residual_friction_angle: FrictionAngle | None = Field(
        default=None,
        description="a friction angle from 0 to friction_angle, rad, that softening leaves; it "
        "stays if not given",
        examples=["25 deg"],
    )
    residual_dilation_angle: FrictionAngle | None = Field(
        default=None,
        description="a dilation angle from 0 to dilation_angle and to residual_friction_angle, "
        "rad, that softening leaves; it stays if not given",
        examples=["0 deg"],
    )
    cohesion: Stress | None = Field(
        default=None,
        ge=0,
        description='a cohesion in Pa, >= 0, of "mohr_coulomb" and "drucker_prager"',
        examples=["20 kPa"],
    )
    friction_angle: FrictionAngle | None = Field(
        default=None,
        description='a friction angle in [0, pi/2) rad, of "mohr_coulomb" and "drucker_prager"',
        examples=example("rad"),
    )
    dilation_angle: FrictionAngle | None = Field(
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
        description='"plane_strain", "compression" or "extension": where the cone of '
        '"drucker_prager" meets Mohr-Coulomb, the last two triaxial; plane_strain if not given',
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
        description='a delayed shear modulus in Pa, > 0, of "standard_solid" and "burgers"',
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
        description="a thermal conductivity in W/(m K), > 0",
        examples=example("W/m/K"),
    )
    conductivity_2: Annotated[float, quantity("W/m/K")] | None = Field(
        default=None,
        gt=0,
        description="a thermal conductivity along axis 2 in W/(m K), > 0; conductivity is then "
        "that of axis 1, at axis_angle; alike in all directions if not given",
        examples=example("W/m/K"),
    )
    heat_capacity: Annotated[float, quantity("J/kg/K")] | None = Field(
        default=None,
        gt=0,
        description="a heat capacity in J/(kg K), > 0",
        examples=example("J/kg/K"),
    )
    thermal_expansion: Annotated[float, quantity("1/K")] | None = Field(
        default=None,
        description="a coefficient of thermal expansion in 1/K",
        examples=example("1/K"),
    )
    hydraulic_conductivity: Annotated[float, quantity("m/s")] | None = Field(
        default=None,
        gt=0,
        description="a hydraulic conductivity in m/s, > 0",
        examples=["1e-6 m/s"],
    )
    hydraulic_conductivity_2: Annotated[float, quantity("m/s")] | None = Field(
        default=None,
        gt=0,
        description="a hydraulic conductivity along axis 2 in m/s, > 0; hydraulic_conductivity is "
        "then that of axis 1, at axis_angle; alike in all directions if not given",
        examples=["1e-7 m/s"],
    )
    specific_storage: Annotated[float, quantity("1/m")] | None = Field(
        default=None,
        gt=0,
        description="a volume of water stored in a volume for each metre of head in 1/m, > 0",
        examples=["1e-5 1/m"],
    )
    drainable_porosity: Number | None = Field(
        default=None,
        gt=0,
        le=1,
        description="share of the volume that water leaves as its free surface falls, in (0, 1]",
        examples=[0.2],
    )
    biot: Number | None = Field(
        default=None,
        ge=0,
        le=1,
        description="Biot's coefficient in [0, 1], 1 if not given",
        examples=[0.8],
    )
    options: Options = Field(default={}, description="a table of options of a law of one's own")
