"""The table ``[strength_reduction]``: the factor of safety by division of strengths."""

from __future__ import annotations

from pydantic import Field, model_validator

from nmm.scene.fields import Frozen, Number, fault


class StrengthReductionTable(Frozen):
    """Finds the factor of safety, by which strengths are divided until there is no equilibrium.

    Cohesion, the tangents of friction angles, tensile strengths and yield stresses of all materials
    and interfaces are divided. A factor holds where the scene finds equilibrium under all its
    loads, and fails where it finds none. The answer is bracketed: the largest factor that holds and
    the smallest that fails. With stages a factor holds where all of them find equilibrium.
    """

    lowest: Number = Field(
        default=0.1, gt=0, description="a factor > 0 below which is not sought", examples=[0.5]
    )
    highest: Number = Field(
        default=10.0, gt=0, description="a factor above which is not sought", examples=[4.0]
    )
    tolerance: Number = Field(
        default=0.01, gt=0, description="a width of the bracket, > 0", examples=[0.01]
    )

    @model_validator(mode="after")
    def _check(self) -> StrengthReductionTable:
        if not self.lowest < self.highest:
            remedy = "raise highest, or lower lowest"
            raise fault(f"lowest = {self.lowest:g}", f"less than {self.highest:g}", remedy)
        return self
