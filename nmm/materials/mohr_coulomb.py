"""Mohr-Coulomb plasticity of soil and rock in plane strain, perfectly plastic."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.errors import Fault, FormulationError
from nmm.materials.base import History, Response
from nmm.materials.plasticity import Plastic, flowed
from nmm.materials.principal_return import Pyramid, principal_return


@dataclass(frozen=True)
class MohrCoulombPlasticity(Plastic):
    """Yield where ``(s1 - s3) + (s1 + s3) sin phi`` reaches ``2 c cos phi``, tension positive.

    Flow is along the same with the dilation angle. The step is implicit: stresses return to a
    plane, an edge or the apex of the pyramid, the stress across taking part in all.

    Attributes
    ----------
    cohesion, friction_angle
        Pa; rad, below pi / 2. An angle of 0 is Tresca's law.
    dilation_angle
        From 0, no change of volume, to the friction angle (rad).

    Notes
    -----
    Internal variables: ``plastic_strain`` (4: xx, yy, 2 xy, zz), ``accumulated_plastic_strain``
    (the sum of ``sqrt(2/3 |de|^2)`` of its deviator), ``stress_zz`` (Pa). Where the angles differ
    the tangent is not symmetric.
    """

    cohesion: float
    friction_angle: float
    dilation_angle: float = 0.0

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

    @property
    def symmetric(self) -> bool:
        """Whether the angles are equal."""
        return self.dilation_angle == self.friction_angle

    def stiffness(self, plane: str) -> Floats:
        """See `Law.stiffness`; plane stress is refused."""
        if plane == "stress":
            expected = '"strain": the stress across takes part in the yield'
            raise FormulationError(
                Fault("mohr_coulomb", 'plane "stress"', expected, 'use "von_mises" in plane stress')
            )
        return super().stiffness(plane)

    def update(self, strain: Floats, history: History, plane: str, step: float) -> Response:
        """See `Law.update`."""
        pyramid = Pyramid.of(
            (self.young_modulus, self.poisson_ratio),
            (self.cohesion, self.friction_angle, self.dilation_angle),
        )
        before = history["plastic_strain"]
        found = principal_return(strain, before, pyramid)
        flow = found.plastic_strain - before
        flow = flow - flow[:, [0, 1, 3]].sum(axis=1)[:, None] / 3 * np.array([1, 1, 0, 1])
        size = np.sqrt(2 / 3 * (np.array([1, 1, 0.5, 1]) * flow**2).sum(axis=1))
        accumulated = history["accumulated_plastic_strain"][:, 0] + size
        return flowed(found.stress, found.tangent, found.plastic_strain, accumulated)
