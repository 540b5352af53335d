"""The elements of a cut cover in groups of the same local functions."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from covers.approximation.groups.element_group import ElementGroup
from covers.approximation.groups.physical_covers import PhysicalCovers, combined, unknowns_of
from covers.approximation.groups.quadrature_group import QuadratureGroup
from covers.approximation.groups.weighted_fields import RATIONAL, WeightedFields
from covers.approximation.groups.weighted_monomials import Shapes, Weights, polynomial_group
from covers.approximation.local_coordinates import (
    covers_coordinates,
    elements_coordinates,
    fitted_covers,
    part_frames,
)
from covers.approximation.patterns import Pattern, patterns
from covers.approximation.singular.carriers import Carriers, carriers, no_carriers
from covers.approximation.singular.enriched_fields import EnrichedFields
from covers.approximation.singular.enrichment import Enrichment
from covers.approximation.singular.rules import singular_rule
from covers.approximation.whitening import LocalFrames
from covers.cutting.cut_cells import CutCells
from covers.local_functions.polynomials import Kinds
from covers.mathematical.base import Cover
from covers.small_matrices import inverses
from integration.arrays import Bools, Floats, Ints
from integration.monomials import affine
from integration.polygons import Polygons, diameters
from integration.ragged import within
from integration.rules import polygon_rule


@dataclass(frozen=True)
class Grouping:
    """A cut cover with its local coordinates and the numbers of its unknowns.

    Attributes
    ----------
    cover, cut, kinds, enrichments
        What the manifold is made of.
    covers
        Physical covers with their coordinates.
    offset
        (C + 1,) first unknown of each physical cover.
    fitted
        (C,) whether coordinates are fitted to the part of the cover that the cut left.
    carriers
        The singular functions that covers carry.
    frames
        Coordinates of elements.
    """

    cover: Cover
    cut: CutCells
    kinds: Kinds
    enrichments: tuple[Enrichment, ...]
    covers: PhysicalCovers
    offset: Ints
    fitted: Bools
    carriers: Carriers
    frames: LocalFrames

    @classmethod
    def of(
        cls, cover: Cover, cut: CutCells, kinds: Kinds, enrichments: tuple[Enrichment, ...]
    ) -> "Grouping":
        """Number the unknowns of a cut cover, and choose coordinates for covers and elements."""
        size = kinds.each(lambda item: item.n_unknowns)
        carried = no_carriers(cut)
        if enrichments:
            carried = carriers(cut, cover.patch_centre, enrichments)
            size = size + enrichments[0].functions.number * carried.counts
        offset = np.concatenate([[0], np.cumsum(size)])
        frames, parts = part_frames(cut)
        fitted = fitted_covers(cut, kinds)
        own = covers_coordinates(cover, cut, kinds, fitted, parts, frames)
        covers = PhysicalCovers(
            cut.cover_patch, cut.cover_body, own.centre, own.matrix, offset[:-1]
        )
        frames = elements_coordinates(cut, frames, parts)
        return cls(cover, cut, kinds, enrichments, covers, offset, fitted, carried, frames)

    def groups(self) -> Iterator[ElementGroup]:
        """Yield a group for each pattern of local functions among the covers of elements."""
        for pattern in patterns(self.cut, self.kinds, self.carriers):
            if pattern.carried.any():
                yield self._enriched(pattern)
            elif self.cover.weight_degree is None:
                yield self._rational(pattern)
            else:
                yield self._polynomial(pattern)

    def _polynomial(self, pattern: Pattern) -> ElementGroup:
        shapes = self._shapes(pattern)
        first = self._polygons(pattern.elements[shapes.first])
        weights = self._weights(pattern, shapes, 2 / diameters(first))
        covers, functions = pattern.covers, pattern.functions
        return polynomial_group(shapes, first, covers, weights, functions, self.covers)

    def _weights(self, pattern: Pattern, shapes: Shapes, size: Floats) -> Weights:
        """Return the weights on the first element of each shape; ``size`` (d,) scales it (1/m)."""
        cells = self.cut.element_cell[pattern.elements[shapes.first]]
        table, degree = self.cover.weight_tables(cells, shapes.origin[shapes.first], 1 / size)
        table = np.take_along_axis(table, pattern.slots[shapes.first, :, None], axis=1)
        d, k, n_monomials = table.shape
        # From (x - origin) size to the coordinates of the element.
        back = inverses(shapes.matrix) * size[:, None, None]
        still = np.zeros((d * k, 2))
        fitted = affine(table.reshape(d * k, -1), degree, np.repeat(back, k, axis=0), still)
        return Weights(degree, fitted.reshape(d, k, n_monomials))

    def _shapes(self, pattern: Pattern) -> Shapes:
        """Return the shapes of elements: congruent whole cells with whole covers share one.

        Where degrees vary, covers of equal degree must also be at the same corners.
        """
        cut, elements, slots = self.cut, pattern.elements, pattern.slots
        alike = cut.element_whole[elements] & ~self.fitted[pattern.covers].any(axis=1)
        known = self.cover.cell_shape[cut.element_cell[elements]]
        alike &= (known >= 0) & (np.ptp(self.cover.patch_size) == 0)
        key = np.where(
            alike, known, self.cover.cell_shape.max(initial=0) + 1 + np.arange(len(known))
        )
        if (slots != slots[:1]).any():
            order = np.unique(slots, axis=0, return_inverse=True)[1].ravel()
            key = key * (int(order.max()) + 1) + order
        _, first, shape = np.unique(key, return_index=True, return_inverse=True)
        corner = cut.elements.points[cut.elements.first_point[elements]]
        source = elements[first]
        origin = np.where(
            alike[:, None],
            corner + (self.frames.centre[source] - corner[first])[shape],
            self.frames.centre[elements],
        )
        return Shapes(elements, shape, first, origin, self.frames.matrix[source])

    def _rational(self, pattern: Pattern) -> ElementGroup:
        order = 2 * (self.cover.precision + pattern.degree) + RATIONAL
        shapes = self._shapes(pattern)
        return QuadratureGroup(
            elements=pattern.elements,
            unknowns=unknowns_of(pattern.functions, self.covers, pattern.covers),
            combination=combined(pattern.functions),
            shape=shapes.shape,
            fields=self._fields(pattern),
            rule=polygon_rule(self._polygons(pattern.elements), order),
            first=shapes.first,
        )

    def _enriched(self, pattern: Pattern) -> ElementGroup:
        """Return a group with singular functions, which follow the polynomials of all covers."""
        elements, every = pattern.elements, np.arange(len(pattern.elements))
        polynomial = unknowns_of(pattern.functions, self.covers, pattern.covers)
        singular, fields = self._singular(pattern)
        return QuadratureGroup(
            elements=elements,
            unknowns=np.concatenate([polynomial, singular], axis=1),
            combination=_with_vectors(
                combined(pattern.functions), *(part.shape[1] for part in (polynomial, singular))
            ),
            shape=every,
            fields=fields,
            rule=singular_rule(
                self._polygons(elements),
                self.enrichments,
                fields.which,
                pattern.degree + (self.cover.weight_degree or 2),
            ),
            first=every,
        )

    def _singular(self, pattern: Pattern) -> tuple[Ints, EnrichedFields]:
        """Return the unknowns (n, v) of the singular functions of elements, and all fields."""
        elements, carried = pattern.elements, pattern.carried
        carrying = np.repeat(np.arange(len(carried)), carried)
        cover, rank = pattern.covers[:, carrying], within(carried)
        which = self.carriers.points[cover, rank]
        element = np.repeat(elements, len(carrying))
        bearing = self.carriers.bearings(element, cover.ravel(), which.ravel())
        bearing = bearing.reshape(which.shape)
        fields = self._fields(pattern)
        number = self.enrichments[0].functions.number
        first = self.offset[cover + 1] - number * (carried[carrying] - rank)
        unknowns = (first[:, :, None] + np.arange(number)).reshape(len(elements), -1)
        return unknowns, EnrichedFields(fields, carrying, self.enrichments, which, bearing)

    def _fields(self, pattern: Pattern) -> WeightedFields:
        cells = self.cut.element_cell[pattern.elements]
        slots, covers, functions = pattern.slots, pattern.covers, tuple(pattern.functions)
        return WeightedFields(self.cover, cells, slots, covers, functions, self.covers)

    def _polygons(self, elements: Ints) -> Polygons:
        return self.cut.elements.take(elements)


def _with_vectors(base: Floats | None, unknowns: int, vectors: int) -> Floats:
    """Return the combination of scalar functions where vector functions follow them.

    Two scalar functions, of the x and the y component, make one vector function.
    """
    rows = unknowns if base is None else len(base)
    combination = np.zeros((rows + 4 * vectors, unknowns + vectors))
    combination[:rows, :unknowns] = np.eye(rows) if base is None else base
    vector = np.arange(vectors)
    combination[rows + 4 * vector, unknowns + vector] = 1.0
    combination[rows + 4 * vector + 3, unknowns + vector] = 1.0
    return combination
