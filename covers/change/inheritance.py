"""Unknowns of a manifold that have the same function as one of the manifold before it.

Where a crack grows, all covers but those about its tip stay as they were. Their unknowns are copied
and need not be solved for.
"""

import numpy as np

from covers.approximation.manifold import Manifold
from covers.approximation.rows import Rows
from covers.change.parentage import Parentage
from integration.arrays import Bools, Floats, Ints

# Relative difference of values below which functions are the same.
ALIKE = 1e-9
# Functions are compared at the centroid of each element, moved by this share towards a vertex.
ASIDE = 0.3


def inherited(kin: Parentage) -> Ints:
    """Return the old unknown (n,) with the function of each new one; -1 where there is none.

    The unknowns of a cover are inherited if all elements of its support, and all functions on them,
    are unchanged.
    """
    old, new = kin.old, kin.new
    found = np.full(new.n_unknowns, -1, dtype=np.int64)
    before, after = kin.kept
    if not len(after):
        return found
    places = _places(new, after)
    one, two = old.rows(before, places), new.rows(after, places)
    same = _alike(one, two)
    length = min(one.unknowns.shape[1], two.unknowns.shape[1])
    there = same[:, None] & two.values[..., :length].any(axis=1)
    row, slot = np.nonzero(there)
    parent, child = one.unknowns[row, slot], two.unknowns[row, slot]
    found[child] = parent
    # Unknowns on which two elements disagree are not inherited.
    torn = np.bincount(row, found[child] != parent, minlength=len(after)) > 0
    left = np.zeros(len(new.elements), dtype=bool)
    left[after[same & ~torn]] = True
    return np.where(_all_in(new, found, left) & _all_of(old, new, found), found, -1)


def _places(manifold: Manifold, elements: Ints) -> Floats:
    """A point (m, 2) in each of some elements, on no line of symmetry."""
    polygons = manifold.elements
    corner = polygons.points[polygons.first_point[elements]]
    return (1 - ASIDE) * polygons.centroids[elements] + ASIDE * corner


def _alike(one: Rows, two: Rows) -> Bools:
    """Whether rows (m,) of two manifolds have the same values in the same order."""
    length = max(one.values.shape[2], two.values.shape[2])
    a, b = (
        np.pad(rows.values, ((0, 0), (0, 0), (0, length - rows.values.shape[2])))
        for rows in (one, two)
    )
    largest = np.abs(b).max(axis=(1, 2))
    return np.asarray(np.abs(a - b).max(axis=(1, 2)) <= ALIKE * largest)


def _all_in(manifold: Manifold, found: Ints, left: Bools) -> Bools:
    """Which unknowns (n,) belong to covers whose elements are all ``left`` unchanged (E,)."""
    covers = np.ones(manifold.n_covers, dtype=bool)
    for group in manifold.groups:  # a handful of groups
        changed = group.unknowns[~left[group.elements]].ravel()
        covers[np.searchsorted(manifold.cover_offset, changed, side="right") - 1] = False
    covers &= np.logical_and.reduceat(found >= 0, manifold.cover_offset[:-1])
    return covers[manifold.unknown_cover]


def _all_of(old: Manifold, new: Manifold, found: Ints) -> Bools:
    """Which unknowns (n,) belong to covers with as many unknowns as their old cover."""
    first = np.maximum(found[new.cover_offset[:-1]], 0)
    parent = np.searchsorted(old.cover_offset, first, side="right") - 1
    same = np.diff(old.cover_offset)[parent] == np.diff(new.cover_offset)
    return np.asarray(same[new.unknown_cover])
