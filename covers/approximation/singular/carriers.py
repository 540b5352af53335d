"""The covers that carry the functions of singular points."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from covers.approximation.singular.branches import branches
from covers.approximation.singular.enrichment import Enrichment
from covers.cutting.cut_cells import CutCells
from integration.arrays import Bools, Floats, Ints

# A vertex nearer to a point than this share of the size of the domain is the point.
SAME_VERTEX = 1e-9


@dataclass(frozen=True)
class Carriers:
    """Covers with singular functions.

    Attributes
    ----------
    points
        (C, k) singular points of each physical cover, padded with -1.
    place, point, bearing
        (n,) key ``element * C + cover``, sorted within each point; the point; and the branch of the
        angle there (`Branches`).
    carried
        (N,) whether covers carry the functions of each singular point.
    """

    points: Ints
    place: Ints
    point: Ints
    bearing: Floats
    carried: Bools

    @property
    def counts(self) -> Ints:
        """(C,) number of singular points of each cover."""
        return np.asarray((self.points >= 0).sum(axis=1))

    def bearings(self, element: Ints, cover: Ints, point: Ints) -> Floats:
        """Return the branch (n,) of the angle about points (n,) on elements (n,) of covers (n,)."""
        n = len(self.points)
        found = np.zeros(len(element))
        for one in np.unique(point):  # a handful of singular points
            mine, rows = np.flatnonzero(self.point == one), np.flatnonzero(point == one)
            at = np.searchsorted(self.place[mine], element[rows] * n + cover[rows])
            found[rows] = self.bearing[mine[at]]
        return found


def carriers(cut: CutCells, patch_centre: Floats, enrichments: Sequence[Enrichment]) -> Carriers:
    """Return the covers with singular functions.

    Covers of the elements that touch a point carry its functions, if necessary those of several
    points; other covers within the radius of a point carry those of the nearest one. A point about
    which some cover has no continuous angle, as the tip of a crack within one cover, gets none.
    """
    n, chosen = cut.n_covers, _chosen(cut, patch_centre, enrichments)
    places, carried = [], np.ones(len(enrichments), dtype=bool)
    for number, item in enumerate(enrichments):  # a handful of singular points
        carrying = np.append(chosen[number], False)[cut.covers]
        element, slot = np.nonzero(carrying)
        cover = cut.covers[element, slot]
        found = branches(cut, item, element, cover)
        if found.torn.any():
            chosen[number], carried[number] = False, False
            continue
        key = element * n + cover
        order = np.argsort(key)
        places.append((key[order], np.full(len(key), number), found.bearing[order]))
    points = _rows(chosen)
    if not places:
        none = np.empty(0, dtype=np.int64)
        return Carriers(points, none, none, np.empty(0), carried)
    key, point, bearing = (np.concatenate(parts) for parts in zip(*places, strict=True))
    return Carriers(points, key, point, bearing, carried)


def _chosen(cut: CutCells, patch_centre: Floats, enrichments: Sequence[Enrichment]) -> Bools:
    """Return which covers (N, C) shall carry each point: those that touch it, and near ones."""
    centre = patch_centre[cut.cover_patch]
    distance = np.array([np.hypot(*(centre - item.point).T) for item in enrichments])
    within = np.array([item.radius for item in enrichments])[:, None] > distance
    nearest = np.argmin(np.where(within, distance, np.inf), axis=0)
    chosen = within & (nearest == np.arange(len(enrichments))[:, None])
    for number, item in enumerate(enrichments):  # a handful of singular points
        chosen[number, touching_covers(cut, item.point)] = True
        if item.body is not None:
            chosen[number] &= cut.cover_body == item.body
    return np.asarray(chosen)


def _rows(chosen: Bools) -> Ints:
    """Numbers (C, k) of the true rows of each column of a table (N, C), padded with -1."""
    most = int(chosen.sum(axis=0).max(initial=0))
    order = np.argsort(~chosen, axis=0, kind="stable")[:most].T
    return np.where(np.take_along_axis(chosen.T, order, axis=1), order, -1)


def no_carriers(cut: CutCells) -> Carriers:
    """Return covers without singular functions."""
    none = np.empty(0, dtype=np.int64)
    points = np.empty((cut.n_covers, 0), dtype=np.int64)
    return Carriers(points, none, none, np.empty(0), np.empty(0, dtype=bool))


def touching_covers(cut: CutCells, point: Floats) -> Ints:
    """Return the covers of elements with a vertex at the point; else of those that contain it."""
    owner = cut.elements.polygon_of_point
    away = np.hypot(*(cut.elements.points - point).T)
    size = cut.elements.extent
    found = np.unique(owner[away <= SAME_VERTEX * size])
    if not len(found):  # a point inside an element
        low = np.minimum.reduceat(cut.elements.points, cut.elements.first_point, axis=0)
        high = np.maximum.reduceat(cut.elements.points, cut.elements.first_point, axis=0)
        within = np.flatnonzero(((low <= point) & (point <= high)).all(axis=1))
        shapes = cut.elements.take(within).to_shapely()
        found = within[shapely.intersects(shapes, shapely.Point(point))]
    active = cut.covers[found]
    return np.unique(active[active >= 0])
