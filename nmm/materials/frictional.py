"""What laws share whose strength grows with pressure: constants and their limits."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.errors import Fault, FormulationError
from nmm.materials.plasticity import Plastic


@dataclass(frozen=True)
class Frictional(Plastic):
    """Base of perfectly plastic laws with cohesion and friction, in plane strain.

    Attributes
    ----------
    cohesion, friction_angle
        Pa; rad, below pi / 2. An angle of 0 leaves cohesion alone.
    dilation_angle
        From 0, no change of volume, to the friction angle (rad).
    tensile_strength
        Pa, below the tension ``c / tan phi`` at the apex; none cuts nothing off.

    Notes
    -----
    Internal variables: ``plastic_strain`` (4: xx, yy, 2 xy, zz), ``accumulated_plastic_strain``
    (the sum of ``sqrt(2/3 |de|^2)`` of its deviator), ``stress_zz`` (Pa). Where the angles differ
    the tangent is not symmetric.
    """

    cohesion: float
    friction_angle: float
    dilation_angle: float = 0.0
    tensile_strength: float | None = None

    def __post_init__(self) -> None:
        if not self.cohesion >= 0:
            raise FormulationError(
                f"cohesion: {self.cohesion}: expected a cohesion in Pa, >= 0: correct it"
            )
        if not 0 <= self.friction_angle < np.pi / 2:
            raise FormulationError(
                f"friction_angle: {self.friction_angle}: expected an angle in [0, pi/2) rad: "
                "correct it"
            )
        if self.cohesion == 0 and self.friction_angle == 0:
            raise FormulationError(
                "cohesion and friction_angle: 0: expected strength: raise one of them"
            )
        if not 0 <= self.dilation_angle <= self.friction_angle:
            raise FormulationError(
                f"dilation_angle: {self.dilation_angle}: expected an angle from 0 to the friction "
                f"angle of {self.friction_angle:.6g} rad: beyond it flow would give energy"
            )
        if self.tensile_strength is not None and not 0 <= self.tensile_strength <= self.apex:
            raise FormulationError(
                f"tensile_strength: {self.tensile_strength}: expected a stress from 0 to the apex "
                f"at c / tan(phi) = {self.apex:.6g} Pa, beyond which it never acts: lower it, or "
                "leave it out"
            )

    @property
    def apex(self) -> float:
        """Tension from all sides at which cohesion ends (Pa); infinite without friction."""
        tangent = float(np.tan(self.friction_angle))
        return self.cohesion / tangent if tangent else float("inf")

    @property
    def cut_off(self) -> float:
        """Tensile strength (Pa); infinite where none is given."""
        return float("inf") if self.tensile_strength is None else self.tensile_strength

    @property
    def symmetric(self) -> bool:
        """Whether the angles are equal."""
        return self.dilation_angle == self.friction_angle

    def stiffness(self, plane: str) -> Floats:
        """See `Law.stiffness`; plane stress is refused."""
        if plane == "stress":
            expected = '"strain": the stress across takes part in the yield'
            raise FormulationError(
                Fault("law", 'plane "stress"', expected, 'use "von_mises" in plane stress')
            )
        return super().stiffness(plane)
