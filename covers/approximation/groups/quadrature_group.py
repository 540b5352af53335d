"""Element groups integrated by quadrature: weights or local functions are not polynomials."""

from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from covers.approximation.groups.element_group import ElementGroup, one_cover
from integration.arrays import Floats, Ints
from integration.polygons import Polygons
from integration.rules import PointRule

# Points whose functions are kept in memory at once.
FUNCTIONS_AT_ONCE = 40_000


class Fields(ABC):
    """Scalar functions ``phi_s`` on elements, evaluated at points."""

    @property
    def extends(self) -> bool:
        """Whether they can be extended beyond the element."""
        return False

    @property
    def degree(self) -> int:
        """Degree of polynomials that approximate them on an element."""
        return 2

    @property
    @abstractmethod
    def cover(self) -> Ints:
        """(S,) position of the cover of each function among those of an element."""

    @property
    def monomial_slots(self) -> Ints:
        """(S,) the same for weighted monomials; -1 for other functions."""
        return self.cover

    @abstractmethod
    def local_values(self, index: Ints, points: Floats) -> Floats:
        """Values (m, S) of the functions without their weights."""

    def values(self, index: Ints, points: Floats) -> Floats:
        """Values (m, S) at points (m, 2) in elements ``index`` (m,)."""
        return self.evaluate(index, points)[0]

    @abstractmethod
    def evaluate(self, index: Ints, points: Floats) -> tuple[Floats, Floats]:
        """Values (m, S) and gradients (m, S, 2) at points (m, 2) in elements ``index`` (m,)."""


@dataclass(frozen=True)
class QuadratureGroup(ElementGroup):
    """Elements whose functions are evaluated at quadrature points.

    Attributes
    ----------
    fields
        The functions.
    rule
        Points and weights; ``owner`` counts within the group.
    first
        (d,) first element of the group of each shape, which is integrated.
    """

    fields: Fields
    rule: PointRule
    first: Ints

    @property
    def shape_degree(self) -> int:
        return self.fields.degree

    @property
    def extends(self) -> bool:
        return self.fields.extends

    @property
    def slots(self) -> Ints:
        return self.fields.monomial_slots

    @property
    def carriers(self) -> Ints:
        return self.fields.cover

    def values(self, index: Ints, points: Floats) -> Floats:
        return self.fields.values(index, points)

    def gradients(self, index: Ints, points: Floats) -> Floats:
        return self.evaluate(index, points)[1]

    def evaluate(self, index: Ints, points: Floats) -> tuple[Floats, Floats]:
        return self.fields.evaluate(index, points)

    def products(self) -> Floats:
        return self._integrals[0]

    def lumped_products(self) -> Floats:
        found = np.zeros((self.n_shapes, self._size, self._size))
        for some, points in self._batches():
            value, _, weight = self._at(some, points)
            flat = np.repeat(self.first[some], points.shape[1])
            local = self.fields.local_values(flat, self.rule.points[points.ravel()])
            heavy = weight[:, :, None] * value
            found[some] = np.swapaxes(heavy, 1, 2) @ local.reshape(value.shape)
        return one_cover(found, self.fields.cover)

    def gradient_products(self) -> Floats:
        return self._integrals[1]

    def value_gradients(self, of: Ints) -> Floats:
        found = np.zeros((self.n_shapes, len(of), self._size, 2))
        for some, points in self._batches():
            value, slope, weight = self._at(some, points)
            heavy = np.swapaxes(weight[:, :, None] * value[:, :, of], 1, 2)
            found[some] = np.stack([heavy @ slope[..., 0], heavy @ slope[..., 1]], axis=-1)
        return found

    def integrals(self) -> Floats:
        return self._integrals[2]

    def gradient_integrals(self) -> Floats:
        return self._integrals[3]

    def gradient_rule(self, polygons: Polygons) -> PointRule:
        """See `ElementGroup.gradient_rule`: the points of all its integrals."""
        return self.rule

    @cached_property
    def _integrals(self) -> tuple[Floats, Floats, Floats, Floats]:
        n, size = self.n_shapes, self._size
        products, gradient_products = np.zeros((n, size, size)), np.zeros((n, 3, size, size))
        integrals, gradient_integrals = np.zeros((n, size)), np.zeros((n, size, 2))
        for some, points in self._batches():
            value, slope, weight = self._at(some, points)
            heavy = weight[:, :, None] * value
            products[some] = np.swapaxes(heavy, 1, 2) @ value
            x, y = slope[..., 0], slope[..., 1]
            wx, wy = (np.swapaxes(weight[:, :, None] * g, 1, 2) for g in (x, y))
            gradient_products[some] = np.stack([wx @ x, wx @ y, wy @ y], axis=1)
            integrals[some] = heavy.sum(axis=1)
            gradient_integrals[some] = np.einsum("nq,nqsj->nsj", weight, slope)
        return products, gradient_products, integrals, gradient_integrals

    def _batches(self) -> Iterator[tuple[Ints, Ints]]:
        """Shapes (k,) and their points (k, q), in batches of equal numbers of points."""
        of_all = np.bincount(self.rule.owner, minlength=len(self.elements))
        begin, counts = (np.cumsum(of_all) - of_all)[self.first], of_all[self.first]
        for number in np.unique(counts[counts > 0]):  # shapes of equal numbers of points
            alike = np.flatnonzero(counts == number)
            most = max(FUNCTIONS_AT_ONCE // int(number), 1)
            for first in range(0, len(alike), most):
                some = alike[first : first + most]
                yield some, begin[some, None] + np.arange(number)

    def _at(self, shapes: Ints, points: Ints) -> tuple[Floats, Floats, Floats]:
        n, q = points.shape
        flat, element = points.ravel(), np.repeat(self.first[shapes], q)
        value, slope = self.fields.evaluate(element, self.rule.points[flat])
        size = value.shape[1]
        return (
            value.reshape(n, q, size),
            slope.reshape(n, q, size, 2),
            self.rule.weights[flat].reshape(n, q),
        )

    @property
    def _size(self) -> int:
        if self.combination is None:
            return int(self.unknowns.shape[1]) // 2
        return int(self.combination.shape[0]) // 2
