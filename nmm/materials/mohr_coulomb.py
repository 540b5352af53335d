"""Mohr-Coulomb plasticity of soil and rock in plane strain."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from integration.arrays import Floats
from nmm.materials.base import History, Response
from nmm.materials.frictional import Frictional
from nmm.materials.plasticity import inelastic
from nmm.materials.return_mapping.planes import ActingPlanes
from nmm.materials.return_mapping.principal_return import Pyramid, principal_return


@dataclass(frozen=True)
class MohrCoulombPlasticity(Frictional):
    """Yield where ``(s1 - s3) + (s1 + s3) sin phi`` reaches ``2 c cos phi``, tension positive.

    Flow is along the same with the dilation angle. With a tensile strength no principal stress
    passes it, and what opens there flows along that stress. The step is implicit: stresses return
    to a plane, an edge or a corner of the pyramid, the stress across taking part in all.
    """

    @property
    def sets(self) -> Sequence[ActingPlanes]:
        return self._pyramid.sets

    def update(self, strain: Floats, history: History, plane: str, step: float) -> Response:
        before, weakening = inelastic(history), self.weakening(history)
        found = principal_return(strain, before, self._pyramid, weakening)
        return self.answer(found, history)

    @cached_property
    def _pyramid(self) -> Pyramid:
        return Pyramid.of(
            (self.young_modulus, self.poisson_ratio),
            self.angles,
            (self.cohesion, self.tension),
            self.fall,
        )
