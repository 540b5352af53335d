"""Weighted polynomials, and weighted singular functions on covers near singular points."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TypeVar

import numpy as np

from covers.approximation.groups.quadrature_group import Fields
from covers.approximation.groups.weighted_fields import WeightedFields
from covers.approximation.singular.enrichment import Enrichment, singular_fields, singular_values
from integration.arrays import Floats, Ints

T = TypeVar("T")


@dataclass(frozen=True)
class EnrichedFields(Fields):
    """Weighted polynomials of all covers, then weighted singular functions of some.

    Each vector function gives two scalar ones, for its x and its y component.

    Attributes
    ----------
    base
        Polynomials.
    slots
        (p,) positions of covers with singular functions, once for each of their points.
    enrichments
        All singular points.
    which, bearing
        (n, p) singular point of each, and its branch of the angle (`singular_fields`).
    """

    base: WeightedFields
    slots: Ints
    enrichments: Sequence[Enrichment]
    which: Ints
    bearing: Floats

    @property
    def cover(self) -> Ints:
        each = 2 * self._number
        return np.concatenate([self.base.cover, np.repeat(self.slots, each)])

    @property
    def monomial_slots(self) -> Ints:
        extra = len(self.cover) - len(self.base.cover)
        return np.concatenate([self.base.cover, np.full(extra, -1, dtype=np.int64)])

    def local_values(self, index: Ints, points: Floats) -> Floats:
        parts = self._of_slots(partial(self._values, index, points), index)
        return np.concatenate([self.base.local_values(index, points), *parts], axis=1)

    def values(self, index: Ints, points: Floats) -> Floats:
        weight = self.base.weight_values(index, points)
        singular = self._of_slots(partial(self._values, index, points), index)
        parts = [weight[:, slot, None] * f for slot, f in zip(self.slots, singular, strict=True)]
        return np.concatenate([self.base.values(index, points), *parts], axis=1)

    def evaluate(self, index: Ints, points: Floats) -> tuple[Floats, Floats]:
        values, gradients = self.base.evaluate(index, points)
        weight, slope = self.base.weights(index, points)
        parts, slopes = [values], [gradients]
        singular = self._of_slots(partial(self._fields, index, points), index)
        for slot, (f, df) in zip(self.slots, singular, strict=True):  # a few for each cover
            w, dw = weight[:, slot, None], slope[:, slot, None, :]
            parts.append(w * f)
            slopes.append(dw * f[:, :, None] + w[:, :, None] * df)
        return np.concatenate(parts, axis=1), np.concatenate(slopes, axis=1)

    def _of_slots(self, found: Callable[[int], T], index: Ints) -> list[T]:
        """What is found for each slot: once for covers about the same points, on one branch."""
        parts: list[T] = []
        for one in range(len(self.slots)):
            same = next((other for other in range(one) if self._alike(index, one, other)), None)
            parts.append(found(one) if same is None else parts[same])
        return parts

    def _alike(self, index: Ints, one: int, other: int) -> bool:
        both = (self.which, self.bearing)
        return all(np.array_equal(of[index, one], of[index, other]) for of in both)

    def _values(self, index: Ints, points: Floats, one: int) -> Floats:
        """Singular functions (m, S) of a slot without its weight."""
        f = np.zeros((len(index), 2 * self._number))
        for rows, item, bearing in self._about(index, one):
            f[rows] = singular_values(item, points[rows], bearing).reshape(len(rows), -1)
        return f

    def _fields(self, index: Ints, points: Floats, one: int) -> tuple[Floats, Floats]:
        """The same, and their gradients (m, S, 2)."""
        f, df = (np.zeros((len(index), 2 * self._number, *more)) for more in ((), (2,)))
        for rows, item, bearing in self._about(index, one):
            value, gradient = singular_fields(item, points[rows], bearing)
            f[rows] = value.reshape(len(rows), -1)
            df[rows] = gradient.reshape(len(rows), -1, 2)
        return f, df

    def _about(self, index: Ints, one: int) -> Iterator[tuple[Ints, Enrichment, Floats]]:
        """Yield the singular points of a slot, each with rows and their branches of the angle."""
        which, bearing = self.which[index, one], self.bearing[index, one]
        for point in np.unique(which):  # a handful of singular points
            rows = np.flatnonzero(which == point)
            yield rows, self.enrichments[point], bearing[rows]

    @property
    def _number(self) -> int:
        """Number of vector functions about a point."""
        return self.enrichments[0].functions.number
