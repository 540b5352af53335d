"""Mohr and Coulomb's strength with a tension cut-off, as Lin (1995) splits blocks by it."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.errors import FormulationError
from nmm.materials.principal_stresses import PrincipalStresses
from nmm.splitting.strength import BlockStrength, SplitJudgement


@dataclass(frozen=True)
class CoulombStrength(BlockStrength):
    """``s1 = f_t`` in tension, ``(s1 - s2) / 2 + (s1 + s2) / 2 sin phi = c cos phi`` in shear.

    Tension splits along the plane normal to the larger principal stress ``s1``; shear along planes
    of ``45 - phi / 2`` degrees to the direction of the smaller one, two of which are as near to
    failure. Where both limits are passed it is tension. Principal stresses are those in the plane.
    The use of strength is of degree one in the stress: the factor of a proportional load.

    Parameters
    ----------
    tensile_strength
        f_t (Pa); None where tension alone splits nothing.
    cohesion
        c (Pa); None where shear splits nothing.
    friction_angle
        phi (rad).
    """

    tensile_strength: float | None = None
    cohesion: float | None = None
    friction_angle: float = 0.0

    def __post_init__(self) -> None:
        if self.tensile_strength is None and self.cohesion is None:
            raise FormulationError(
                "strength: neither tensile_strength nor cohesion: expected one of them: add it"
            )

    def judged(self, stress: Floats) -> SplitJudgement:
        main = PrincipalStresses.of(stress)
        pulled, sheared = self._pulled(main), self._sheared(main)
        tension = (pulled >= 1) | (pulled >= sheared)
        apart = np.pi / 4 - self.friction_angle / 2
        along = main.angle + np.pi / 2  # of the smaller principal stress
        planes = np.stack([along + apart, along - apart], axis=1)
        across = np.stack([along, np.full(len(along), np.nan)], axis=1)
        return SplitJudgement(
            use=np.where(tension, pulled, sheared),
            planes=np.where(tension[:, None], across, planes),
            tension=tension,
        )

    def _pulled(self, main: PrincipalStresses) -> Floats:
        """Share (m,) of the strength in tension."""
        if self.tensile_strength is None:
            return np.zeros_like(main.larger)
        return np.maximum(main.larger, 0.0) / self.tensile_strength

    def _sheared(self, main: PrincipalStresses) -> Floats:
        """Share (m,) of the strength in shear."""
        if self.cohesion is None:
            return np.zeros_like(main.larger)
        sine, cosine = np.sin(self.friction_angle), np.cos(self.friction_angle)
        half, mean = (main.larger - main.smaller) / 2, (main.larger + main.smaller) / 2
        return np.asarray(np.maximum(half + mean * sine, 0.0) / (self.cohesion * cosine))
