"""Cutting: mathematical cover x material x discontinuities = elements and physical covers.

All lines (edges of the cells that are touched, boundaries of regions, cracks) are put into one
plane graph, in which points within 2^-46 of the model's extent are one (`covers.resolution`,
`covers.noding`).
Everything after that is topology: faces are elements, shared edges connect them, and physical
covers are connected components (Shi 1991; Terada, Asai and Yamagishi 2003). Nothing is decided by
comparing lengths or areas. Cells that no line touches are never cut and keep their shape.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt
import shapely

from covers.base import Cover
from covers.closures import closed_faces
from covers.connectivity import Joins, bodies, physical_covers
from covers.cracks import clipped, crack_segments, settled
from covers.cut_boundary import CrackTips, CutBoundary, boundary_of
from covers.cut_pieces import Pieces, joins_of, pieces_of
from covers.domain import Domain, Segments, domain_of
from covers.faces import BOUNDARY, CRACK, MESH, Cells, Sources
from covers.noding import lines_between, node
from covers.resolution import Resolution, resolution_of
from covers.touched_cells import cell_boxes, region_of_cells, touched_cells
from integration.arrays import Bools, Floats, Ints
from integration.polygons import Polygons, diameters

# Lines within this many steps of the resolution of a cell touch it.
TOUCH = 8
# Cells must be larger than this many steps of the resolution.
COARSE = 1e4
# Part of a region's area that may stay uncovered through rounding.
UNCOVERED = 1e-9


@dataclass(frozen=True, eq=False)
class CutCells:
    """Elements and physical covers of a cut cover.

    Attributes
    ----------
    elements : Polygons
        E elements, one simple counter-clockwise ring each, in the cover's coordinates. Elements of
        one cell with equal covers are parts of one manifold element, divided by a closure.
    element_cell, element_region, element_body : (E,)
        cell, region, and connected piece of material of each element. Bodies are numbered in the
        order of regions: without cracks body b is region b when every region is connected.
    element_whole : (E,)
        whether the element is its cell, corner by corner in the cell's order: with
        ``cover.cell_shape`` this says which elements are congruent.
    covers : (E, k)
        physical covers of each element in the order of ``cover.cell_patches``; -1 fills up rows of
        meshless covers.
    cover_patch, cover_region, cover_body : (P,)
        patch, region (of the first element) and body of each physical cover, ordered by patch.
    boundary : CutBoundary
        edges of all bodies, faces of cracks included, the material on the left hand.
    tips : CrackTips
        ends of cracks inside bodies.
    step : float
        resolution: points and lines nearer than this are one, m.
    crack_tolerance : float
        greatest distance by which cracks were moved onto vertices and lines, m.
    slivers, sliver_area
        number and total area (m2) of faces below the smallest area, left out.
    """

    elements: Polygons
    element_cell: Ints
    element_region: Ints
    element_body: Ints
    element_whole: Bools
    covers: Ints
    cover_patch: Ints
    cover_region: Ints
    cover_body: Ints
    boundary: CutBoundary
    tips: CrackTips
    step: float
    crack_tolerance: float
    slivers: int
    sliver_area: float

    @property
    def n_covers(self) -> int:
        """Number of physical covers."""
        return len(self.cover_patch)

    @property
    def n_bodies(self) -> int:
        """Number of connected pieces of material."""
        return int(self.element_body.max(initial=-1)) + 1


@dataclass(frozen=True)
class _Layer:
    pieces: Pieces
    joins: Joins
    boundary: CutBoundary
    tips: CrackTips
    touched: Bools


def cut(
    cover: Cover,
    regions: Polygons | npt.ArrayLike,
    cracks: Sequence[npt.ArrayLike] = (),
    *,
    glue: npt.ArrayLike | None = None,
    tolerance: float = 1e-8,
    smallest: float = 1e-15,
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

    Returns
    -------
    CutCells

    Raises
    ------
    ValueError
        Invalid regions or cracks, a cover that does not reach around a region, or cells that are
        too small to be told from rounding.
    """
    polygons = regions if isinstance(regions, Polygons) else Polygons.from_shapely(regions)
    if not len(polygons):
        raise ValueError("regions: none: at least one expected: give the material to be cut")
    resolution = resolution_of(_extremes(cover, polygons))
    size = diameters(cover.cells)
    if size.min() < COARSE * resolution.step:
        raise ValueError(
            f"cover: cells of {size.min():.2g} m: more than {COARSE * resolution.step:.2g} m "
            "expected at these coordinates: move the model towards the origin or use larger cells"
        )
    domain = domain_of(polygons, glue, TOUCH * resolution.step)
    moved = max(tolerance * float(size.min()), TOUCH * resolution.step)
    layers = [
        _cut_layer(cover, domain, layer, crack_segments(cracks), resolution, moved, smallest, size)
        for layer in range(int(domain.layer.max()) + 1)
    ]
    return _assembled(cover, domain, layers, resolution, moved)


def _extremes(cover: Cover, regions: Polygons) -> Floats:
    """Two corners of the box of the regions and of the cells that may be cut by them."""
    low, high = regions.points.min(axis=0), regions.points.max(axis=0)
    corners = cover.vertices[cover.cell_vertices]
    first, last = corners.min(axis=1), corners.max(axis=1)
    near = ((first <= high) & (last >= low)).all(axis=1)
    if not near.any():
        raise ValueError(
            f"cover: no cell near the regions between {low.tolist()} and {high.tolist()}: a cover "
            "around them expected: make it over these bounds"
        )
    return np.stack(
        [np.minimum(low, first[near].min(axis=0)), np.maximum(high, last[near].max(axis=0))]
    )


