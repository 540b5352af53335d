"""Element groups from polynomial weights: weight times local function, in element coordinates."""

from dataclasses import dataclass

import numpy as np

from covers.element_groups import PolynomialGroup
from covers.local_functions import LocalFunctions
from integration.arrays import Floats, Ints
from integration.moments import moments
from integration.monomials import affine, count, multiply
from integration.polygons import Polygons


@dataclass(frozen=True)
class PhysicalCovers:
    """Physical covers as arrays.

    Attributes
    ----------
    patch, body
        (C,) mathematical patch and body.
    centre, length
        (C, 2) and (C,) origin and scale of the local functions.
    """

    patch: Ints
    body: Ints
    centre: Floats
    length: Floats


@dataclass(frozen=True)
class Weights:
    """Polynomial weights on elements: coefficients (n, k, K) in the elements' coordinates."""

    degree: int
    table: Floats


def polynomial_group(
    elements: Ints,
    polygons: Polygons,
    active: Ints,
    weights: Weights,
    functions: LocalFunctions,
    covers: PhysicalCovers,
    first_unknown: Ints,
    origin: Floats,
    scale: Floats,
) -> PolynomialGroup:
    """Build the group of elements on which ``k`` covers with equal functions are active.

    Parameters
    ----------
    elements
        (n,) element indices; ``polygons`` holds their n polygons.
    active
        (n, k) physical covers of each element.
    weights
        The covers' weights on the elements.
    functions, covers, first_unknown
        Local functions; all physical covers; (C,) first unknown of each.
    origin, scale
        (n, 2), (n,) coordinates in which tables and moments are stored.
    """
    n, k = active.shape
    local = _local_functions(functions, covers, active, origin, scale)
    n_functions = functions.n_functions
    weight = np.repeat(weights.table.reshape(n * k, -1), n_functions, axis=0)
    product = multiply(weight, weights.degree, local, functions.degree)
    degree = weights.degree + functions.degree
    unknowns = first_unknown[active][:, :, None] + np.arange(functions.n_unknowns)
    return PolynomialGroup(
        elements=elements,
        unknowns=unknowns.reshape(n, -1),
        combination=_block_diagonal(functions.combination, k),
        degree=degree,
        table=product.reshape(n, k * n_functions, -1),
        origin=origin,
        scale=scale,
        moments=moments(polygons, 2 * degree, origin, scale),
    )


def _local_functions(
    functions: LocalFunctions, covers: PhysicalCovers, active: Ints, origin: Floats, scale: Floats
) -> Floats:
    """Monomials of the covers as polynomials of the elements' coordinates (n k S, K)."""
    n, k = active.shape
    n_functions, size = functions.n_functions, count(functions.degree)
    cover = active.ravel()
    length = covers.length[cover]
    stretch = np.repeat(scale, k) / length
    shift = (np.repeat(origin, k, axis=0) - covers.centre[cover]) / length[:, None]
    matrix = np.repeat((stretch[:, None, None] * np.eye(2)), n_functions, axis=0)
    monomials = np.tile(np.eye(n_functions, size), (n * k, 1))
    return affine(monomials, functions.degree, matrix, np.repeat(shift, n_functions, axis=0))


def _block_diagonal(combination: Floats | None, copies: int) -> Floats | None:
    return None if combination is None else np.kron(np.eye(copies), combination)
