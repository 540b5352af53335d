"""Parts of edges on which the tables of a scene act."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from covers.approximation.manifold import Manifold
from covers.cutting.cut_boundary import CutBoundary
from integration.arrays import Bools, Floats
from nmm.assembly.places import NEAR, along_segment
from nmm.effects.base import Setup
from nmm.geometry.places import EdgeParts

if TYPE_CHECKING:
    from nmm.scene.actions import PlacedTable
    from nmm.scene.tables.members import FoundationTable
    from nmm.scene.tables.shaking.boundaries import FreeFieldTable, ViscousBoundaryTable

    OnFaces = PlacedTable | FoundationTable | FreeFieldTable | ViscousBoundaryTable


def acting_tables(setup: Setup) -> "Iterator[tuple[OnFaces, bool]]":
    """Yield the tables of a scene that act on faces, and whether they hold them."""
    scene = setup.scene
    for load in scene.loads:
        if load.kind != "body":
            yield load, False
    for water in scene.water_pressures:
        yield water, False
    for tables in (scene.supports, scene.foundations, scene.viscous_boundaries, scene.free_fields):
        for table in tables:
            yield table, True


def acted_edge_parts(setup: Setup, table: "OnFaces") -> EdgeParts:
    """Return where a table acts: at its point, along its segment, or on all edges of a block."""
    manifold, regions = setup.model.manifold, setup.regions(table.block)
    if (point := getattr(table, "point", None)) is not None:
        return _at_point(manifold, np.array(point), regions)
    if table.segment is not None:
        return EdgeParts(*along_segment(manifold, np.array(table.segment), regions))
    boundary = manifold.boundary
    chosen = np.ones(len(boundary), dtype=bool)
    if regions is not None:
        chosen &= regions[manifold.element_region[boundary.element]]
    if (crack := getattr(table, "crack", None)) is not None:
        chosen &= crack_faces(setup, crack)
    index = np.flatnonzero(chosen)
    return EdgeParts(index, boundary.start[index], boundary.end[index])


def _at_point(manifold: Manifold, point: Floats, regions: Bools | None) -> EdgeParts:
    """Return a point as parts without length of the edges of a single body that pass it."""
    edges, near = manifold.boundary, NEAR * manifold.elements.extent
    way = edges.end - edges.start
    size = np.sum(way * way, axis=1)
    share = np.clip(np.sum((point - edges.start) * way, axis=1) / size, 0.0, 1.0)
    passed = np.hypot(*(edges.start + share[:, None] * way - point).T) <= near
    if regions is not None:
        passed &= regions[manifold.element_region[edges.element]]
    index = np.flatnonzero(passed)
    if len(np.unique(manifold.element_body[edges.element[index]])) != 1:
        index = index[:0]
    there = np.tile(point, (len(index), 1))
    return EdgeParts(index, there, there)


def crack_faces(setup: Setup, name: str) -> Bools:
    """Return which edges (n,) of the boundary are faces of a crack."""
    boundary = setup.model.cut.boundary
    number = [crack.name for crack in setup.scene.cracks].index(name)
    if not isinstance(boundary, CutBoundary):
        return np.zeros(len(boundary), dtype=bool)
    return np.asarray(boundary.crack == number)
