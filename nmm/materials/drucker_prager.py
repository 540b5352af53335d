"""Drucker-Prager plasticity: a smooth cone in place of Mohr-Coulomb's pyramid."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from integration.arrays import Floats
from nmm.errors import FormulationError
from nmm.materials.base import History, Response
from nmm.materials.frictional import Frictional
from nmm.materials.plasticity import inelastic
from nmm.materials.return_mapping.cone_return import SmoothCone, cone_return
from nmm.materials.return_mapping.planes import ActingPlanes, falling

MATCHES = ("plane_strain", "compression", "extension")


@dataclass(frozen=True)
class DruckerPragerPlasticity(Frictional):
    """Yield where ``sqrt(J2) + eta p`` reaches ``xi c``, p the mean stress, tension positive.

    Flow is along the same with eta of the dilation angle. A tensile strength limits the mean
    stress; what opens there changes volume alone.

    Attributes
    ----------
    match
        Where the cone meets Mohr-Coulomb's pyramid of the same constants: ``"plane_strain"`` for
        equal collapse in plane strain, its edges of triaxial ``"compression"``, around it and too
        strong in plane strain, or of ``"extension"``.
    """

    match: str = "plane_strain"

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.match not in MATCHES:
            known = ", ".join(f'"{one}"' for one in MATCHES)
            raise FormulationError(f"match: {self.match!r}: expected one of {known}: correct it")

    def slopes(self, angle: float) -> tuple[float, float]:
        """Return eta and xi of an angle (Drucker and Prager 1952; Chen and Mizuno 1990)."""
        if self.match == "plane_strain":
            tangent = np.tan(angle)
            root = np.sqrt(9 + 12 * tangent**2)
            return float(3 * tangent / root), float(3 / root)
        sign = -1 if self.match == "compression" else 1
        below = np.sqrt(3) * (3 + sign * np.sin(angle))
        return float(6 * np.sin(angle) / below), float(6 * np.cos(angle) / below)

    @property
    def sets(self) -> Sequence[ActingPlanes]:
        return self._cone.sets

    def update(self, strain: Floats, history: History, plane: str, step: float) -> Response:
        before, weakening = inelastic(history), self.weakening(history)
        return self.answer(cone_return(strain, before, self._cone, weakening), history)

    @cached_property
    def _cone(self) -> SmoothCone:
        ends = np.array([[self.slopes(angle) for angle in end] for end in self.angles])
        eta, xi = ends[0, 0]
        slopes = np.stack([np.ones((2, 2)), ends[:, :, 0]], axis=2)
        slopes *= (xi / ends[:, 0, 1])[:, None, None]
        apex = xi * self.cohesion / eta if eta > 0 else np.inf
        cut = np.inf if self.tensile_strength is None else self.tensile_strength
        strength = np.array([xi * self.cohesion, min(cut, apex)])
        return SmoothCone(
            self.young_modulus / 2 / (1 + self.poisson_ratio),
            self.young_modulus / 3 / (1 - 2 * self.poisson_ratio),
            *(slopes, strength, falling(strength, self.fall)),
        )
