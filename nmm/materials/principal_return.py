"""Return of Mohr-Coulomb plasticity in principal stresses, all points at once.

Planes of the pyramid and of the tension cut-off are linear and nothing hardens: on a plane, an edge
or a corner the returned principal stresses, sorted from the largest tension, are a fixed matrix of
the trial's and a fixed vector (de Souza Neto, Peric and Owen 2008, chapter 8). Which planes act is
found by trying all sets that can: none may be exceeded and none may flow backwards (the conditions
of Karush, Kuhn and Tucker, Koiter 1953).
"""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Self

import numpy as np

from integration.arrays import Bools, Floats

# Share of the stresses by which rounding leaves a point beyond the yield surface: it is elastic.
BEYOND = 1e-10
# In-plane principal stresses closer than this share of the largest have no direction.
EQUAL = 1e-12
Acting = tuple[tuple[tuple[int, int], ...], tuple[int, ...]]
# Pairs of sorted principal stresses whose planes of friction act alone or on the edges where the
# smaller two or the larger two are equal.
CONE = (((0, 2),), ((0, 2), (0, 1)), ((0, 2), (1, 2)))
# Sets with planes of tension: those of the principal stresses that are cut off beside some pairs.
# The last one is the apex, where there is one.
CUT: tuple[Acting, ...] = (
    *(((), (0,)), ((), (0, 1)), (((0, 2),), (0,)), (((0, 2), (0, 1)), (0,))),
    *((((0, 2),), (0, 1)), (((0, 2), (1, 2)), (0,)), ((), (0, 1, 2))),
)


@dataclass(frozen=True)
class Pyramid:
    """Elasticity, yield surface and returns to it by each set of planes.

    Attributes
    ----------
    elastic
        (3, 3) principal stresses from principal strains (Pa).
    shear
        Shear modulus (Pa).
    slope, strength
        ``sin phi`` and ``2 c cos phi`` (Pa).
    tension
        Largest principal stress (Pa): the cut-off, or the apex; infinite where there is neither.
    matrix, vector
        (k, 3, 3) and (k, 3) returned stress of each set.
    flow, start
        (k, 3, 3) and (k, 3): multipliers of its planes are ``flow @ trial - start``, in Pa; zero
        where it has fewer planes.
    """

    elastic: Floats
    shear: float
    slope: float
    strength: float
    tension: float
    matrix: Floats
    vector: Floats
    flow: Floats
    start: Floats

    @classmethod
    def of(
        cls, elasticity: tuple[float, float], strength: tuple[float, float, float, float]
    ) -> Self:
        """Return that of Young's modulus and Poisson's ratio, and of the strength.

        ``strength`` is cohesion, friction angle, dilation angle and the tension cut-off.
        """
        (e, nu), (cohesion, friction, dilation, cut) = elasticity, strength
        shear, lame = e / 2 / (1 + nu), e * nu / (1 + nu) / (1 - 2 * nu)
        elastic = lame * np.ones((3, 3)) + 2 * shear * np.eye(3)
        whole = 2 * cohesion * np.cos(friction)
        apex = cohesion / np.tan(friction) if friction > 0 else np.inf
        tension = min(apex, cut)
        sets: list[Acting] = [(pairs, ()) for pairs in CONE]
        if np.isfinite(tension):
            sets += CUT
        parts = [
            _return(elastic, shear, one, (friction, dilation), (whole, tension)) for one in sets
        ]
        fixed = (np.array(part) for part in zip(*parts, strict=True))
        return cls(elastic, shear, float(np.sin(friction)), float(whole), tension, *fixed)

    @cached_property
    def whole(self) -> Floats:
        """(4, 4) stresses (xx, yy, xy, zz) from strains (xx, yy, 2 xy, zz) in plane strain (Pa)."""
        found, normal = np.zeros((4, 4)), np.array([0, 1, 3])
        found[np.ix_(normal, normal)], found[2, 2] = self.elastic, self.shear
        return found

    def size(self, stress: Floats) -> Floats:
        """Return what rounding of principal stresses (m, 3) is a share of, (m,) in Pa."""
        return np.asarray(_ends(np.abs(stress))[0] + self.strength)

    def flows(self, stress: Floats) -> Bools:
        """Return where (m,) principal stresses (m, 3) in any order exceed the surface."""
        return np.asarray(self.beyond(stress) > BEYOND * self.size(stress))

    def beyond(self, stress: Floats) -> Floats:
        """Return how far (m,) principal stresses (m, 3) in any order exceed the surface (Pa)."""
        first, last = _ends(stress)
        cone = (first - last) + (first + last) * self.slope - self.strength
        return np.asarray(np.maximum(cone, first - self.tension))


