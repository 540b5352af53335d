"""The result of a cut: elements, physical covers, boundary and crack tips of all layers."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
import shapely

from covers.concatenate import concatenate, numbers, starts
from covers.cutting.connectivity import Joins, bodies, physical_covers
from covers.cutting.cut_boundary import CrackTips, CutBoundary
from covers.cutting.domain import Domain
from covers.cutting.pieces import Pieces
from covers.cutting.resolution import Resolution
from covers.mathematical.patch_mesh import PatchMesh
from integration.arrays import Bools, Floats, Ints
from integration.polygons import Polygons

# Uncovered area of a region that is rounding: a share of its area, and a strip along its boundary
# in steps of the resolution.
UNCOVERED = 1e-9
RIM = 8


@dataclass(frozen=True, eq=False)
class CutCells:
    """Elements and physical covers of a cut cover.

    Attributes
    ----------
    elements : Polygons
        E elements, one simple counter-clockwise ring each, in the cover's coordinates. Elements of
        one cell with equal covers are parts of one manifold element, divided by a closure.
    element_cell, element_region, element_body : (E,)
        cell, region, and body (connected part of the material) of each element. Bodies are numbered
        in the order of regions: without cracks, body b is region b if every region is connected.
    element_whole : (E,)
        whether the element is its cell, corner by corner in the cell's order: with
        ``cover.cell_shape`` this says which elements are congruent.
    cell_width : (C,)
        second longest side of each cell of the cover, m.
    covers : (E, k)
        physical covers of each element in the order of ``cover.cell_patches``; padded with -1 for
        meshless covers.
    cover_patch, cover_region, cover_body : (P,)
        patch, region (of the first element) and body of each physical cover, ordered by patch.
    boundary : CutBoundary
        edges of all bodies, crack faces included, with the material on their left.
    tips : CrackTips
        crack tips inside bodies.
    joins : Joins
        pairs of elements that share a part of an edge without a discontinuity.
    step : float
        resolution: points and lines nearer to each other than this are merged, m.
    crack_tolerance : float
        largest distance by which cracks may be moved onto vertices and lines, m.
    slivers, sliver_area
        number and total area (m2) of the faces left out because they are too small.
    """

    elements: Polygons
    element_cell: Ints = field(metadata=numbers("cell"))
    element_region: Ints
    element_body: Ints = field(metadata=numbers("body"))
    element_whole: Bools
    cell_width: Floats
    covers: Ints = field(metadata=numbers("cover"))
    cover_patch: Ints = field(metadata=numbers("patch"))
    cover_region: Ints
    cover_body: Ints = field(metadata=numbers("body"))
    boundary: CutBoundary
    tips: CrackTips
    joins: Joins
    step: float
    crack_tolerance: float
    slivers: int
    sliver_area: float

    @property
    def n_covers(self) -> int:
        """Number of physical covers."""
        return len(self.cover_patch)

    @property
    def tip_cell_width(self) -> Floats:
        """Width of the cell about each tip (n,), m."""
        return np.asarray(self.cell_width[self.element_cell[self.tips.element]])

    @property
    def n_bodies(self) -> int:
        """Number of bodies."""
        return int(self.element_body.max(initial=-1)) + 1


@dataclass(frozen=True)
class Layer:
    """The cut of one layer of regions; elements are numbered within it."""

    pieces: Pieces
    joins: Joins
    boundary: CutBoundary
    tips: CrackTips
    touched: Bools


def assembled(
    cover: PatchMesh, domain: Domain, layers: list[Layer], resolution: Resolution, moved: float
) -> CutCells:
    """Merge all layers: elements one after the other, then covers and bodies of all."""
    pieces = [layer.pieces for layer in layers]
    elements = Polygons.concatenate([part.elements for part in pieces])
    cell = np.concatenate([part.cell for part in pieces])
    region = np.concatenate([part.region for part in pieces])
    _check_covered(domain, elements, region, pieces, resolution)
    first = starts([len(part.cell) for part in pieces])
    offsets = {"element": first, "edge": starts([len(layer.boundary) for layer in layers])}
    joins = concatenate([layer.joins for layer in layers], offsets)
    body = bodies(len(cell), region, joins)
    touched = np.logical_or.reduce([layer.touched for layer in layers])
    unnumbered = np.concatenate([layer.boundary.body for layer in layers])
    boundary = concatenate([layer.boundary for layer in layers], offsets, body=unnumbered)
    parts = physical_covers(cover, elements, cell, region, joins, touched)
    return CutCells(
        elements=elements,
        element_cell=cell,
        element_region=region,
        element_body=body,
        element_whole=np.concatenate([part.whole for part in pieces]),
        cell_width=cover.cell_width,
        covers=parts.of_element,
        cover_patch=parts.patch,
        cover_region=region[parts.first],
        cover_body=body[parts.first],
        boundary=replace(boundary, body=body[boundary.element]),
        tips=concatenate([layer.tips for layer in layers], offsets),
        joins=joins,
        step=resolution.step,
        crack_tolerance=moved,
        slivers=sum(part.lost for part in pieces),
        sliver_area=sum(part.lost_area for part in pieces),
    )


def _check_covered(
    domain: Domain, elements: Polygons, region: Ints, pieces: list[Pieces], resolution: Resolution
) -> None:
    wanted = domain.regions.areas
    found = np.bincount(region, elements.areas, minlength=len(domain))
    lost = sum(part.lost_area for part in pieces)
    rounding = RIM * resolution.step * np.asarray(shapely.length(domain.shapes))
    short = np.abs(found - wanted) > UNCOVERED * wanted + rounding + lost
    if short.any():
        n = int(np.flatnonzero(short)[0])
        raise ValueError(
            f"region {n}: cells cover an area of {found[n]:.12g} of {wanted[n]:.12g}: a cover that "
            "reaches around it expected: make the cover over larger bounds"
        )
