"""Physical covers: the connected parts of each patch, found for the whole mesh at once."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import shapely

from covers.concatenate import numbers
from covers.cutting.components import components
from covers.mathematical.patch_mesh import PatchMesh
from integration.arrays import Bools, Floats, Ints
from integration.polygons import Polygons


@dataclass(frozen=True)
class Joins:
    """Pairs of elements that share a part of an edge without a discontinuity.

    Attributes
    ----------
    first, second : (n,)
        elements.
    start, end : (n, 2)
        ends of the shared part, m.
    """

    first: Ints = field(metadata=numbers("element"))
    second: Ints = field(metadata=numbers("element"))
    start: Floats
    end: Floats

    def take(self, chosen: Ints | Bools) -> Joins:
        """The chosen pairs."""
        return Joins(self.first[chosen], self.second[chosen], self.start[chosen], self.end[chosen])


@dataclass(frozen=True)
class CoverParts:
    """Physical covers.

    Attributes
    ----------
    of_element : (E, k)
        physical covers of each element, -1 where a patch is not active.
    patch : (P,)
        mathematical patch of each physical cover; physical covers are in the order of patches.
    first : (P,)
        first element of each.
    """

    of_element: Ints
    patch: Ints
    first: Ints


def bodies(n: int, region: Ints, joins: Joins) -> Ints:
    """Return the connected body (n,) of each element, by region, then by first element."""
    part = components(n, joins.first, joins.second)
    first = np.unique(part, return_index=True)[1]
    rank = np.empty(len(first), dtype=np.int64)
    rank[np.lexsort((first, region[first]))] = np.arange(len(first))
    return rank[part]


def physical_covers(
    cover: PatchMesh, elements: Polygons, cell: Ints, region: Ints, joins: Joins, touched: Bools
) -> CoverParts:
    """Return the connected parts of all patches.

    Two elements of a patch are connected if they share a part of an edge inside the patch
    (`Joins`); a common vertex does not connect.

    Parameters
    ----------
    cell, region : (E,)
        cell and region of each element.
    touched : (C,)
        cells that boundaries or cracks touch. A patch without such a cell is one part.
    """
    patches = cover.cell_patches[cell]
    if cover.disc_radius is not None:
        patches = _reached(cover, elements, patches, touched[cell])
    n, k = patches.shape
    doubtful = np.zeros(cover.n_patches + 1, dtype=bool)  # the last entry is for -1
    doubtful[cover.cell_patches[touched]] = True
    doubtful[-1] = False
    one, two = _shared_patches(cover, patches, joins, doubtful)
    part = components(n * k, one, two)
    regions = int(region.max(initial=0)) + 1
    plain = n * k + patches * regions + region[:, None]
    key = np.where(doubtful[patches], part.reshape(n, k), plain)
    key[patches < 0] = -1
    return _numbered(key, patches)


def _shared_patches(
    cover: PatchMesh, patches: Ints, joins: Joins, doubtful: Bools
) -> tuple[Ints, Ints]:
    """Pairs of ``element * k + slot`` of the same patch on both sides of a join."""
    k = patches.shape[1]
    asked: Bools = np.asarray(doubtful[patches].any(axis=1))
    joins = joins.take(asked[joins.first] & asked[joins.second])
    left, right = patches[joins.first], patches[joins.second]
    same = (left[:, :, None] == right[:, None, :]) & doubtful[left][:, :, None]
    row, a, b = np.nonzero(same)
    if cover.disc_radius is not None:
        patch = left[row, a]
        inside = _segment_distance(joins.start[row], joins.end[row], cover.patch_centre[patch])
        kept = inside < cover.disc_radius[patch]
        row, a, b = row[kept], a[kept], b[kept]
    return joins.first[row] * k + a, joins.second[row] * k + b


def _reached(cover: PatchMesh, elements: Polygons, patches: Ints, cut: Bools) -> Ints:
    """Patches of each element; -1 where the disc does not meet the element."""
    assert cover.disc_radius is not None
    row, slot = np.nonzero((patches >= 0) & cut[:, None])
    patch = patches[row, slot]
    shapes = elements.take(cut).to_shapely()[(np.cumsum(cut) - 1)[row]]
    distance = np.asarray(shapely.distance(shapely.points(cover.patch_centre[patch]), shapes))
    missed = np.asarray(distance >= cover.disc_radius[patch] * (1 - 1e-12))
    reached = patches.copy()
    reached[row[missed], slot[missed]] = -1
    return reached


def _segment_distance(start: Floats, end: Floats, points: Floats) -> Floats:
    along, away = end - start, points - start
    share = (along * away).sum(axis=1) / (along**2).sum(axis=1)
    return np.asarray(np.hypot(*(away - share.clip(0.0, 1.0)[:, None] * along).T))


def _numbered(key: Ints, patches: Ints) -> CoverParts:
    """Number physical covers, given a key for each, by patch, then by first element."""
    distinct, first, part = np.unique(key, return_index=True, return_inverse=True)
    part = part.reshape(key.shape)
    k = key.shape[1]
    patch, element = patches.ravel()[first], first // k
    order = np.lexsort((element, patch))
    order = order[distinct[order] >= 0]
    rank = np.full(len(distinct), -1, dtype=np.int64)
    rank[order] = np.arange(len(order))
    return CoverParts(rank[part], patch[order], element[order])
