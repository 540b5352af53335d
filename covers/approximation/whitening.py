"""Local coordinates fitted to the cut parts of elements and covers (whitening).

On a sliver, the polynomials of a cover are nearly dependent in coordinates scaled by the cell. In
``xi = Sigma^-1/2 (x - c) / 2``, with the centroid ``c`` and the covariance ``Sigma`` of the part
that is left, they are as independent as on a square for any shape: the space is the same, and the
conditioning is bounded (Schweitzer 2011 states why local coordinates suffice).
"""

from dataclasses import dataclass

import numpy as np

from covers.small_matrices import inverses
from integration.arrays import Floats, Ints
from integration.moments import moments
from integration.polygons import Polygons, diameters

# Correlations above this along the principal axes are rounding.
CORRELATED = 0.99


@dataclass(frozen=True)
class LocalFrames:
    """Coordinates ``matrix (x - centre)``, with centres (n, 2) (m) and matrices (n, 2, 2) (1/m)."""

    centre: Floats
    matrix: Floats


@dataclass(frozen=True)
class Spread:
    """Area (n,), centroid (n, 2) and root ``F`` (n, 2, 2) of the covariance ``F F^T``."""

    area: Floats
    centre: Floats
    root: Floats


def element_frames(polygons: Polygons) -> LocalFrames:
    """Return coordinates along the principal axes, between -1 and 1 over each polygon."""
    centre = polygons.centroids
    second = moments(polygons, 2, scale=diameters(polygons))[:, [[3, 4], [4, 5]]]
    axes = np.swapaxes(np.linalg.eigh(second / second.max(axis=(1, 2), keepdims=True))[1], 1, 2)
    owner = polygons.polygon_of_point
    turned = np.einsum("pij,pj->pi", axes[owner], polygons.points - centre[owner])
    half = np.maximum.reduceat(np.abs(turned), polygons.first_point, axis=0)
    return LocalFrames(centre, axes / half[:, :, None])


def element_spread(polygons: Polygons, frames: LocalFrames) -> Spread:
    """Return covariances as roots, which stay accurate for slender polygons."""
    owner = polygons.polygon_of_point
    away = polygons.points - frames.centre[owner]
    local = polygons.with_points(np.einsum("pij,pj->pi", frames.matrix[owner], away))
    found = moments(local, 2)
    root = np.linalg.cholesky(found[:, [[3, 4], [4, 5]]] / found[:, 0, None, None])
    return Spread(polygons.areas, polygons.centroids, inverses(frames.matrix) @ root)


def cover_frames(parts: Spread, element: Ints, cover: Ints, n_covers: int) -> LocalFrames:
    """Return whitened coordinates of covers from pairs (p,) of an element and a cover of it."""
    area, root = parts.area[element], parts.root[element]
    total = np.bincount(cover, area, minlength=n_covers)
    share = area / total[cover]
    centre = _sums(share[:, None] * parts.centre[element], cover, n_covers)
    away = parts.centre[element] - centre[cover]
    axes = np.swapaxes(np.linalg.eigh(_covariance(share, away, root, cover, n_covers))[1], 1, 2)
    # The axes are accurate, the smaller variance is not: compute it again along the axes.
    turned = np.einsum("pij,pj->pi", axes[cover], away)
    covariance = _covariance(share, turned, axes[cover] @ root, cover, n_covers)
    deviation = np.sqrt(np.stack([covariance[:, 0, 0], covariance[:, 1, 1]], axis=1))
    correlation = covariance[:, 0, 1] / deviation.prod(axis=1)
    whitening = _root_of_inverse(np.where(np.abs(correlation) < CORRELATED, correlation, 0.0))
    return LocalFrames(centre, whitening @ (axes / deviation[:, :, None]) / 2)


def _covariance(share: Floats, away: Floats, root: Floats, cover: Ints, n: int) -> Floats:
    inner = away[:, :, None] * away[:, None, :] + root @ np.swapaxes(root, 1, 2)
    return _sums((share[:, None, None] * inner).reshape(-1, 4), cover, n).reshape(n, 2, 2)


def _sums(values: Floats, cover: Ints, n: int) -> Floats:
    columns = [np.bincount(cover, column, minlength=n) for column in values.T]
    return np.stack(columns, axis=1)


def _root_of_inverse(correlation: Floats) -> Floats:
    """``C^-1/2`` of ``C = [[1, r], [r, 1]]``."""
    plus, minus = 1 / np.sqrt(1 + correlation), 1 / np.sqrt(1 - correlation)
    same, other = (plus + minus) / 2, (plus - minus) / 2
    return np.stack([np.stack([same, other], -1), np.stack([other, same], -1)], -2)
