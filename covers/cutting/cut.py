"""Cutting: mathematical cover x material x discontinuities = elements and physical covers.

All lines (edges of the cells that are touched, boundaries of regions, cracks) are put into one
plane graph, in which points within 2^-46 of the model's extent are one
(`covers.cutting.resolution`, `covers.cutting.plane_graph`). Everything after that is topology:
faces are elements, shared edges connect them, and physical covers are connected components (Shi
1991; Terada, Asai and Yamagishi 2003). Nothing is decided by comparing lengths or areas. Cells that
no line touches keep their shape.

100 000 triangles with 2 600 cut elements take 0.4 s of one core, 1 000 blocks on 10 000 triangles
0.3 s (`benchmarks/bench_cutting.py`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from covers.cutting.cracks import crack_segments
from covers.cutting.cut_cells import CutCells, assembled
from covers.cutting.domain import domain_of
from covers.cutting.layers.arranged import arranged
from covers.cutting.layers.lines import TOUCHING_STEPS, CutLines, lines_of
from covers.cutting.resolution import Resolution, resolution_of
from covers.mathematical.base import Cover
from integration.arrays import Floats, Ints
from integration.polygons import Polygons, diameters

# Cells must be larger than this many steps of the resolution.
COARSE = 1e4


@dataclass(frozen=True, eq=False)
class Cutting:
    """A cut with what it was made of, from which a cut by longer cracks may go on.

    Attributes
    ----------
    cover : Cover
    regions : Polygons
        as they were given.
    group : (R,)
        regions of one number share physical covers.
    resolution : Resolution
    moved : float
        greatest distance by which cracks are moved, m.
    tolerance, smallest, rounding : float
        see `cut`.
    layers : tuple of CutLines
    cells : CutCells
        what came of it.
    """

    cover: Cover
    regions: Polygons
    group: Ints
    resolution: Resolution
    moved: float
    tolerance: float
    smallest: float
    rounding: float
    layers: tuple[CutLines, ...]
    cells: CutCells


def cut(
    cover: Cover,
    regions: Polygons | npt.ArrayLike,
    cracks: Sequence[npt.ArrayLike] = (),
    *,
    glue: npt.ArrayLike | None = None,
    tolerance: float = 1e-8,
    smallest: float = 1e-15,
    rounding: float = 0.0,
) -> CutCells:
    """Cut a mathematical cover by regions of material and by cracks.

    Parameters
    ----------
    cover : Cover
        cells and patches; must reach around all regions.
    regions : Polygons or array of shapely polygons
        pieces of material. Regions that touch are separate bodies, those that overlap too.
    cracks : sequence of (n, 2)
        polylines in any position: through, ending inside, branching, crossing, along edges of
        cells, through nodes. A crack cuts every region that it runs through.
    glue : (R,), optional
        regions of one number share physical covers across their common boundary: one body of
        several materials.
    tolerance : float
        cracks nearer than this part of the smallest cell's diameter to a vertex of the mesh, a
        corner of a region or another crack's point pass exactly through it, and ends nearer to a
        line end on it. Boundaries of regions are never moved.
    smallest : float
        faces of less than this part of their cell are left out and reported.
    rounding : float
        unit in the last place of the coordinates where they were given, if they were moved from
        there, m: points nearer than a few of it are one.

    Returns
    -------
    CutCells

    Raises
    ------
    ValueError
        Invalid regions or cracks, a cover that does not reach around a region, or cells that are
        too small to be told from rounding.
    """
    given = {"tolerance": tolerance, "smallest": smallest, "rounding": rounding}
    return cutting(cover, regions, cracks, glue=glue, **given).cells


def cutting(
    cover: Cover,
    regions: Polygons | npt.ArrayLike,
    cracks: Sequence[npt.ArrayLike] = (),
    *,
    glue: npt.ArrayLike | None = None,
    tolerance: float = 1e-8,
    smallest: float = 1e-15,
    rounding: float = 0.0,
) -> Cutting:
    """Cut as `cut` does, and return what another cut may go on from as well."""
    polygons = regions if isinstance(regions, Polygons) else Polygons.from_shapely(regions)
    if not len(polygons):
        raise ValueError("regions: none: at least one expected: give the material to be cut")
    resolution = resolution_of(_extremes(cover, polygons), rounding)
    size = diameters(cover.cells)
    if size.min() < COARSE * resolution.step:
        raise ValueError(
            f"cover: cells of {size.min():.2g} m: more than {COARSE * resolution.step:.2g} m "
            "expected at these coordinates: move the model towards the origin or use larger cells"
        )
    domain = domain_of(polygons, glue, TOUCHING_STEPS * resolution.step)
    moved = max(tolerance * float(size.min()), TOUCHING_STEPS * resolution.step)
    segments = crack_segments(cracks)
    layers = tuple(
        lines_of(cover, domain, layer, segments, resolution, moved)
        for layer in range(int(domain.layer.max()) + 1)
    )
    parts = [
        arranged(
            cover,
            lines.cells,
            lines.boundary,
            lines.cracks,
            2 * lines.margin,
            resolution,
            smallest,
            domain.group,
        )
        for lines in layers
    ]
    found = assembled(cover, domain, parts, resolution, moved)
    given = tolerance, smallest, rounding
    return Cutting(cover, polygons, domain.group, resolution, moved, *given, layers, found)


def _extremes(cover: Cover, regions: Polygons) -> Floats:
    """Two corners of the box of the regions and of the cells that may be cut by them."""
    low, high = regions.points.min(axis=0), regions.points.max(axis=0)
    first, last = cover.cell_boxes
    near = ((first <= high) & (last >= low)).all(axis=1)
    if not near.any():
        raise ValueError(
            f"cover: no cell near the regions between {low.tolist()} and {high.tolist()}: a cover "
            "around them expected: make it over these bounds"
        )
    return np.stack(
        [np.minimum(low, first[near].min(axis=0)), np.maximum(high, last[near].max(axis=0))]
    )
