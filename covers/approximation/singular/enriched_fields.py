"""Weighted polynomials, and weighted singular functions on covers near singular points."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from covers.approximation.groups.quadrature_group import Fields
from covers.approximation.groups.weighted_fields import WeightedFields
from covers.approximation.singular.enrichment import Enrichment, singular_fields
from integration.arrays import Floats, Ints


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
        each = 2 * self.enrichments[0].functions.number
        return np.concatenate([self.base.cover, np.repeat(self.slots, each)])

    @property
    def monomial_slots(self) -> Ints:
        extra = len(self.cover) - len(self.base.cover)
        return np.concatenate([self.base.cover, np.full(extra, -1, dtype=np.int64)])

    def local_values(self, index: Ints, points: Floats) -> Floats:
        singular = [self._singular(index, one, points)[0] for one in range(len(self.slots))]
        return np.concatenate([self.base.local_values(index, points), *singular], axis=1)

    def evaluate(self, index: Ints, points: Floats) -> tuple[Floats, Floats]:
        values, gradients = self.base.evaluate(index, points)
        weight, slope = self.base.weights(index, points)
        parts, slopes = [values], [gradients]
        for one, slot in enumerate(self.slots):  # at most a few for each cover of one element
            f, df = self._singular(index, one, points)
            w, dw = weight[:, slot, None], slope[:, slot, None, :]
            parts.append(w * f)
            slopes.append(dw * f[:, :, None] + w[:, :, None] * df)
        return np.concatenate(parts, axis=1), np.concatenate(slopes, axis=1)

    def _singular(self, index: Ints, one: int, points: Floats) -> tuple[Floats, Floats]:
        number = self.enrichments[0].functions.number
        f, df = np.zeros((len(index), 2 * number)), np.zeros((len(index), 2 * number, 2))
        which, bearing = self.which[index, one], self.bearing[index, one]
        for point in np.unique(which):  # a handful of singular points
            rows = np.flatnonzero(which == point)
            value, gradient = singular_fields(self.enrichments[point], points[rows], bearing[rows])
            f[rows] = value.reshape(len(rows), -1)
            df[rows] = gradient.reshape(len(rows), -1, 2)
        return f, df
