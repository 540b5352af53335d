"""The manifold: elements, physical covers, unknowns and boundary of an approximation.

The displacement is ``u(x) = sum_i w_i(x) sum_j f_ij(x) d_ij`` over physical covers ``i``
(Shi 1991, 1997). DDA, the finite element method, the manifold method and meshless methods are
manifolds of different covers.
"""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from covers.approximation.groups.element_group import ElementGroup
from covers.approximation.rigid_modes import LinearMotions
from covers.approximation.rows import Rows, stack_groups
from covers.cutting.boundary import BoundaryEdges
from covers.cutting.shared_edges import shared_edges
from integration.arrays import Bools, Floats, Ints
from integration.polygons import Polygons
from integration.sparse import csc_array


@dataclass(frozen=True)
class Manifold:
    """An approximation on a cut domain, in reference coordinates.

    Attributes
    ----------
    elements
        E polygons: the integration domains.
    element_body
        (E,) body of each element: a connected part of the material.
    element_region
        (E,) input region of each element, which determines its material.
    groups
        Element groups; every element is in one of them.
    cover_offset
        (C + 1,) first unknown of each physical cover.
    cover_patch, cover_body
        (C,) mathematical patch and body of each physical cover.
    boundary
        Edges of the bodies.
    motions
        Linear fields of whole bodies.
    body_centroid, body_area
        (B, 2) centroids (m), and (B,) areas (m2).
    dependent
        Number of linearly dependent functions; above zero the system is singular, but displacements
        are unique (`covers.approximation.dependence`).
    dependent_covers
        Number of covers whose functions are among them.
    reproduction
        Highest degree of polynomials that are reproduced everywhere; None where every block has
        covers of its own.
    richest
        The same where local functions have the highest degree.
    fitted, enriched
        Number of covers with coordinates fitted to the cut, and of covers with singular functions.
    mended
        Changes of patches with too little material, in words, with the number of patches.
    singular
        (k, 2) singular points whose functions covers carry (m).
    """

    elements: Polygons
    element_body: Ints
    element_region: Ints
    groups: tuple[ElementGroup, ...]
    cover_offset: Ints
    cover_patch: Ints
    cover_body: Ints
    boundary: BoundaryEdges
    motions: LinearMotions
    body_centroid: Floats
    body_area: Floats
    dependent: int = 0
    dependent_covers: int = 0
    reproduction: int | None = None
    richest: int | None = None
    fitted: int = 0
    enriched: int = 0
    mended: dict[str, int] = field(default_factory=dict)
    singular: Floats = field(default_factory=lambda: np.empty((0, 2)))

    @property
    def rigid_modes(self) -> csc_array:
        """Unknowns of rigid motions.

        (n_unknowns, 3 B) unit translations along x and y and the unit linearised rotation about the
        centroid, three columns for each body.
        """
        return self.motions.rigid

    @property
    def stretch_modes(self) -> csc_array:
        """(n_unknowns, B) unknowns of the field ``X - Xc`` of each body."""
        return self.motions.stretch

    @property
    def n_unknowns(self) -> int:
        """Number of unknowns."""
        return int(self.cover_offset[-1])

    @property
    def n_bodies(self) -> int:
        """Number of bodies."""
        return len(self.body_area)

    @property
    def n_covers(self) -> int:
        """Number of physical covers."""
        return len(self.cover_patch)

    @cached_property
    def unknown_cover(self) -> Ints:
        """(n_unknowns,) physical cover of each unknown."""
        return np.repeat(np.arange(self.n_covers), np.diff(self.cover_offset))

    @cached_property
    def unknown_body(self) -> Ints:
        """(n_unknowns,) body of each unknown."""
        return self.cover_body[self.unknown_cover]

    @property
    def degree(self) -> int:
        """Highest degree of displacements on an element, see `ElementGroup.shape_degree`."""
        return max((group.shape_degree for group in self.groups), default=1)

    @property
    def shared_covers(self) -> bool:
        """Whether covers extend over several elements, instead of one block each."""
        return self.reproduction is not None

    @property
    def trace_degree(self) -> int | None:
        """Highest degree of displacements along edges; None where some are not polynomials."""
        degrees = [group.trace_degree for group in self.groups]
        known = [degree for degree in degrees if degree is not None]
        return max(known, default=1) if len(known) == len(degrees) else None

    @cached_property
    def _place(self) -> tuple[Ints, Ints]:
        group = np.empty(len(self.elements), dtype=np.int64)
        index = np.empty(len(self.elements), dtype=np.int64)
        for number, part in enumerate(self.groups):  # a handful of groups
            group[part.elements] = number
            index[part.elements] = np.arange(len(part.elements))
        return group, index

    @cached_property
    def shared_edges(self) -> tuple[Ints, Ints]:
        """The two elements (p,) of each edge inside a body."""
        return shared_edges(self.elements, self.element_body, self.boundary)

    @cached_property
    def extends(self) -> Bools:
        """(E,) whether the field of an element can be extended beyond it."""
        found = np.zeros(len(self.elements), dtype=bool)
        for group in self.groups:  # a handful of groups
            found[group.elements] = group.extends
        return found

    def rows(self, elements: Ints, points: Floats) -> Rows:
        """Evaluation rows of the displacement at ``points`` (m, 2) in ``elements`` (m,)."""
        return Rows(*self._stack(elements, points, "displacement_rows"))

    def scalar_rows(self, elements: Ints, points: Floats) -> tuple[Ints, Floats]:
        """Numbers (m, S) of the scalar functions at ``points`` (m, 2) and their values (m, S).

        Function ``k`` belongs to the unknowns ``2 k`` of x and ``2 k + 1`` of y. Valid only where
        no group combines its functions.
        """
        unknowns, values = self._stack(elements, points, "values")
        return unknowns[:, ::2] // 2, values[:, : unknowns.shape[1] // 2]

    def gradient_rows(self, elements: Ints, points: Floats) -> tuple[Ints, Floats]:
        """Unknowns (m, L) and rows (m, 2, 2, L) of ``d u_c / d x_j`` at reference points."""
        return self._stack(elements, points, "gradient_rows")

    def both_rows(self, elements: Ints, points: Floats) -> tuple[Ints, Floats]:
        """Unknowns (m, L) and rows (m, 3, 2, L) of ``u_c``, ``d u_c / d x``, ``d u_c / d y``."""
        return self._stack(elements, points, "both_rows")

    def _stack(self, elements: Ints, points: Floats, what: str) -> tuple[Ints, Floats]:
        group, index = self._place
        wanted = group[elements]
        parts = []
        for number in np.unique(wanted):  # a handful of groups
            position = np.flatnonzero(wanted == number)
            inside = index[elements[position]]
            part = self.groups[number]
            parts.append(
                (position, part.unknowns[inside], getattr(part, what)(inside, points[position]))
            )
        return stack_groups(parts, len(elements))

    @cached_property
    def vertex_rows(self) -> Rows:
        """Evaluation rows of the elements' vertices (``elements.points``)."""
        return self.rows(self.elements.polygon_of_point, self.elements.points)
