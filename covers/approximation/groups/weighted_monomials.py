"""Element groups of polynomial weights: weights times local functions in element coordinates."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from covers.approximation.groups.physical_covers import (
    PhysicalCovers,
    combined,
    covers_of,
    unknowns_of,
)
from covers.approximation.groups.polynomial_group import PolynomialGroup
from covers.local_functions.polynomials import LocalFunctions
from covers.small_matrices import inverses
from integration.arrays import Floats, Ints
from integration.moments import moments
from integration.monomials import affine, count, multiply
from integration.polygons import Polygons


@dataclass(frozen=True)
class Weights:
    """Polynomial weights: coefficients (d, k, K) in element coordinates."""

    degree: int
    table: Floats


@dataclass(frozen=True)
class Shapes:
    """Elements of a group and their distinct shapes.

    Attributes
    ----------
    elements
        (n,) indices into the manifold's elements.
    shape
        (n,) shape of each.
    first
        (d,) first element of the group of each shape.
    origin
        (n, 2) origin of the coordinates of each element (m).
    matrix
        (d, 2, 2) matrix of the coordinates, common to all elements of a shape (1/m).
    """

    elements: Ints
    shape: Ints
    first: Ints
    origin: Floats
    matrix: Floats


def polynomial_group(
    shapes: Shapes,
    polygons: Polygons,
    active: Ints,
    weights: Weights,
    functions: Sequence[LocalFunctions],
    covers: PhysicalCovers,
) -> PolynomialGroup:
    """Return the group of elements on which ``k`` covers are active.

    Parameters
    ----------
    shapes
        The elements.
    polygons
        The polygon of the first element of each shape.
    active
        (n, k) physical covers of each element.
    weights
        The covers' weights on the first element of each shape.
    functions
        Local functions of the k covers, the same for all elements.
    covers
        All physical covers.
    """
    highest = max(item.degree for item in functions)
    degree = weights.degree + highest
    parts, plain = [], []
    for slot, item in enumerate(functions):  # three or four covers
        local = _local_functions(item, covers, active[shapes.first, slot], shapes)
        weight = weights.table[:, slot, None]
        table = multiply(weight, weights.degree, local, item.degree)
        parts.append(np.pad(table, ((0, 0), (0, 0), (0, count(degree) - table.shape[2]))))
        plain.append(np.pad(local, ((0, 0), (0, 0), (0, count(highest) - local.shape[2]))))
    return PolynomialGroup(
        elements=shapes.elements,
        unknowns=unknowns_of(functions, covers, active),
        combination=combined(functions),
        shape=shapes.shape,
        degree=degree,
        table=np.concatenate(parts, axis=1),
        local_degree=highest,
        local=np.concatenate(plain, axis=1),
        cover=covers_of(functions),
        origin=shapes.origin,
        matrix=shapes.matrix,
        moments=_moments(polygons, 2 * degree, shapes),
    )


def _moments(polygons: Polygons, degree: int, shapes: Shapes) -> Floats:
    """Moments (d, K) in element coordinates, in which slender elements are of unit size."""
    owner = polygons.polygon_of_point
    origin = shapes.origin[shapes.first]
    local = np.einsum("pij,pj->pi", shapes.matrix[owner], polygons.points - origin[owner])
    found = moments(polygons.with_points(local), degree, np.zeros(2))
    return np.asarray(found / np.abs(np.linalg.det(shapes.matrix))[:, None])


def _local_functions(
    functions: LocalFunctions, covers: PhysicalCovers, cover: Ints, shapes: Shapes
) -> Floats:
    """Monomials of covers (d,) as polynomials (d, S, K) of the elements' coordinates."""
    d, n_functions, size = len(cover), functions.n_functions, count(functions.degree)
    matrix = covers.matrix[cover] @ inverses(shapes.matrix)
    away = shapes.origin[shapes.first] - covers.centre[cover]
    shift = np.einsum("nij,nj->ni", covers.matrix[cover], away)
    monomials = np.tile(np.eye(n_functions, size), (d, 1))
    moved = affine(
        monomials,
        functions.degree,
        np.repeat(matrix, n_functions, axis=0),
        np.repeat(shift, n_functions, axis=0),
    )
    return moved.reshape(d, n_functions, size)
