"""The manifold of a cut cover: elements grouped by the shape of their approximation."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from covers.approximation.dependence import dependent_functions
from covers.approximation.element_groups import ElementGroup
from covers.approximation.local_coordinates import (
    covers_coordinates,
    elements_coordinates,
    fitted_covers,
    part_frames,
)
from covers.approximation.manifold import Manifold
from covers.approximation.polynomial_groups import (
    PhysicalCovers,
    Shapes,
    Weights,
    combined,
    polynomial_group,
    unknowns_of,
)
from covers.approximation.quadrature_groups import QuadratureGroup
from covers.approximation.rigid_modes import rigid_modes, stretch_modes
from covers.approximation.singular.carriers import Carriers, carriers, no_carriers
from covers.approximation.singular.enriched_fields import EnrichedFields
from covers.approximation.singular.enrichment import Enrichment
from covers.approximation.singular.rules import singular_rule
from covers.approximation.weighted_fields import RATIONAL, WeightedFields
from covers.approximation.whitening import LocalFrames
from covers.cutting.cut_cells import CutCells
from covers.local_functions.polynomials import Kinds, LocalFunctions
from covers.mathematical.base import Cover
from covers.small_matrices import inverses
from integration.arrays import Bools, Floats, Ints
from integration.monomials import affine
from integration.polygons import diameters
from integration.ragged import within
from integration.rules import polygon_rule


def mesh_manifold(
    cover: Cover,
    cut: CutCells,
    functions: LocalFunctions | Kinds,
    enrichments: Sequence[Enrichment] = (),
) -> Manifold:
    """Build the manifold of a cut mathematical cover.

    Cells that no line cuts are congruent in regular nets and share their integrals. Elements and
    covers that a cut touches get coordinates that fit what is left of them
    (`covers.approximation.whitening`), so that the conditioning does not depend on the cut.

    Parameters
    ----------
    cover, cut
        The mathematical cover and what `covers.cutting.cut` made of it.
    functions
        Local functions of all physical covers, or `Kinds` that vary from cover to cover.
    enrichments
        Singular points whose functions the covers about them carry too.
    """
    kinds = functions if isinstance(functions, Kinds) else _uniform(functions, cut.n_covers)
    builder = _Builder.of(cover, cut, kinds, tuple(enrichments))
    n_unknowns = int(builder.offset[-1])
    body_area, body_centroid = _bodies(cut)
    # Covers hold rigid motions themselves where all can, as their mass block by block asks.
    degrees = [item.degree for item in kinds.functions]
    lowest = min(degrees)
    by_nodes = cover.precision >= 1 and lowest == 0
    nodes = cover.patch_centre[cut.cover_patch] if by_nodes else None
    modes = (kinds, builder.covers, n_unknowns, body_centroid, nodes)
    groups = tuple(builder.groups())
    dependent = dependent_functions(
        cover, cut, kinds.functions, kinds.which, lambda: (groups, n_unknowns)
    )
    higher = kinds.each(lambda item: item.degree > 0)
    return Manifold(
        elements=cut.elements,
        element_body=cut.element_body,
        element_region=cut.element_region,
        groups=groups,
        cover_offset=builder.offset,
        cover_patch=cut.cover_patch,
        cover_body=cut.cover_body,
        boundary=cut.boundary,
        rigid_modes=rigid_modes(*modes),
        stretch_modes=stretch_modes(*modes),
        body_centroid=body_centroid,
        body_area=body_area,
        dependent=dependent,
        dependent_covers=int(higher.sum()) if dependent else 0,
        reproduction=cover.precision + lowest,
        richest=cover.precision + max(degrees),
        fitted=int(builder.fitted.sum()),
        mended=cover.mended,
        enriched=int((builder.carriers.counts > 0).sum()),
        singular=_carried(enrichments, builder.carriers),
    )


def _carried(enrichments: Sequence[Enrichment], found: Carriers) -> Floats:
    """Singular points (n, 2) whose functions are carried."""
    places = np.array([item.point for item in enrichments]).reshape(-1, 2)
    return np.asarray(places[found.carried])


def _uniform(functions: LocalFunctions, n: int) -> Kinds:
    return Kinds((functions,), np.zeros(n, dtype=np.int64))


def _bodies(cut: CutCells) -> tuple[Floats, Floats]:
    area, centroid = cut.elements.areas, cut.elements.centroids
    total = np.bincount(cut.element_body, area, minlength=cut.n_bodies)
    first = [np.bincount(cut.element_body, area * c, minlength=cut.n_bodies) for c in centroid.T]
    return np.asarray(total), np.asarray(np.stack(first, axis=1) / total[:, None])


@dataclass(frozen=True)
class _Builder:
    """What all groups are made from."""

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
    ) -> "_Builder":
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
        return cls(
            cover,
            cut,
            kinds,
            enrichments,
            covers,
            offset,
            fitted,
            carried,
            elements_coordinates(cut, frames, parts),
        )

    def groups(self) -> Iterator[ElementGroup]:
        """One group for each pattern of local functions among the covers of elements."""
        for elements, slots, kinds, counts in self._patterns():
            functions = [self.kinds.functions[kind] for kind in kinds]
            active = np.take_along_axis(self.cut.covers[elements], slots, axis=1)
            if counts.any():
                yield self._enriched(elements, slots, active, functions, counts)
            elif self.cover.weight_degree is None:
                yield self._rational(elements, slots, active, functions)
            else:
                yield self._polynomial(elements, slots, active, functions)

    def _patterns(self) -> Iterator[tuple[Ints, Ints, Ints, Ints]]:
        """Elements (n,), their active slots (n, k), functions (k,), points carried (k,)."""
        covers, most = self.cut.covers, self.carriers.points.shape[1] + 1
        none = most * len(self.kinds.functions)
        code = most * self.kinds.which + self.carriers.counts
        codes = np.where(covers >= 0, code[covers], none)
        # Enriched slots first, then by functions, inactive ones last; equal ones stay in order.
        rank = np.where(codes == none, none, codes - none * (codes % most))
        slots = np.argsort(rank, axis=1, kind="stable")
        codes = np.take_along_axis(codes, slots, axis=1)
        if (codes == codes[0]).all():
            distinct, pattern = codes[:1], np.zeros(len(codes), dtype=np.int64)
        else:
            distinct, pattern = np.unique(codes, axis=0, return_inverse=True)
            pattern = pattern.ravel()
        for number, row in enumerate(distinct):  # a handful of patterns
            active = row[row < none]
            elements = np.flatnonzero(pattern == number)
            yield elements, slots[elements, : len(active)], active // most, active % most

    def _polynomial(
        self, elements: Ints, slots: Ints, active: Ints, functions: list[LocalFunctions]
    ) -> ElementGroup:
        shapes = self._shapes(elements, slots, active)
        first = elements[shapes.first]
        size = 2 / diameters(self.cut.elements.take(first))
        cells = self.cut.element_cell[first]
        table, degree = self.cover.weight_tables(cells, shapes.origin[shapes.first], 1 / size)
        table = np.take_along_axis(table, slots[shapes.first, :, None], axis=1)
        d, k, n_monomials = table.shape
        # From (x - origin) size to the element's own coordinates.
        back = inverses(shapes.matrix) * size[:, None, None]
        still = np.zeros((d * k, 2))
        fitted = affine(table.reshape(d * k, -1), degree, np.repeat(back, k, axis=0), still)
        return polynomial_group(
            shapes,
            self.cut.elements.take(first),
            active,
            Weights(degree, fitted.reshape(d, k, n_monomials)),
            functions,
            self.covers,
        )

    def _shapes(self, elements: Ints, slots: Ints, active: Ints) -> Shapes:
        """Congruent whole cells share a shape when all their covers are whole too.

        Where degrees vary, covers of one degree must stand at the same corners besides.
        """
        cut = self.cut
        alike = cut.element_whole[elements] & ~self.fitted[active].any(axis=1)
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

    def _rational(
        self, elements: Ints, slots: Ints, active: Ints, functions: list[LocalFunctions]
    ) -> ElementGroup:
        degree = max(item.degree for item in functions)
        order = 2 * (self.cover.precision + degree) + RATIONAL
        shapes = self._shapes(elements, slots, active)
        return QuadratureGroup(
            elements=elements,
            unknowns=unknowns_of(functions, self.covers, active),
            combination=combined(functions),
            shape=shapes.shape,
            fields=self._fields(elements, slots, active, functions),
            rule=polygon_rule(self.cut.elements.take(elements), order),
            first=shapes.first,
        )

    def _enriched(
        self,
        elements: Ints,
        slots: Ints,
        active: Ints,
        functions: list[LocalFunctions],
        counts: Ints,
    ) -> ElementGroup:
        carrying = np.repeat(np.arange(len(counts)), counts)
        cover, rank = active[:, carrying], within(counts)
        which = self.carriers.points[cover, rank]
        degree = max(item.degree for item in functions) + (self.cover.weight_degree or 2)
        number = self.enrichments[0].functions.number
        base = combined(functions)
        polynomial = unknowns_of(functions, self.covers, active)
        first = self.offset[cover + 1] - number * (counts[carrying] - rank)
        singular = (first[:, :, None] + np.arange(number)).reshape(len(elements), -1)
        total = polynomial.shape[1]
        rows = total if base is None else len(base)
        vectors = number * len(carrying)
        # Two scalar functions, of the x and the y component, make one vector function.
        combination = np.zeros((rows + 4 * vectors, total + vectors))
        combination[:rows, :total] = np.eye(rows) if base is None else base
        vector = np.arange(vectors)
        combination[rows + 4 * vector, total + vector] = 1.0
        combination[rows + 4 * vector + 3, total + vector] = 1.0
        element = np.repeat(elements, len(carrying))
        bearing = self.carriers.bearings(element, cover.ravel(), which.ravel())
        return QuadratureGroup(
            elements=elements,
            unknowns=np.concatenate([polynomial, singular], axis=1),
            combination=combination,
            shape=np.arange(len(elements)),
            fields=EnrichedFields(
                self._fields(elements, slots, active, functions),
                carrying,
                self.enrichments,
                which,
                bearing.reshape(which.shape),
            ),
            rule=singular_rule(self.cut.elements.take(elements), self.enrichments, which, degree),
            first=np.arange(len(elements)),
        )

    def _fields(
        self, elements: Ints, slots: Ints, active: Ints, functions: list[LocalFunctions]
    ) -> WeightedFields:
        cells = self.cut.element_cell[elements]
        return WeightedFields(self.cover, cells, slots, active, tuple(functions), self.covers)
