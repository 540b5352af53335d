"""Elements on which every function is a polynomial, integrated from the element's moments."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from covers.approximation.groups.element_group import ElementGroup, one_cover
from integration.arrays import Floats, Ints
from integration.monomials import count, differentiate, evaluate, exponents
from integration.polygons import Polygons
from integration.rules import PointRule, polygon_rule

# Points evaluated at once.
POINTS_AT_ONCE = 8192


@dataclass(frozen=True)
class PolynomialGroup(ElementGroup):
    """Elements on which every ``phi_s`` is a polynomial, integrated from the element's moments.

    Attributes
    ----------
    degree
        Degree of the polynomials.
    table
        (d, S, K) coefficients over the monomials of ``matrix (x - origin)``.
    local
        (d, S, K) coefficients of the functions without their weights, of degree ``local_degree``.
    cover
        (S,) position of the cover of each function among those of an element.
    origin, matrix
        (n, 2) and (d, 2, 2) the elements' local coordinates.
    moments
        (d, count(2 degree)) integrals of the monomials over the elements.
    """

    degree: int
    table: Floats
    local_degree: int
    local: Floats
    cover: Ints
    origin: Floats
    matrix: Floats
    moments: Floats

    @property
    def shape_degree(self) -> int:
        return self.degree

    @property
    def trace_degree(self) -> int:
        return self.degree

    @property
    def weighted(self) -> bool:
        return self.degree > self.local_degree

    @property
    def slots(self) -> Ints:
        return self.cover

    @property
    def carriers(self) -> Ints:
        return self.cover

    def values(self, index: Ints, points: Floats) -> Floats:
        return self._evaluate(self.table, self.degree, index, points)

    def gradients(self, index: Ints, points: Floats) -> Floats:
        lower = max(self.degree - 1, 0)
        parts = [self._evaluate(d, lower, index, points) for d in self._derivatives]
        return np.stack(parts, axis=-1)

    def products(self) -> Floats:
        return self._contract(self.table, self.table, self.degree)

    def lumped_products(self) -> Floats:
        index = product_index(self.degree)[:, : count(self.local_degree)]
        found = self.table @ self.moments[:, index] @ np.swapaxes(self.local, 1, 2)
        return one_cover(found, self.cover)

    def gradient_products(self) -> Floats:
        x, y = self._derivatives
        lower = max(self.degree - 1, 0)
        return np.stack([self._contract(a, b, lower) for a, b in ((x, x), (x, y), (y, y))], axis=1)

    def value_gradients(self, of: Ints) -> Floats:
        slopes = count(max(self.degree - 1, 0))
        gram = self.moments[:, product_index(self.degree)[:, :slopes]]
        weighted = self.table[:, of] @ gram
        return np.stack([weighted @ np.swapaxes(d, 1, 2) for d in self._derivatives], axis=-1)

    def integrals(self) -> Floats:
        return self._integrate(self.table)

    def gradient_integrals(self) -> Floats:
        return np.stack([self._integrate(d) for d in self._derivatives], axis=-1)

    def gradient_rule(self, polygons: Polygons) -> PointRule:
        """See `ElementGroup.gradient_rule`: one point where gradients are constant, else Gauss."""
        own = polygons.take(self.elements)
        if self.degree > 1:
            return polygon_rule(own, 2 * (self.degree - 1), alike=True)
        return PointRule(own.centroids, own.areas, np.arange(len(own)))

    @cached_property
    def _derivatives(self) -> tuple[Floats, Floats]:
        local = [differentiate(self.table, self.degree, axis) for axis in (0, 1)]
        x, y = (
            self.matrix[:, 0, axis, None, None] * local[0]
            + self.matrix[:, 1, axis, None, None] * local[1]
            for axis in (0, 1)
        )
        return x, y

    def _evaluate(self, table: Floats, degree: int, index: Ints, points: Floats) -> Floats:
        shape = self.shape[index]
        xi = np.einsum("mij,mj->mi", self.matrix[shape], points - self.origin[index])
        out = np.empty((len(index), table.shape[1]))
        for begin in range(
            0, len(index), POINTS_AT_ONCE
        ):  # rows of tables are large: a chunk at a time
            part = slice(begin, begin + POINTS_AT_ONCE)
            monomials = evaluate(xi[part], degree)
            out[part] = np.einsum("msk,mk->ms", table[shape[part]], monomials)
        return out

    def _integrate(self, table: Floats) -> Floats:
        return np.asarray(np.einsum("nsk,nk->ns", table, self.moments[:, : table.shape[2]]))

    def _contract(self, left: Floats, right: Floats, degree: int) -> Floats:
        gram = self.moments[:, product_index(degree)]
        return np.asarray(left @ gram @ np.swapaxes(right, 1, 2))


def product_index(degree: int) -> Ints:
    """Return the numbers (K, K) of products of monomials up to ``degree`` in the graded order."""
    powers = exponents(degree)
    total = powers[:, None, :] + powers[None, :, :]
    order = total.sum(axis=2)
    # Graded order: count(order - 1) monomials come before, then descending powers of x.
    before = order * (order + 1) // 2
    return np.asarray(before + total[:, :, 1])
