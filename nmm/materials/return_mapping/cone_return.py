"""Return of Drucker-Prager plasticity to its cone, cut off at a mean stress, all points at once.

Size of the deviator and mean stress span a plane in which the yield surface is two lines: the cone
``q + eta p = k`` and the cap ``p = t``, which is the apex where nothing is cut off before. Stresses
return to one of them or to the corner (`nmm.materials.return_mapping.planes`).
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from integration.arrays import Bools, Floats
from nmm.materials.return_mapping.planes import (
    BEYOND,
    ActingPlanes,
    ReturnedStress,
    StrengthLoss,
    return_to_planes,
)
from nmm.materials.return_mapping.turning_planes import planes_between
from nmm.materials.tensors import DEVIATOR, ISOTROPIC, SPHERICAL, TWICE

# Lines that act together: the cone, the cap, their corner.
ACTING = ([0], [1], [0, 1])


@dataclass(frozen=True)
class SmoothCone:
    """Elasticity, and the yield surface of Drucker and Prager.

    Attributes
    ----------
    shear, bulk
        Moduli (Pa).
    slopes
        (2, 2, 2) factors of q and p where nothing and where all of the fall is done, of yield and
        of flow: 1 and eta of friction and of dilation. The last count in units of the first ``xi``.
    strength
        (2,) ``xi c``, and the largest mean stress: the cut-off, or the apex; infinite where there
        is neither (Pa).
    falls
        (2,) by how much these fall (Pa).
    """

    shear: float
    bulk: float
    slopes: Floats
    strength: Floats
    falls: Floats

    @cached_property
    def sets(self) -> tuple[ActingPlanes, ...]:
        """Lines that act together."""
        elastic = np.diag([self.shear, self.bulk])
        first, last = ([np.array([one, [0, 1]]) for one in end] for end in self.slopes)
        acting = ACTING if np.isfinite(self.strength[1]) else ACTING[:1]
        return tuple(
            planes_between(
                elastic,
                ((first[0][at], first[1][at]), (last[0][at], last[1][at])),
                *(self.strength[at], self.falls[at]),
            )
            for at in acting
        )

    @cached_property
    def elastic(self) -> Floats:
        """(3, 3) stresses from strains (xx, yy, 2 xy) in plane strain (Pa)."""
        return np.asarray(2 * self.shear * DEVIATOR + self.bulk * np.outer(ISOTROPIC, ISOTROPIC))

    def flows(self, stress: Floats, done: Floats) -> Bools:
        """Return where (m,) deviator and mean stress (m, 2) exceed the surface."""
        return np.asarray(self.beyond(stress, done) > BEYOND * self.size(stress))

    def size(self, stress: Floats) -> Floats:
        """Return what rounding of deviator and mean stress (m, 2) is a share of, (m,) in Pa."""
        return np.asarray(np.abs(stress).sum(axis=1) + self.strength[0])

    def beyond(self, stress: Floats, done: Floats) -> Floats:
        """Return how far (m,) deviator and mean stress (m, 2) exceed the surface (Pa).

        Of the fall of its strengths the share ``done`` (m,) is.
        """
        cone, cap = self.strength[:, None] - np.outer(self.falls, done)
        size, mean = stress.T
        (_, slope), turn = self.slopes[0, 0], self.slopes[1, 0] - self.slopes[0, 0]
        over = size + slope * mean - cone
        if turn.any():
            over += done * (turn[0] * size + turn[1] * mean)
        return np.asarray(np.maximum(over, mean - cap))


def cone_return(
    strain: Floats, plastic: Floats, cone: SmoothCone, weakening: StrengthLoss
) -> ReturnedStress:
    """Return stresses to the cone; ``strain`` (m, 3) whole, ``plastic`` (m, 4) before."""
    elastic = np.column_stack([strain, np.zeros(len(strain))]) - plastic
    volume = elastic[:, [0, 1, 3]].sum(axis=1)
    deviator = 2 * cone.shear * (elastic / TWICE - volume[:, None] / 3 * SPHERICAL)
    size = np.sqrt((TWICE * deviator**2).sum(axis=1) / 2)
    trial = np.column_stack([size, cone.bulk * volume])
    # One tangent for all points, copied where some flow.
    tangent = np.broadcast_to(cone.elastic, (len(trial), 3, 3))
    stress = deviator + trial[:, 1:] * SPHERICAL
    flows = np.flatnonzero(cone.flows(trial, weakening.done))
    if not len(flows):
        return ReturnedStress(stress, tangent, plastic, weakening.done)
    back = _returned(trial[flows], deviator[flows], cone, weakening.at(flows))
    found = ReturnedStress(stress, tangent.copy(), plastic.copy(), weakening.done.copy())
    found.put(flows, back)
    return found


def _returned(
    trial: Floats, deviator: Floats, cone: SmoothCone, weakening: StrengthLoss
) -> ReturnedStress:
    """Return stresses of points beyond the cone, and by how much their plastic strain grows.

    ``trial`` (m, 2) are size and mean stress before, ``deviator`` (m, 4) the rest of the stress.
    """
    scale = cone.shear, cone.size(trial)
    after, change, done = return_to_planes(trial, cone.sets, weakening, cone.beyond, scale)
    size = trial[:, 0]
    shaped = np.where(size > 0, size, 1.0)
    left = np.where(size > 0, after[:, 0] / shaped, 1.0)
    stress = left[:, None] * deviator + after[:, 1:] * SPHERICAL
    flow = (1 - left)[:, None] * deviator / 2 / cone.shear
    flow = flow + ((trial - after)[:, 1] / 3 / cone.bulk)[:, None] * SPHERICAL
    tangent = _tangent(left, deviator[:, :3] / shaped[:, None], change, cone)
    return ReturnedStress(stress, tangent, flow * TWICE, done)


def _tangent(left: Floats, way: Floats, change: Floats, cone: SmoothCone) -> Floats:
    """Consistent tangent (m, 3, 3).

    ``left`` (m,) is what is left of the deviator, ``way`` (m, 3) the deviator over its size,
    ``change`` (m, 2, 2) the derivative of size and mean stress by those of the trial.
    """
    turn = cone.shear * way[:, :, None] * way[:, None, :]
    volume = np.broadcast_to(ISOTROPIC, way.shape)
    sides = np.stack([way, volume], axis=2)
    rises = np.stack([cone.shear * way, cone.bulk * volume], axis=1)
    kept = left[:, None, None] * (2 * cone.shear * DEVIATOR - turn)
    return np.asarray(kept + sides @ change @ rises)
