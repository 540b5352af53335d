"""Return of Mohr-Coulomb plasticity in principal stresses, all points at once.

Planes of the pyramid and of the tension cut-off are linear in principal stresses, sorted from the
largest tension: stresses return to a plane, an edge or a corner (`planes`).
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np

from integration.arrays import Bools, Floats
from nmm.materials.return_mapping.planes import (
    BEYOND,
    ActingPlanes,
    Normals,
    ReturnedStress,
    StrengthLoss,
    falling,
    return_to_planes,
)
from nmm.materials.return_mapping.turning_planes import planes_between

# In-plane principal stresses closer than this share of the largest have no direction.
EQUAL = 1e-12
StageLoads = tuple[tuple[tuple[int, int], ...], tuple[int, ...]]
# Pairs of sorted principal stresses whose planes of friction act alone or on the edges where the
# smaller two or the larger two are equal.
CONE = (((0, 2),), ((0, 2), (0, 1)), ((0, 2), (1, 2)))
# Sets with planes of tension: those of the principal stresses that are cut off beside some pairs.
# The last one is the apex, where there is one.
CUT: tuple[StageLoads, ...] = (
    *(((), (0,)), ((), (0, 1)), (((0, 2),), (0,)), (((0, 2), (0, 1)), (0,))),
    *((((0, 2),), (0, 1)), (((0, 2), (1, 2)), (0,)), ((), (0, 1, 2))),
)


@dataclass(frozen=True)
class Pyramid:
    """Elasticity, yield surface and the sets of planes that can act.

    Attributes
    ----------
    elastic
        (3, 3) principal stresses from principal strains (Pa).
    shear
        Shear modulus (Pa).
    slopes
        (2, 2) factors of ``s1 - s3`` and of ``s1 + s3``: 1 and ``sin phi``, where nothing and where
        all of the fall is done. The last ones count in units of ``2 c cos phi`` of the first.
    strength
        (2,) ``2 c cos phi``, and the largest principal stress: the cut-off, or the apex; infinite
        where there is neither (Pa).
    falls
        (2,) by how much these fall (Pa).
    sets
        Planes that act together.
    """

    elastic: Floats
    shear: float
    slopes: Floats
    strength: Floats
    falls: Floats
    sets: tuple[ActingPlanes, ...]

    @classmethod
    def of(
        cls,
        elasticity: tuple[float, float],
        angles: Floats,
        strengths: tuple[float, float],
        fall: float,
    ) -> Self:
        """Return that of Young's modulus and Poisson's ratio, and of the strength.

        ``angles`` (2, 2) are of friction and of dilation, at first and in the end; ``strengths``
        cohesion and the largest principal stress, of which the share ``fall`` is lost in the end.
        """
        (e, nu), friction = elasticity, angles[:, 0]
        shear, lame = e / 2 / (1 + nu), e * nu / (1 + nu) / (1 - 2 * nu)
        elastic = lame * np.ones((3, 3)) + 2 * shear * np.eye(3)
        strength = np.array([2 * strengths[0] * np.cos(friction[0]), strengths[1]])
        falls = falling(strength, fall)
        unit = np.cos(friction[0]) / np.cos(friction)
        # Of both ends (2,): factors (2, 2) of the sums and differences, of yield and of flow.
        slopes = unit[:, None, None] * np.stack([np.ones_like(angles), np.sin(angles)], axis=2)
        acting: list[StageLoads] = [(pairs, ()) for pairs in CONE]
        if np.isfinite(strength[1]):
            acting += CUT
        sets = tuple(_planes(elastic, one, slopes, (strength, falls)) for one in acting)
        return cls(elastic, shear, slopes[:, 0], strength, falls, sets)

    @cached_property
    def whole(self) -> Floats:
        """(4, 4) stresses (xx, yy, xy, zz) from strains (xx, yy, 2 xy, zz) in plane strain (Pa)."""
        found, normal = np.zeros((4, 4)), np.array([0, 1, 3])
        found[np.ix_(normal, normal)], found[2, 2] = self.elastic, self.shear
        return found

    def size(self, stress: Floats) -> Floats:
        """Return what rounding of principal stresses (m, 3) is a share of, (m,) in Pa."""
        return np.asarray(_ends(np.abs(stress))[0] + self.strength[0])

    def flows(self, stress: Floats, done: Floats) -> Bools:
        """Return where (m,) principal stresses (m, 3) in any order exceed the surface."""
        return np.asarray(self.beyond(stress, done) > BEYOND * self.size(stress))

    def beyond(self, stress: Floats, done: Floats) -> Floats:
        """Return how far (m,) principal stresses (m, 3) in any order exceed the surface (Pa).

        Of the fall of its strengths the share ``done`` (m,) is.
        """
        first, last = _ends(stress)
        cone, tension = self.strength[:, None] - np.outer(self.falls, done)
        (_, slope), turn = self.slopes[0], self.slopes[1] - self.slopes[0]
        over = (first - last) + (first + last) * slope - cone
        if turn.any():
            over += done * ((first - last) * turn[0] + (first + last) * turn[1])
        return np.asarray(np.maximum(over, first - tension))


def principal_return(
    strain: Floats, plastic: Floats, pyramid: Pyramid, weakening: StrengthLoss
) -> ReturnedStress:
    """Return stresses to the pyramid; ``strain`` (m, 3) whole, ``plastic`` (m, 4) before.

    Only points beyond it are turned to their principal axes.
    """
    elastic = np.column_stack([strain, np.zeros(len(strain))]) - plastic
    stress = elastic @ pyramid.whole
    # One tangent for all points, copied where some flow.
    tangent = np.broadcast_to(pyramid.whole[:3, :3], (len(strain), 3, 3))
    flows = pyramid.flows(_values(stress), weakening.done)
    if not flows.any():
        return ReturnedStress(stress, tangent, plastic, weakening.done)
    back = _returned(elastic[flows], pyramid, weakening.at(flows))
    found = ReturnedStress(stress, tangent.copy(), plastic.copy(), weakening.done.copy())
    found.put(flows, back)
    return found


def _ends(stress: Floats) -> tuple[Floats, Floats]:
    """Largest and least (m,) of three stresses each (m, 3), by columns, which is fast."""
    a, b, c = stress.T
    return np.maximum(np.maximum(a, b), c), np.minimum(np.minimum(a, b), c)


def _values(tensor: Floats) -> Floats:
    """Principal values (m, 3) of tensors (m, 4: xx, yy, xy, zz)."""
    middle, half = (tensor[:, 0] + tensor[:, 1]) / 2, (tensor[:, 0] - tensor[:, 1]) / 2
    radius = np.hypot(half, tensor[:, 2])
    return np.stack([middle + radius, middle - radius, tensor[:, 3]], axis=1)


def _principal(tensor: Floats) -> tuple[Floats, Floats]:
    """Principal values (m, 3) of tensors (m, 4: xx, yy, xy, zz), and angles (m,) of the first."""
    half = (tensor[:, 0] - tensor[:, 1]) / 2
    return _values(tensor), np.arctan2(tensor[:, 2], half) / 2


def _returned(elastic: Floats, pyramid: Pyramid, weakening: StrengthLoss) -> ReturnedStress:
    """Return stresses of points beyond the pyramid, and by how much their plastic strain grows.

    ``elastic`` (m, 4: xx, yy, 2 xy, zz) are their strains before.
    """
    principal, angle = _principal(elastic * np.array([1.0, 1.0, 0.5, 1.0]))
    trial = principal @ pyramid.elastic
    order = np.argsort(-trial, axis=1, kind="stable")
    given = np.take_along_axis(trial, order, axis=1)
    scale = pyramid.shear, pyramid.size(trial)
    found, turned, done = return_to_planes(given, pyramid.sets, weakening, pyramid.beyond, scale)
    tangent = turned @ pyramid.elastic
    rank = np.argsort(order, axis=1)
    stress = np.take_along_axis(found, rank, axis=1)
    tangent = tangent[np.arange(len(rank))[:, None, None], rank[:, :, None], rank[:, None, :]]
    local = np.zeros_like(tangent)
    local[:, :2, :2] = tangent[:, :2, :2]
    local[:, 2, 2] = _shear(stress, trial, tangent, pyramid.shear)
    axes = _axes(angle)
    whole = np.swapaxes(axes, 1, 2) @ local @ axes
    tensor = np.einsum("mi,mij->mj", stress[:, :2], axes[:, :2])
    back = np.column_stack([tensor[:, :2], tensor[:, 2], stress[:, 2]])
    left = stress @ np.linalg.inv(pyramid.elastic)
    flat = np.einsum("mi,mij->mj", left[:, :2], axes[:, :2])
    kept = np.column_stack([flat[:, :2], 2 * flat[:, 2], left[:, 2]])
    return ReturnedStress(back, whole, elastic - kept, done)


def _shear(stress: Floats, trial: Floats, tangent: Floats, shear: float) -> Floats:
    """Stiffness (m,) against a turn of the principal axes in the plane (Pa)."""
    apart = trial[:, 0] - trial[:, 1]
    distinct = apart > EQUAL * np.abs(trial).max(axis=1)
    turned = shear * (stress[:, 0] - stress[:, 1]) / np.where(distinct, apart, 1.0)
    alike = tangent[:, 0, 0] + tangent[:, 1, 1] - tangent[:, 0, 1] - tangent[:, 1, 0]
    return np.where(distinct, turned, alike / 4)


def _axes(angle: Floats) -> Floats:
    """Matrices (m, 3, 3) from strain (xx, yy, 2 xy) to that in axes turned by ``angle`` (m,)."""
    c, s = np.cos(angle), np.sin(angle)
    return np.stack(
        [
            np.stack([c * c, s * s, c * s], axis=1),
            np.stack([s * s, c * c, -c * s], axis=1),
            np.stack([-2 * c * s, 2 * c * s, c * c - s * s], axis=1),
        ],
        axis=1,
    )


def _planes(
    elastic: Floats,
    acting: StageLoads,
    slopes: Floats,
    strengths: tuple[Floats, Floats],
) -> ActingPlanes:
    """Return one set of planes; ``strengths`` are those at first and their falls.

    ``slopes`` (2, 2, 2) are factors at both ends, of yield and of flow, of differences and sums.
    """
    pairs, cut = acting
    kind = np.array([0] * len(pairs) + [1] * len(cut))
    first, last = (_normals(acting, one) for one in slopes)
    return planes_between(elastic, (first, last), strengths[0][kind], strengths[1][kind])


def _normals(acting: StageLoads, slopes: Floats) -> Normals:
    """Normals (p, 3) of yield and of flow, of slopes (2, 2) of both."""
    pairs, cut = acting
    tensile = [np.eye(3)[one] for one in cut]
    normal, way = (np.array([*(_plane(pair, one) for pair in pairs), *tensile]) for one in slopes)
    return normal, way


def _plane(pair: tuple[int, int], slopes: Floats) -> Floats:
    """Gradient (3,) of ``(si - sj)`` and ``(si + sj)`` times their slopes (2,)."""
    found = np.zeros(3)
    found[pair[0]], found[pair[1]] = slopes[1] + slopes[0], slopes[1] - slopes[0]
    return found