@dataclass(frozen=True)
class ReturnedStress:
    """Stress (m, 4: xx, yy, xy, zz), tangent (m, 3, 3), plastic strain (m, 4: xx, yy, 2 xy, zz)."""

    stress: Floats
    tangent: Floats
    plastic_strain: Floats


def principal_return(strain: Floats, plastic: Floats, pyramid: Pyramid) -> ReturnedStress:
    """Return stresses to the pyramid; ``strain`` (m, 3) whole, ``plastic`` (m, 4) before.

    Only points beyond it are turned to their principal axes.
    """
    elastic = np.column_stack([strain, np.zeros(len(strain))]) - plastic
    stress = elastic @ pyramid.whole
    # One tangent for all points, copied where some flow.
    tangent = np.broadcast_to(pyramid.whole[:3, :3], (len(strain), 3, 3))
    found = ReturnedStress(stress, tangent, plastic.copy())
    flows = np.flatnonzero(pyramid.flows(_values(stress)))
    if len(flows):
        back = _returned(elastic[flows], pyramid)
        tangent = tangent.copy()
        stress[flows], tangent[flows] = back.stress, back.tangent
        found = replace(found, tangent=tangent)
        found.plastic_strain[flows] += back.plastic_strain
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


def _returned(elastic: Floats, pyramid: Pyramid) -> ReturnedStress:
    """Return stresses of points beyond the pyramid, and by how much their plastic strain grows.

    ``elastic`` (m, 4: xx, yy, 2 xy, zz) are their strains before.
    """
    principal, angle = _principal(elastic * np.array([1.0, 1.0, 0.5, 1.0]))
    trial = principal @ pyramid.elastic
    order = np.argsort(-trial, axis=1, kind="stable")
    found, tangent = _sorted_return(np.take_along_axis(trial, order, axis=1), pyramid)
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
    return ReturnedStress(back, whole, elastic - kept)


def _sorted_return(trial: Floats, pyramid: Pyramid) -> tuple[Floats, Floats]:
    """Sorted principal stresses (m, 3) back at the surface, and their tangent (m, 3, 3)."""
    found, tangent = trial.copy(), np.tile(pyramid.elastic, (len(trial), 1, 1))
    least, size = np.full(len(trial), np.inf), pyramid.size(trial)
    for number, matrix in enumerate(pyramid.matrix):  # three to ten sets of planes
        stress = trial @ matrix.T + pyramid.vector[number]
        back = pyramid.start[number] - trial @ pyramid.flow[number].T
        wrong = np.maximum(pyramid.beyond(stress), back.max(axis=1))
        better = wrong < least - BEYOND * size
        least = np.where(better, wrong, least)
        found[better], tangent[better] = stress[better], matrix @ pyramid.elastic
    return found, tangent


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


def _return(
    elastic: Floats,
    shear: float,
    acting: Acting,
    angles: tuple[float, float],
    strength: tuple[float, float],
) -> tuple[Floats, Floats, Floats, Floats]:
    """Return matrix and vector of the stress, and of the multipliers, of one set of planes."""
    (pairs, cut), (friction, dilation) = acting, angles
    slopes = np.sin(friction), np.sin(dilation)
    tensile = [np.eye(3)[one] for one in cut]
    normal, way = (
        np.array([*(_plane(pair, slope) for pair in pairs), *tensile]) for slope in slopes
    )
    limit = np.array([strength[0]] * len(pairs) + [strength[1]] * len(cut))
    flow = elastic @ way.T
    inverse = np.linalg.inv(normal @ flow)
    back = flow @ inverse
    multiplier, start = np.zeros((3, 3)), np.zeros(3)
    multiplier[: len(limit)], start[: len(limit)] = inverse @ normal, inverse @ limit
    return np.eye(3) - back @ normal, back @ limit, shear * multiplier, shear * start


def _plane(pair: tuple[int, int], slope: float) -> Floats:
    """Gradient (3,) of ``(si - sj) + (si + sj) slope``."""
    found = np.zeros(3)
    found[pair[0]], found[pair[1]] = 1 + slope, slope - 1
    return found
