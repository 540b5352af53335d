"""Seeded Voronoi tessellation of a polygon with holes."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
import shapely

from integration.arrays import Floats
from integration.polygons import Polygons
from nmm.errors import Fault, GeometryError
from nmm.geometry.places import insert_vertices
from nmm.geometry.tessellation.faces import Shapes, faces, inside
from nmm.geometry.tessellation.scraps import absorb
from nmm.geometry.tessellation.short_edges import collapse_short_edges, edge_lengths


def tessellate(
    region: Polygons,
    blocks: int,
    *,
    seed: int | tuple[int, ...] = 0,
    smoothing: int = 2,
    shortest_edge: float = 0.2,
    keep: npt.ArrayLike = (),
    place: str = "tessellation",
) -> Polygons:
    """Fill a region with Voronoi blocks.

    Parameters
    ----------
    region
        One polygon, with holes or without.
    blocks
        Number of blocks, met exactly.
    seed
        Seed of the points (NumPy's PCG64); the same seed gives the same bytes.
    smoothing
        Number of Lloyd iterations (Lloyd 1982: each point moves to its cell's centroid). 0 leaves
        the irregular cells of independent points.
    shortest_edge
        Edges shorter than this fraction of the mean edge length are collapsed.
    keep : (n, 2)
        Points on the region's boundary that become vertices.
    place
        Name of the region in errors.

    Returns
    -------
    Polygons
        `blocks` polygons; neighbours share their vertices bit by bit, the region's vertices are
        among them, areas sum to that of the region.

    Raises
    ------
    GeometryError
        `region` is not one polygon, `blocks` is not positive, or a kept point is not on the
        boundary.
    """
    if len(region) != 1 or blocks < 1:
        value, remedy = f"{len(region)} regions, {blocks} blocks", "call once for each region"
        raise GeometryError(Fault(place, value, "one region and a positive number", remedy))
    outline = insert_vertices(region, np.asarray(keep, dtype=float).reshape(-1, 2), place)
    # Near the origin, so that a scene far from it loses no digits in the diagram.
    origin = outline.points.min(axis=0)
    local = outline.with_points(outline.points - origin)
    shape = local.to_shapely()[0]
    seeds = _scatter(shape, blocks, np.random.Generator(np.random.PCG64(seed)))
    for _ in range(smoothing):
        seeds = _centred(shape, seeds)
    cells = Polygons.from_shapely(_cells(shape, seeds))
    shortest = shortest_edge * float(edge_lengths(cells).mean())
    cells = collapse_short_edges(cells, shortest, local.points)
    return _moved(cells, origin, local.points, outline.points)


def _scatter(shape: shapely.Polygon, count: int, generator: np.random.Generator) -> Floats:
    """Independent uniform points in a polygon."""
    low, high = np.reshape(shape.bounds, (2, 2))
    found = np.empty((0, 2))
    while len(found) < count:
        trial = low + (high - low) * generator.random((2 * count, 2))
        found = np.concatenate([found, trial[shapely.contains_xy(shape, trial[:, 0], trial[:, 1])]])
    return found[:count]


def _centred(shape: shapely.Polygon, seeds: Floats) -> Floats:
    """Points moved to the centroids of their cells; a centroid outside the region is not used."""
    diagram = shapely.voronoi_polygons(shapely.MultiPoint(seeds), extend_to=shape, ordered=True)
    cells = shapely.intersection(shapely.get_parts(diagram), shape)
    centres = shapely.get_coordinates(shapely.centroid(cells))
    usable = shapely.contains_xy(shape, centres[:, 0], centres[:, 1])
    return np.where(usable[:, None], centres, seeds)


def _cells(shape: shapely.Polygon, seeds: Floats) -> Shapes:
    """One polygon a seed, in the order of the seeds."""
    if len(seeds) == 1:
        return np.array([shape], dtype=object)
    sites = shapely.MultiPoint(seeds)
    edges = shapely.voronoi_polygons(sites, extend_to=shape, only_edges=True)
    found = faces([edges, shape.boundary])
    found = found[inside(found, shape)]
    # A cell that the region's outline cuts into several faces keeps the largest; the others go to
    # neighbours, so that the number of blocks is that of the seeds.
    tree = shapely.STRtree(list(sites.geoms))
    owner = tree.nearest(shapely.point_on_surface(found))
    order = np.lexsort((-shapely.area(found), owner))
    found, owner = found[order], owner[order]
    first = np.concatenate([[True], owner[1:] != owner[:-1]])
    cells, _ = absorb(found, first, np.zeros(len(found), dtype=np.int64))
    if len(cells) != len(seeds):
        lost = np.setdiff1d(np.arange(len(seeds)), owner)
        raise GeometryError(f"tessellation: cells {lost.tolist()} are lost: use another seed")
    return cells


def _moved(cells: Polygons, origin: Floats, local: Floats, world: Floats) -> Polygons:
    """Cells back in place; the outline's own vertices take their given coordinates."""
    given = {tuple(a): b for a, b in zip((local + 0.0).tolist(), world, strict=True)}
    points = cells.points + origin
    for index, point in enumerate(cells.points.tolist()):
        if tuple(point) in given:
            points[index] = given[tuple(point)]
    return cells.with_points(points).oriented()
