"""Degrees that vary from cover to cover: ``[[cover.regions]]`` of a formulation."""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import shapely

from covers.local_functions.polynomials import Kinds, LocalFunctions
from integration.arrays import Bools, Floats
from nmm.errors import FormulationError

if TYPE_CHECKING:
    from covers.cutting.cut_cells import CutCells
    from nmm.formulation import CoverRegion, CoverTable
    from nmm.geometry.blocks import Regions


def kinds_by_region(
    regions: "Regions", cut: "CutCells", cover: "CoverTable", functions: LocalFunctions
) -> Kinds:
    """Return the local functions of each cover: those of the last region that holds it.

    Raises
    ------
    FormulationError
        A polygon without area or one that crosses itself, an unknown block, a region in which no
        cover lies.
    """
    degree = np.full(cut.n_covers, functions.degree)
    centre = cover_centroids(cut)
    for number, item in enumerate(cover.regions or ()):  # a handful of regions
        inside = _inside(item, number, regions, cut, centre)
        if not inside.any():
            raise FormulationError(
                f"[[cover.regions]] {number}: no cover in it: expected a place in the material, "
                f"about as large as a cell of {cover.size:g} m: move or enlarge it"
            )
        degree[inside] = item.degree
    degrees, which = np.unique(degree, return_inverse=True)
    kinds = tuple(replace(functions, degree=one) for one in degrees.tolist())
    return Kinds(kinds, which.ravel())


def cover_centroids(cut: "CutCells") -> Floats:
    """Centroids (C, 2) of the material of each cover (m)."""
    element, slot = np.nonzero(cut.covers >= 0)
    cover = cut.covers[element, slot]
    area = cut.elements.areas[element]
    moment = area[:, None] * cut.elements.centroids[element]
    total = np.bincount(cover, area, minlength=cut.n_covers)
    sums = [np.bincount(cover, column, minlength=cut.n_covers) for column in moment.T]
    return np.stack(sums, axis=1) / total[:, None]


def _inside(
    item: "CoverRegion", number: int, regions: "Regions", cut: "CutCells", centre: Floats
) -> Bools:
    if item.polygon is not None:
        shape = shapely.Polygon(item.polygon)
        if not shape.is_valid:
            reason = shapely.is_valid_reason(shape)
            raise FormulationError(
                f"[[cover.regions]] {number}: polygon: {reason}: expected a ring that does not "
                "cross itself: correct its corners"
            )
        return np.asarray(shapely.intersects_xy(shape, *centre.T))
    if item.point is not None:
        assert item.radius is not None
        return np.asarray(np.hypot(*(centre - np.array(item.point)).T) <= item.radius)
    chosen = regions.select(item.block)
    if not len(chosen):
        raise FormulationError(
            f"[[cover.regions]] {number}: block {item.block}: no block of that name: expected one "
            "of the scene: correct the name"
        )
    return np.asarray(np.isin(cut.cover_region, chosen))
