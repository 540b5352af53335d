"""Return of Drucker-Prager plasticity to its cone, cut off at a mean stress, all points at once.

Size of the deviator and mean stress span a plane in which the yield surface is two lines: the cone
``q + eta p = k`` and the cap ``p = t``, which is the apex where nothing is cut off before. Stresses
return to one of them or to the corner (de Souza Neto, Peric and Owen 2008, chapter 8).
"""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Bools, Floats
from nmm.materials.principal_return import ReturnedStress
from nmm.materials.radial_return import BEYOND, DEVIATOR, TWICE, VOLUME

MEAN = np.array([1.0, 1.0, 0.0, 1.0])


@dataclass(frozen=True)
class SmoothCone:
    """Elasticity, and the yield surface of Drucker and Prager.

    Attributes
    ----------
    shear, bulk
        Moduli (Pa).
    slope, dilation
        eta of friction and of dilation.
    strength
        ``xi c`` (Pa).
    cut
        Largest mean stress (Pa), infinite for none but the apex.
    """

    shear: float
    bulk: float
    slope: float
    dilation: float
    strength: float
    cut: float

    @property
    def cap(self) -> float:
        """Mean stress (Pa) of the cap: the cut or the apex."""
        return min(self.cut, self.strength / self.slope if self.slope > 0 else np.inf)

    @property
    def corner(self) -> float:
        """Size of the deviator ``sqrt(J2)`` (Pa) where cone and cap meet; 0 at the apex."""
        return max(self.strength - self.slope * self.cap, 0.0) if self.slope > 0 else self.strength


def cone_return(strain: Floats, plastic: Floats, cone: SmoothCone) -> ReturnedStress:
    """Return stresses to the cone; ``strain`` (m, 3) whole, ``plastic`` (m, 4) before."""
    elastic = np.column_stack([strain, np.zeros(len(strain))]) - plastic
    tensor = elastic * np.array([1, 1, 0.5, 1])
    volume = elastic[:, [0, 1, 3]].sum(axis=1)
    trial = 2 * cone.shear * (tensor - volume[:, None] / 3 * MEAN)
    size, mean = np.sqrt((TWICE * trial**2).sum(axis=1) / 2), cone.bulk * volume
    on_cone, on_cap, in_corner = _places(size, mean, cone)
    more = (size + cone.slope * mean - cone.strength) / _stiff(cone)
    after = np.where(on_cone, size - cone.shear * more, np.where(in_corner, cone.corner, size))
    pressed = np.where(on_cone, mean - cone.bulk * cone.dilation * more, mean)
    pressed = np.where(on_cap | in_corner, cone.cap, pressed)
    left = after / np.where(size > 0, size, 1.0)
    left = np.where(size > 0, left, 1.0)
    stress = left[:, None] * trial + pressed[:, None] * MEAN
    flow = (1 - left)[:, None] * trial / 2 / cone.shear
    flow = flow + ((mean - pressed) / 3 / cone.bulk)[:, None] * MEAN
    way = trial[:, :3] / np.where(size > 0, size, 1.0)[:, None]
    tangent = _tangent(left, way, (on_cone, on_cap, in_corner), cone)
    return ReturnedStress(stress, tangent, plastic + flow * TWICE)


def _places(size: Floats, mean: Floats, cone: SmoothCone) -> tuple[Bools, Bools, Bools]:
    """Return which points (m,) return to the cone, to the cap, to their corner."""
    rounding = BEYOND * (size + np.abs(mean) + cone.strength)
    over = size + cone.slope * mean - cone.strength
    along = mean - cone.bulk * cone.dilation * over / _stiff(cone)
    high = mean > cone.cap + rounding
    on_cone = (over > rounding) & (along <= cone.cap)
    on_cap = high & ~on_cone & (size <= cone.corner)
    return on_cone, on_cap, (high | (over > rounding)) & ~on_cone & ~on_cap


def _stiff(cone: SmoothCone) -> float:
    """Stiffness (Pa) against flow along the cone."""
    return cone.shear + cone.bulk * cone.slope * cone.dilation


def _tangent(left: Floats, way: Floats, at: tuple[Bools, Bools, Bools], cone: SmoothCone) -> Floats:
    """Consistent tangent (m, 3, 3); ``way`` (m, 3) is the deviator over its size ``sqrt(J2)``."""
    on_cone, on_cap, in_corner = (one[:, None, None] for one in at)
    share = left[:, None, None]
    shape = 2 * cone.shear * DEVIATOR
    volume = cone.bulk * np.outer(VOLUME, VOLUME)
    turn = cone.shear * way[:, :, None] * way[:, None, :]
    flow = cone.shear * way + cone.bulk * cone.dilation * VOLUME
    normal = cone.shear * way + cone.bulk * cone.slope * VOLUME
    lost = flow[:, :, None] * normal[:, None, :] / _stiff(cone)
    bent = share * shape + (1 - share) * turn + volume
    found = np.where(on_cone, bent - lost, np.where(on_cap, shape, shape + volume))
    return np.where(in_corner, share * (shape - turn), found)
