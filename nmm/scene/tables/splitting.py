"""Tables of blocks that split: strength and limits of a material."""

from __future__ import annotations

from typing import Literal

from pydantic import Field, model_validator

from nmm.scene.fields import Angle, Count, Frozen, Length, Options, PartName, Stress, fault


class SplittingTable(Frozen):
    """Blocks of a material split where the stress of one reaches the strength; needs contact.

    The stress is that at the centroid, the mean of the elements that touch it, or that of the
    element that is nearest to its strength, or of the next where a piece would be too small
    (`judged_at`); in time a piece is judged once a wave has crossed it. A block splits along the
    plane through that place that the law names: normal to the larger principal stress by tension;
    by shear along one of two planes at 45 - phi/2 degrees to the direction of the largest
    compression, the one whose new faces are shorter, along both where they are as long. The new
    faces meet by the interface of the material with itself, without a bond. A block stays whole
    where a piece would be smaller than `smallest_block`, or there would be more than
    `most_blocks`; those that are most beyond their strength come first.
    """

    law: PartName = Field(
        default="mohr_coulomb",
        description='"mohr_coulomb" or "module:Class" of a strength of one\'s own',
        examples=["mohr_coulomb"],
    )
    tensile_strength: Stress | None = Field(
        default=None, gt=0, description="a stress in Pa, > 0", examples=["2.9 MPa"]
    )
    cohesion: Stress | None = Field(
        default=None, gt=0, description="a stress in Pa, > 0", examples=["4.7 MPa"]
    )
    friction_angle: Angle = Field(
        default=0.0,
        ge=0,
        lt=1.5707963267948966,
        description="an angle in rad, 0 to below pi/2",
        examples=["37 deg"],
    )
    smallest_block: Length = Field(
        gt=0,
        description="a length in m, > 0: four areas over the perimeter of the smallest piece, the "
        "side of a square",
        examples=["20 mm"],
    )
    most_blocks: Count = Field(
        default=1000,
        ge=2,
        description="largest number of blocks of the material, an integer >= 2",
        examples=[200],
    )
    judged_at: Literal["centroid", "elements"] = Field(
        default="centroid",
        description='"centroid" or "elements": a block is judged, and splits, at its middle, or at '
        "the one of its elements that is nearest to its strength",
        examples=["elements"],
    )
    stress: Literal["effective", "total"] = Field(
        default="effective",
        description='"effective" or "total": whether the stress that is judged is that of grains '
        "and water together, plus the pressure of the water (Terzaghi), or without it",
        examples=["total"],
    )
    options: Options = Field(default={}, description="options of a law of one's own")

    @model_validator(mode="after")
    def _strong(self) -> SplittingTable:
        if self.tensile_strength is None and self.cohesion is None:
            remedy = 'add for example tensile_strength = "2.9 MPa"'
            raise fault("neither tensile_strength nor cohesion", "one of them", remedy)
        return self
