"""Regions cut into blocks by joints that may end, cross and almost coincide."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely

from integration.arrays import Floats, Ints
from integration.polygons import Polygons
from nmm.errors import Fault, GeometryError
from nmm.geometry.tessellation.faces import Shapes, faces_and_dangles, owners
from nmm.geometry.tessellation.scraps import absorb
from nmm.geometry.tessellation.short_edges import collapse_short_edges

# All in sizes of the regions' extent.
_REACH = 1e-6  # joints this close to a vertex or an edge were meant to meet it
_THIN = 1e-6  # faces of less mean width lie between joints that were meant to coincide
_GRID = 2.0**-40  # to which crossings are rounded; a power of two keeps its multiples exact


@dataclass(frozen=True)
class Cut:
    """Regions cut by joints.

    Attributes
    ----------
    polygons
        The blocks, those of one region together; neighbours share their vertices bit by bit.
    region : (N,)
        Region of each block.
    cracks : (m, 2, 2)
        Parts of joints that end inside a block.
    """

    polygons: Polygons
    region: Ints
    cracks: Floats


def cut(regions: Polygons, joints: Floats) -> Cut:
    """Cut regions by segments.

    Joints that pass a vertex of a region, or end short of an edge, by less than 1e-6 of the extent
    of all regions are drawn to it; blocks thinner than that go to a neighbour; crossings are known
    to 1e-12 of it. Vertices of regions stay exactly and crossings with their edges lie on them, so
    that the area of each region is kept.

    Parameters
    ----------
    regions
        Polygons that do not overlap.
    joints : (m, 2, 2)
        Segments, through one region or many.

    Raises
    ------
    GeometryError
        Joints almost coincide in such a way that a block touches itself.
    """
    low, size = regions.points.min(axis=0), regions.extent
    local = regions.with_points((regions.points - low) / size)
    shapes = local.to_shapely()
    found, dangles = faces_and_dangles(_lines(local, shapes, (joints - low) / size), _GRID)
    owner = owners(shapely.point_on_surface(found), shapes)
    found, owner = found[owner >= 0], owner[owner >= 0]
    thick = 2 * shapely.area(found) > _THIN * shapely.length(found)
    found, kept = absorb(found, thick, owner)
    order = np.argsort(owner[kept], kind="stable")
    blocks = Polygons.from_shapely(found[order]).oriented()
    cracks = _segments(dangles)
    cracks = cracks[np.hypot(*(cracks[:, 1] - cracks[:, 0]).T) > 2 * _REACH]
    cracks = cracks[owners(shapely.points(cracks.mean(axis=1)), shapes) >= 0]
    owner = owner[kept][order]
    blocks = blocks.with_points(_in_place(low + size * blocks.points, regions, _GRID * size))
    blocks = collapse_short_edges(blocks, _REACH * size, regions.points, owner)
    blocks = blocks.oriented()
    _refuse_unsound(blocks)
    return Cut(blocks, owner, low + size * cracks)


def _refuse_unsound(blocks: Polygons) -> None:
    shapes = blocks.to_shapely()
    bad = np.flatnonzero(~shapely.is_valid(shapes))
    if len(bad):
        where = str(shapely.is_valid_reason(shapes[bad[0]]))
        remedy = "joints almost coincide there: move or remove one of them, or use another seed"
        raise GeometryError(Fault("joints", where, "blocks with simple outlines", remedy))


def _lines(regions: Polygons, shapes: Shapes, joints: Floats) -> Shapes:
    """Outlines, and joints drawn to the vertices and edges that they were meant to meet."""
    step = joints[:, 1] - joints[:, 0]
    step = _REACH * step / np.hypot(*step.T)[:, None]
    longer = joints + np.stack([-step, step], axis=1)
    drawn = shapely.snap(shapely.linestrings(longer), shapely.MultiPoint(regions.points), _REACH)
    return np.concatenate([shapely.boundary(shapes), drawn])


def _in_place(points: Floats, regions: Polygons, grid: float) -> Floats:
    """Rounded points moved back to the vertices, else to the edges of regions that they are on."""
    moved = points.copy()
    start, end = regions.points, regions.points[regions.next_point]
    edges = shapely.STRtree(_listed(shapely.linestrings(np.stack([start, end], axis=1))))
    which, edge = edges.query_nearest(
        shapely.points(points), max_distance=1.5 * grid, all_matches=False
    )
    step = (end - start)[edge]
    t = np.sum((points[which] - start[edge]) * step, axis=1) / np.sum(step**2, axis=1)
    moved[which] = start[edge] + np.clip(t, 0, 1)[:, None] * step
    vertices = shapely.STRtree(_listed(shapely.points(start)))
    which, vertex = vertices.query_nearest(
        shapely.points(points), max_distance=0.8 * grid, all_matches=False
    )
    moved[which] = start[vertex]
    return moved


def _listed(shapes: Any) -> list[Any]:
    """For the tree, whose annotations know lists only."""
    return list(shapes)


def _segments(lines: Shapes) -> Floats:
    points, line = shapely.get_coordinates(lines, return_index=True)
    follows = np.flatnonzero(line[1:] == line[:-1])
    return np.stack([points[follows], points[follows + 1]], axis=1)
