"""Return of Mohr-Coulomb plasticity in principal stresses, all points at once.

Planes of the pyramid are linear and nothing hardens: on a plane, an edge or the apex the returned
principal stresses, sorted from the largest tension, are a fixed matrix of the trial's and a fixed
vector (de Souza Neto, Peric and Owen 2008, chapter 8).
"""

from dataclasses import dataclass
from typing import Self

import numpy as np

from integration.arrays import Floats

# Share of the stresses by which rounding leaves a point beyond the yield surface: it is elastic.
BEYOND = 1e-10
# In-plane principal stresses closer than this share of the largest have no direction.
EQUAL = 1e-12
# Pairs of sorted principal stresses whose planes act: a plane, and the edges where the smaller two
# or the larger two are equal.
CASES = (((0, 2),), ((0, 2), (0, 1)), ((0, 2), (1, 2)))


@dataclass(frozen=True)
class Pyramid:
    """Elasticity, yield surface and returns.

    Attributes
    ----------
    elastic
        (3, 3) principal stresses from principal strains (Pa).
    shear
        Shear modulus (Pa).
    slope, strength
        ``sin phi`` and ``2 c cos phi`` (Pa).
    matrix, vector
        (4, 3, 3) and (4, 3) returned stress of plane, two edges and apex.
    """

    elastic: Floats
    shear: float
    slope: float
    strength: float
    matrix: Floats
    vector: Floats

    @classmethod
    def of(cls, elasticity: tuple[float, float], strength: tuple[float, float, float]) -> Self:
        """Return that of Young's modulus, Poisson's ratio, cohesion and both angles."""
        (e, nu), (cohesion, friction, dilation) = elasticity, strength
        shear, lame = e / 2 / (1 + nu), e * nu / (1 + nu) / (1 - 2 * nu)
        elastic = lame * np.ones((3, 3)) + 2 * shear * np.eye(3)
        whole = 2 * cohesion * np.cos(friction)
        matrix, vector = np.zeros((4, 3, 3)), np.zeros((4, 3))
        for number, pairs in enumerate(CASES):
            normal = np.array([_plane(pair, np.sin(friction)) for pair in pairs])
            flow = elastic @ np.array([_plane(pair, np.sin(dilation)) for pair in pairs]).T
            back = flow @ np.linalg.inv(normal @ flow)
            matrix[number], vector[number] = np.eye(3) - back @ normal, back.sum(axis=1) * whole
        vector[3] = cohesion / np.tan(friction) if friction > 0 else np.inf
        return cls(elastic, shear, float(np.sin(friction)), float(whole), matrix, vector)


@dataclass(frozen=True)
class ReturnedToPyramid:
    """Stress (m, 4: xx, yy, xy, zz), tangent (m, 3, 3), plastic strain (m, 4: xx, yy, 2 xy, zz)."""

    stress: Floats
    tangent: Floats
    plastic_strain: Floats


def principal_return(strain: Floats, plastic: Floats, pyramid: Pyramid) -> ReturnedToPyramid:
    """Return stresses to the pyramid; ``strain`` (m, 3) whole, ``plastic`` (m, 4) before."""
    elastic = np.column_stack([strain, np.zeros(len(strain))]) - plastic
    middle, half = (elastic[:, 0] + elastic[:, 1]) / 2, (elastic[:, 0] - elastic[:, 1]) / 2
    radius, angle = np.hypot(half, elastic[:, 2] / 2), np.arctan2(elastic[:, 2] / 2, half) / 2
    principal = np.stack([middle + radius, middle - radius, elastic[:, 3]], axis=1)
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
    same = (found == np.take_along_axis(trial, order, axis=1)).all(axis=1)
    return ReturnedToPyramid(
        back, whole, np.where(same[:, None], plastic, plastic + elastic - kept)
    )


def _sorted_return(trial: Floats, pyramid: Pyramid) -> tuple[Floats, Floats]:
    """Sorted principal stresses (m, 3) back at the surface, and their tangent (m, 3, 3)."""
    first, last = trial[:, 0], trial[:, 2]
    size = np.abs(trial).max(axis=1) + pyramid.strength
    beyond = (first - last) + (first + last) * pyramid.slope - pyramid.strength
    plane, right, left = (
        trial @ matrix.T + vector
        for matrix, vector in zip(pyramid.matrix[:3], pyramid.vector[:3], strict=True)
    )
    case = np.where(plane[:, 2] > plane[:, 1], 1, np.where(plane[:, 1] > plane[:, 0], 2, 0))
    over = (right[:, 0] < right[:, 2]) & (case == 1) | (left[:, 0] < left[:, 2]) & (case == 2)
    case = np.where(over, 3, case)
    flows = beyond > BEYOND * size
    found = np.where(
        flows[:, None],
        np.einsum("mij,mj->mi", pyramid.matrix[case], trial)
        + np.where(flows[:, None], pyramid.vector[case], 0.0),
        trial,
    )
    tangent = np.where(
        flows[:, None, None], pyramid.matrix[case] @ pyramid.elastic, pyramid.elastic
    )
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


def _plane(pair: tuple[int, int], slope: float) -> Floats:
    """Gradient (3,) of ``(si - sj) + (si + sj) slope``."""
    found = np.zeros(3)
    found[pair[0]], found[pair[1]] = 1 + slope, slope - 1
    return found
