"""Covers near a singular point carry its functions besides polynomials."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from covers.approximation.quadrature_groups import Fields
from covers.approximation.weighted_fields import WeightedFields
from covers.cutting.cut_cells import CutCells
from covers.local_functions.singular_functions import SingularFunctions
from integration.arrays import Floats, Ints

NEAR = 1e-9
# Beyond this angle from the bisector points lie near the faces of a crack, where the side of their
# element counts; elements about a wider corner may reach over the bisector's line behind it.
FACES = 0.8 * np.pi


@dataclass(frozen=True)
class Enrichment:
    """Singular functions about one point.

    Attributes
    ----------
    functions
        The functions.
    point, direction
        (2,) singular point (m) and unit vector of the bisector: ahead of a crack, into the
        material at a corner.
    radius
        Covers whose centre is nearer (m) are enriched; those of the elements that touch the
        point always are.
    body
        Only covers of this body; None is all.
    """

    functions: SingularFunctions
    point: Floats
    direction: Floats
    radius: float = 0.0
    body: int | None = None


def enriched_covers(cut: CutCells, patch_centre: Floats, enrichments: Sequence[Enrichment]) -> Ints:
    """Enrichment of each physical cover (C,), the nearest when there are several, or -1."""
    chosen = np.full(cut.n_covers, -1, dtype=np.int64)
    nearest = np.full(cut.n_covers, np.inf)
    centre = patch_centre[cut.cover_patch]
    for number, item in enumerate(enrichments):  # a handful of singular points
        distance = np.hypot(*(centre - item.point).T)
        wanted = distance < item.radius
        wanted[touching_covers(cut, item.point)] = True
        if item.body is not None:
            wanted &= cut.cover_body == item.body
        taken = wanted & (distance < nearest)
        chosen[taken] = number
        nearest[taken] = distance[taken]
    return chosen


def touching_covers(cut: CutCells, point: Floats) -> Ints:
    """Covers of the elements that hold the point in their boxes grown by rounding, and inside."""
    import shapely

    owner = cut.elements.polygon_of_point
    away = np.hypot(*(cut.elements.points - point).T)
    size = np.hypot(*np.ptp(cut.elements.points, axis=0))
    found = np.unique(owner[away <= NEAR * size])
    if not len(found):  # a point inside an element
        low = np.minimum.reduceat(cut.elements.points, cut.elements.first_point, axis=0)
        high = np.maximum.reduceat(cut.elements.points, cut.elements.first_point, axis=0)
        near = np.flatnonzero(((low <= point) & (point <= high)).all(axis=1))
        shapes = cut.elements.take(near).to_shapely()
        found = near[shapely.intersects(shapes, shapely.Point(point))]
    active = cut.covers[found]
    return np.unique(active[active >= 0])


@dataclass(frozen=True)
class EnrichedFields(Fields):
    """Weighted polynomials of all covers, then weighted singular functions of the enriched ones.

    Each vector function gives two scalar ones, for its x and its y component.

    Attributes
    ----------
    base
        Polynomials; the first ``n_enriched`` covers of every element are enriched.
    n_enriched
        Number of enriched covers of every element.
    enrichments
        All singular points.
    which
        (n, n_enriched) enrichment of each enriched cover.
    side
        (n, n_enriched) 1 for elements on the left of the bisector, -1 on the right.
    """

    base: WeightedFields
    n_enriched: int
    enrichments: Sequence[Enrichment]
    which: Ints
    side: Floats

    @property
    def cover(self) -> Ints:
        """See `Fields.cover`."""
        each = 2 * self.enrichments[0].functions.number
        return np.concatenate([self.base.cover, np.repeat(np.arange(self.n_enriched), each)])

    @property
    def monomial_slots(self) -> Ints:
        """See `Fields.monomial_slots`."""
        extra = len(self.cover) - len(self.base.cover)
        return np.concatenate([self.base.cover, np.full(extra, -1, dtype=np.int64)])

    def local_values(self, index: Ints, points: Floats) -> Floats:
        """See `Fields.local_values`."""
        singular = [self._singular(index, slot, points)[0] for slot in range(self.n_enriched)]
        return np.concatenate([self.base.local_values(index, points), *singular], axis=1)

    def evaluate(self, index: Ints, points: Floats) -> tuple[Floats, Floats]:
        """See `Fields.evaluate`."""
        values, gradients = self.base.evaluate(index, points)
        weight, slope = self.base.weights(index, points)
        parts, slopes = [values], [gradients]
        for slot in range(self.n_enriched):  # at most the covers of one element
            f, df = self._singular(index, slot, points)
            w, dw = weight[:, slot, None], slope[:, slot, None, :]
            parts.append(w * f)
            slopes.append(dw * f[:, :, None] + w[:, :, None] * df)
        return np.concatenate(parts, axis=1), np.concatenate(slopes, axis=1)

    def _singular(self, index: Ints, slot: int, points: Floats) -> tuple[Floats, Floats]:
        number = self.enrichments[0].functions.number
        f, df = np.zeros((len(index), 2 * number)), np.zeros((len(index), 2 * number, 2))
        which, side = self.which[index, slot], self.side[index, slot]
        for one in np.unique(which):  # a handful of singular points
            rows = np.flatnonzero(which == one)
            value, gradient = singular_fields(self.enrichments[one], points[rows], side[rows])
            f[rows] = value.reshape(len(rows), -1)
            df[rows] = gradient.reshape(len(rows), -1, 2)
        return f, df


def singular_fields(item: Enrichment, points: Floats, side: Floats) -> tuple[Floats, Floats]:
    """Values (m, n, 2) and gradients (m, n, 2, 2) of singular functions in global axes.

    ``side`` (m,) settles on which face of the crack a point behind the tip lies.
    """
    d = np.asarray(item.direction, dtype=float)
    turn = np.array([[d[0], -d[1]], [d[1], d[0]]])
    local = (points - item.point) @ turn
    radius = np.maximum(np.hypot(*local.T), 1e-30)
    angle = np.arctan2(local[:, 1], local[:, 0])
    wrong = (np.abs(angle) > FACES) & (np.sign(angle) != side)
    angle = np.where(wrong, np.copysign(2 * np.pi - np.abs(angle), side), angle)
    value, gradient = item.functions.evaluate(radius, angle)
    return value @ turn.T, np.einsum("ab,mnbc,dc->mnad", turn, gradient, turn)


def sides(places: Floats, enrichments: "Sequence[Enrichment]", which: Ints) -> Floats:
    """Side of the bisector (N, k), 1 on the left, of places (N, 2) about singular points (N, k)."""
    points = np.array([item.point for item in enrichments])[which]
    ahead = np.array([item.direction for item in enrichments])[which]
    away = places[:, None] - points
    left = ahead[..., 0] * away[..., 1] - ahead[..., 1] * away[..., 0]
    return np.where(left >= 0, 1.0, -1.0)
