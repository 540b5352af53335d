"""Parentage of elements, bodies, boundary edges and covers of two manifolds on one material.

Both are in the same reference configuration, and their regions have the same numbers. An old and a
new element are parent and child if they have material in common; any number of parents may have any
number of children.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely

from covers.approximation.manifold import Manifold
from covers.change.common_parts import common_parts
from covers.change.relation import Relation, identity
from covers.cutting.boundary import BoundaryEdges
from integration.arrays import Bools, Floats, Ints
from integration.polygons import Polygons
from integration.sparse import coo_array, csr_array

# Overlaps below this share of the smaller of two elements are rounding of vertices.
ROUNDING = 1e-12
# Edges nearer to each other than this share of the size of the domain are the same: far above the
# resolution of cuts, far below any cell.
SAME_EDGE = 1e-9


@dataclass(frozen=True)
class Parentage:
    """Parents and children of two manifolds.

    Attributes
    ----------
    old, new
        The manifolds before and after.
    same
        Whether elements and edges correspond one by one though their places differ, as when the
        reference configuration of bodies is updated.
    """

    old: Manifold
    new: Manifold
    same: bool = False

    @cached_property
    def elements(self) -> Relation:
        """Elements, by common area (m2)."""
        return self._overlaps[0]

    @cached_property
    def pieces(self) -> Polygons:
        """The common parts of old and new elements, in the order of `elements`."""
        return self._overlaps[1]

    @cached_property
    def bodies(self) -> Relation:
        """Bodies, by common area (m2)."""
        return self.elements.gathered(
            (self.old.element_body, self.new.element_body), (self.old.n_bodies, self.new.n_bodies)
        )

    @cached_property
    def edges(self) -> Relation:
        """Boundary edges, by common length (m)."""
        old, new = self.old.boundary, self.new.boundary
        if self.same or _same_edges(old, new):
            return identity(np.hypot(*(new.end - new.start).T))
        return _along(self.old, self.new)

    @cached_property
    def covers(self) -> Relation:
        """Covers, by the common area of their supports (m2)."""
        old, new = _incidence(self.old), _incidence(self.new)
        found = coo_array(old.T @ self.elements.matrix @ new)
        parent, child = (index.astype(np.int64) for index in found.coords)
        return Relation(parent, child, found.data, self.old.n_covers, self.new.n_covers)

    @cached_property
    def _overlaps(self) -> tuple[Relation, Polygons]:
        old, new = self.old, self.new
        if self.same or same_elements(old, new):
            return identity(new.elements.areas), new.elements
        return _overlaps(old, new, self.kept)

    @cached_property
    def kept(self) -> tuple[Ints, Ints]:
        """Old and new numbers (k,) of the unchanged elements."""
        if same_elements(self.old, self.new):
            every = np.arange(len(self.new.elements), dtype=np.int64)
            return every, every
        return _kept(self.old, self.new)

    @cached_property
    def whole(self) -> Bools:
        """Which new bodies (B,) are identical with an old one."""
        bodies = self.bodies
        children = np.bincount(bodies.parent, minlength=bodies.n_parents)
        parents = np.bincount(bodies.child, minlength=bodies.n_children)
        main = np.maximum(bodies.main, 0)
        alone = (bodies.main >= 0) & (children[main] == 1) & (parents == 1)
        close = np.isclose(self.old.body_area[main], self.new.body_area, rtol=1e-9, atol=0.0)
        return np.asarray(alone & close)

    @cached_property
    def new_bodies(self) -> Bools:
        """Which new bodies (B,) have no parent."""
        return self.bodies.main < 0


def same_elements(old: Manifold, new: Manifold) -> bool:
    """Return whether the elements of two manifolds are identical one by one."""
    a, b = old.elements, new.elements
    return np.array_equal(old.element_region, new.element_region) and all(
        np.array_equal(getattr(a, name), getattr(b, name))
        for name in ("points", "ring_offsets", "polygon_offsets")
    )


def _same_edges(old: BoundaryEdges, new: BoundaryEdges) -> bool:
    names = ("start", "end", "element")
    return all(np.array_equal(getattr(old, name), getattr(new, name)) for name in names)


def _overlaps(old: Manifold, new: Manifold, kept: tuple[Ints, Ints]) -> tuple[Relation, Polygons]:
    """Overlay elements of the same region; unchanged ones are common parts as they are."""
    kept_old, kept_new = kept
    mine, others = (
        np.setdiff1d(np.arange(len(side.elements)), kept)
        for side, kept in ((old, kept_old), (new, kept_new))
    )
    first, second = old.elements.take(mine).to_shapely(), new.elements.take(others).to_shapely()
    child, parent = shapely.STRtree(first).query(second, predicate="intersects")
    parent, child = mine[parent], others[child]
    alike = old.element_region[parent] == new.element_region[child]
    parent, child = parent[alike], child[alike]
    pairs = np.searchsorted(mine, parent), np.searchsorted(others, child)
    shapes, owner = shapely.get_parts(common_parts(first, second, *pairs), return_index=True)
    parent, child, area = parent[owner], child[owner], shapely.area(shapes)
    smaller = np.minimum(old.elements.areas[parent], new.elements.areas[child])
    counts = (shapely.get_type_id(shapes) == 3) & (area > ROUNDING * smaller)
    parts = Polygons.concatenate(
        [new.elements.take(kept_new), Polygons.from_shapely(shapes[counts])]
    )
    parent = np.concatenate([kept_old, parent[counts]])
    child = np.concatenate([kept_new, child[counts]])
    area = np.concatenate([new.elements.areas[kept_new], area[counts]])
    order = np.lexsort((parent, child))
    relation = Relation(
        parent[order], child[order], area[order], len(old.elements), len(new.elements)
    )
    return relation, parts.take(order).oriented()


def _kept(old: Manifold, new: Manifold) -> tuple[Ints, Ints]:
    """Old and new numbers (k,) of unchanged elements.

    These have the same region, number of vertices, first vertex, centroid and area to the last bit.
    """
    rows = []
    for side in (old, new):
        elements = side.elements
        shape = np.diff(elements.ring_offsets)[elements.polygon_offsets[:-1]]
        corner = elements.points[elements.first_point]
        told = (side.element_region, shape, corner, elements.centroids, elements.areas)
        rows.append(np.column_stack(told))
    _, which, count = np.unique(
        np.concatenate(rows), axis=0, return_inverse=True, return_counts=True
    )
    which, n = which.ravel(), len(old.elements)
    # Only keys that occur exactly once in each manifold identify an element.
    once = np.bincount(which[:n], minlength=len(count)) == 1
    place = np.full(len(count), -1, dtype=np.int64)
    place[which[:n]] = np.arange(n)
    twin = which[n:]
    kept = np.flatnonzero(once[twin] & (count[twin] == 2))
    return place[twin[kept]], kept


def _along(old: Manifold, new: Manifold) -> Relation:
    """Boundary edges of the same region that lie on each other, in the same direction."""
    a, b = old.boundary, new.boundary
    near = SAME_EDGE * old.elements.extent
    first, second = (
        [shapely.LineString(ends) for ends in np.stack([e.start, e.end], axis=1)] for e in (a, b)
    )
    child, parent = shapely.STRtree(first).query(second, predicate="dwithin", distance=near)
    alike = old.element_region[a.element[parent]] == new.element_region[b.element[child]]
    parent, child = parent[alike], child[alike]
    common = _common(a, parent, b, child, near)
    counts = common > near
    return Relation(parent[counts], child[counts], common[counts], len(a), len(b))


def _common(a: BoundaryEdges, one: Ints, b: BoundaryEdges, other: Ints, near: float) -> Floats:
    """Common length (k,) of edges ``one`` of ``a`` and edges ``other`` of ``b`` (m)."""
    way = a.end[one] - a.start[one]
    length = np.hypot(*way.T)
    along = way / length[:, None]
    ends = np.stack([b.start[other], b.end[other]]) - a.start[one]
    s = np.einsum("ekj,kj->ek", ends, along)
    off = np.abs(ends[..., 0] * along[:, 1] - ends[..., 1] * along[:, 0]).max(axis=0)
    common = np.minimum(s[1], length) - np.maximum(s[0], 0.0)
    return np.where((off <= 2 * near) & (s[1] > s[0]), common, 0.0)


def _incidence(manifold: Manifold) -> csr_array:
    """Incidence matrix (E, C) of elements and covers."""
    elements, covers = [], []
    for group in manifold.groups:  # a handful of groups
        cover = np.searchsorted(manifold.cover_offset, group.unknowns, side="right") - 1
        elements.append(np.repeat(group.elements, cover.shape[1]))
        covers.append(cover.ravel())
    place = np.concatenate(elements), np.concatenate(covers)
    found = csr_array(
        (np.ones(len(place[0])), place), shape=(len(manifold.elements), manifold.n_covers)
    )
    found.data[:] = 1.0
    return found