def _cut_layer(
    cover: Cover,
    domain: Domain,
    layer: int,
    cracks: Segments,
    resolution: Resolution,
    tolerance: float,
    smallest: float,
    size: Floats,
) -> _Layer:
    boundary = domain.boundary(layer)
    members = np.flatnonzero(domain.layer == layer)
    low, high = boundary.start.min(axis=0), boundary.start.max(axis=0)
    margin = float(size.max())
    cracks = clipped(cracks, low - margin, high + margin)

    boxes, chop = cell_boxes(cover), float(np.median(size))
    near = touched_cells(cover, boxes, cracks, 3 * tolerance, chop)
    touched = near | touched_cells(cover, boxes, boundary, TOUCH * resolution.step, chop)
    cracks = _settled(cover, cracks, boundary, near, tolerance)
    cells = Cells(cover.edges, touched, region_of_cells(cover, domain.shapes, members))

    mesh = np.unique(cover.edges.of_cell[touched])
    lines = [_mesh_segments(cover, mesh), boundary, cracks]
    sources = Sources(
        np.repeat([MESH, BOUNDARY, CRACK], [len(part) for part in lines]),
        np.concatenate([part.owner for part in lines]),
    )
    start = np.concatenate([part.start for part in lines])
    end = np.concatenate([part.end for part in lines])
    count = np.arange(len(start))
    graph = lines_between(np.concatenate([start, end]), resolution, count, count + len(start))
    graph = node(graph, count >= len(mesh), resolution)
    faces = closed_faces(graph, sources, cells, resolution, 2 * margin)

    pieces = pieces_of(cover, cells, faces, smallest, resolution.step)
    joins = joins_of(cover, cells, faces, pieces, domain.group)
    edges, tips = boundary_of(faces, pieces, domain.group)
    return _Layer(pieces, joins, edges, tips, touched)


def _settled(
    cover: Cover, cracks: Segments, boundary: Segments, near: Bools, tolerance: float
) -> Segments:
    vertices = np.unique(cover.cell_vertices[near])
    edges = _mesh_segments(cover, np.unique(cover.edges.of_cell[near]))
    return settled(cracks, boundary, cover.vertices[vertices], edges, tolerance)


def _mesh_segments(cover: Cover, edges: Ints) -> Segments:
    start, end = cover.edges.start[edges], cover.edges.end[edges]
    return Segments(cover.vertices[start], cover.vertices[end], edges)


def _assembled(
    cover: Cover, domain: Domain, layers: list[_Layer], resolution: Resolution, moved: float
) -> CutCells:
    """All layers as one: elements one after the other, then covers and bodies over all."""
    pieces = [layer.pieces for layer in layers]
    elements = Polygons.concatenate([part.elements for part in pieces])
    cell = np.concatenate([part.cell for part in pieces])
    region = np.concatenate([part.region for part in pieces])
    _check_covered(domain, elements, region, pieces, resolution)
    first = np.cumsum([0] + [len(part.cell) for part in pieces])[:-1]
    joins = Joins(
        np.concatenate([layer.joins.first + n for layer, n in zip(layers, first, strict=True)]),
        np.concatenate([layer.joins.second + n for layer, n in zip(layers, first, strict=True)]),
        np.concatenate([layer.joins.start for layer in layers]),
        np.concatenate([layer.joins.end for layer in layers]),
    )
    body = bodies(len(cell), region, joins)
    touched = np.logical_or.reduce([layer.touched for layer in layers])
    parts = physical_covers(cover, elements, cell, region, joins, touched)
    return CutCells(
        elements=elements,
        element_cell=cell,
        element_region=region,
        element_body=body,
        element_whole=np.concatenate([part.whole for part in pieces]),
        covers=parts.of_element,
        cover_patch=parts.patch,
        cover_region=region[parts.first],
        cover_body=body[parts.first],
        boundary=_one_boundary([layer.boundary for layer in layers], first, body),
        tips=_all_tips([layer.tips for layer in layers], first),
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
    rounding = TOUCH * resolution.step * np.asarray(shapely.length(domain.shapes))
    short = np.abs(found - wanted) > UNCOVERED * wanted + rounding + lost
    if short.any():
        n = int(np.flatnonzero(short)[0])
        raise ValueError(
            f"region {n}: cells cover an area of {found[n]:.12g} of {wanted[n]:.12g}: a cover that "
            "reaches around it expected: make the cover over larger bounds"
        )


def _one_boundary(parts: list[CutBoundary], first_element: Ints, body: Ints) -> CutBoundary:
    first = np.cumsum([0] + [len(part) for part in parts])[:-1]
    shifted = [
        replace(
            part,
            element=part.element + element,
            next=part.next + edge,
            previous=part.previous + edge,
            opposite=np.where(part.opposite >= 0, part.opposite + edge, -1),
        )
        for part, element, edge in zip(parts, first_element, first, strict=True)
    ]
    names = ("start", "end", "element", "body", "next", "previous", "crack", "opposite")
    whole = CutBoundary(
        **{name: np.concatenate([getattr(part, name) for part in shifted]) for name in names}
    )
    return replace(whole, body=body[whole.element])


def _all_tips(parts: list[CrackTips], first_element: Ints) -> CrackTips:
    return CrackTips(
        np.concatenate([part.point for part in parts]),
        np.concatenate([part.direction for part in parts]),
        np.concatenate([part.element + n for part, n in zip(parts, first_element, strict=True)]),
        np.concatenate([part.crack for part in parts]),
    )
