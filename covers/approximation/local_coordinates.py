"""Local coordinates of the elements and physical covers of a cut mesh."""

import numpy as np

from covers.approximation.whitening import LocalFrames, cover_frames, element_frames, element_spread
from covers.cutting.cut_cells import CutCells
from covers.local_functions.polynomials import Kinds
from covers.mathematical.base import Cover
from integration.arrays import Bools, Ints
from integration.polygons import Polygons, diameters


def part_frames(cut: CutCells) -> tuple[LocalFrames, Ints]:
    """Return the coordinates of the elements that are not whole cells, and their numbers."""
    parts = np.flatnonzero(~cut.element_whole)
    if not len(parts):
        return LocalFrames(np.zeros((0, 2)), np.zeros((0, 2, 2))), parts
    return element_frames(cut.elements.take(parts)), parts


def elements_coordinates(cut: CutCells, frames: LocalFrames, parts: Ints) -> LocalFrames:
    """Return the coordinates of all elements (E,): fitted for parts of cells, else scaled."""
    centre = cut.elements.centroids.copy()
    matrix = np.eye(2) * (2 / diameters(cut.elements))[:, None, None]
    centre[parts], matrix[parts] = frames.centre, frames.matrix
    return LocalFrames(centre, matrix)


def fitted_covers(cut: CutCells, kinds: Kinds) -> Bools:
    """Return which covers (C,) get fitted coordinates: those touched by a cut, of degree > 0."""
    touched = np.zeros(cut.n_covers + 1, dtype=bool)
    touched[cut.covers[~cut.element_whole]] = True
    able = kinds.each(lambda item: item.degree > 0 and not item.physical_length)
    return np.asarray(touched[:-1] & able)


def covers_coordinates(
    cover: Cover, cut: CutCells, kinds: Kinds, fitted: Bools, parts: Ints, frames: LocalFrames
) -> LocalFrames:
    """Return the coordinates of all covers (C,): of the patch, or fitted to its part left."""
    centre = cover.patch_centre[cut.cover_patch].copy()
    physical = kinds.each(lambda item: item.physical_length)
    size = np.where(physical, 1.0, cover.patch_size[cut.cover_patch])
    matrix = np.eye(2) / size[:, None, None]
    if fitted.any():
        element, slot = np.nonzero((cut.covers >= 0) & fitted[cut.covers])
        number = np.cumsum(fitted) - 1
        own = np.unique(element)
        place = np.zeros(len(cut.elements), dtype=np.int64)
        place[own] = np.arange(len(own))
        polygons = cut.elements.take(own)
        spread = element_spread(polygons, _some(cut, polygons, own, parts, frames))
        found = cover_frames(
            spread, place[element], number[cut.covers[element, slot]], int(fitted.sum())
        )
        centre[fitted], matrix[fitted] = found.centre, found.matrix
    return LocalFrames(centre, matrix)


def _some(
    cut: CutCells, polygons: Polygons, own: Ints, parts: Ints, frames: LocalFrames
) -> LocalFrames:
    """Coordinates of some elements: fitted for parts of cells, else scaled."""
    matrix = np.eye(2) * (2 / diameters(polygons))[:, None, None]
    mine = np.isin(own, parts)
    matrix[mine] = frames.matrix[np.searchsorted(parts, own[mine])]
    return LocalFrames(polygons.centroids, matrix)
