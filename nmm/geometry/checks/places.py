"""Checks of the places of supports, loads and monitors against the blocks."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import shapely

from integration.arrays import Floats, Ints
from nmm.errors import Fault
from nmm.geometry.blocks import Regions
from nmm.geometry.checks.supports import doubled_supports
from nmm.geometry.places import edges_on, polygons_at, tolerance
from nmm.scene.actions import SupportTable
from nmm.scene.model import Scene
from nmm.scene.monitors import MonitorTable
from nmm.scene.tables.loading.loads import LoadTable

_Finding = tuple[str, str, str]  # value, expected, remedy
_COVERED = 1e-6  # of a loaded segment's length


def place_faults(scene: Scene, whole: Regions) -> list[Fault]:
    """Supports, loads and monitors whose place touches no block, or whose block does not exist."""
    items: list[tuple[str, int, SupportTable | LoadTable | MonitorTable]] = []
    items += [("supports", k, item) for k, item in enumerate(scene.supports)]
    items += [("loads", k, item) for k, item in enumerate(scene.loads)]
    items += [("monitors", k, item) for k, item in enumerate(scene.monitors)]
    found = [
        Fault(scene.source.place(key, index), *finding)
        for key, index, item in items
        for finding in _findings(item, whole)
    ]
    return [
        *found,
        *_named_pieces(scene, whole),
        *_given_twice(scene, whole),
        *_cracks(scene, whole),
        *doubled_supports(scene, whole),
    ]


def _findings(item: SupportTable | LoadTable | MonitorTable, whole: Regions) -> Iterator[_Finding]:
    chosen = whole.select(item.block)
    if not len(chosen):
        yield _no_block(item.block)
    elif item.point is not None:
        yield from _point_findings(item, whole, chosen)
    elif not isinstance(item, MonitorTable) and item.segment is not None:
        yield from _segment_findings(item, whole, chosen)


def _started(scene: Scene) -> dict[str, list[str]]:
    """Blocks that tables of velocities and stresses at the start name, by key."""
    return {
        "initial_velocities": [item.block for item in scene.initial_velocities],
        "initial_stresses": [item.block for item in scene.initial_stresses],
    }


def _named_pieces(scene: Scene, whole: Regions) -> Iterator[Fault]:
    """The reader knows names of blocks; names of pieces such as "beam.200" are known only here."""
    for key, blocks in _started(scene).items():
        for index, block in enumerate(blocks):  # a table after the other, to name its place
            if not len(whole.select(block)):
                yield Fault(scene.source.place(key, index), *_no_block(block))


def _given_twice(scene: Scene, whole: Regions) -> Iterator[Fault]:
    """Velocities and stresses at the start that one block has from two tables."""
    for key, blocks in _started(scene).items():
        first = np.full(len(whole), -1)
        for index, block in enumerate(blocks):  # a table after the other
            chosen = whole.select(block)
            twice = chosen[first[chosen] >= 0]
            if len(twice):
                before = f"{key}.{first[twice[0]]}"
                value = f'block "{whole.name[twice[0]]}" has one from {before} already'
                remedy = "keep one of them, or name blocks in place of all"
                yield Fault(scene.source.place(key, index), value, "one for each block", remedy)
            first[chosen] = index


def _cracks(scene: Scene, whole: Regions) -> Iterator[Fault]:
    """Cracks that cut nothing."""
    if not scene.cracks:
        return
    lines = [shapely.LineString(crack.points) for crack in scene.cracks]
    tree = shapely.STRtree(list(whole.polygons.to_shapely()))
    within = tolerance(whole.polygons.points)
    for index, line in enumerate(lines):
        place = scene.source.place("cracks", index, "points")
        if line.length <= within:
            value = f"a line of length {line.length:.3g} m"
            yield Fault(place, value, "a length", "correct its points")
            continue
        near = tree.geometries[tree.query(line, predicate="intersects")]
        inside = shapely.length(shapely.intersection(near, line)).sum()
        if inside <= within:
            value = f"the crack lies outside of all blocks, from {list(line.coords[0])}"
            yield Fault(place, value, "a crack inside a block", "move it onto a block")


def _no_block(block: str | None) -> _Finding:
    remedy = "name the whole block, or a piece that exists"
    return f'"{block}"', "the name of a block or of a piece", remedy


def _point_findings(
    item: SupportTable | LoadTable | MonitorTable, whole: Regions, chosen: Ints
) -> Iterator[_Finding]:
    point = np.asarray(item.point)
    polygons = whole.polygons.take(chosen)
    if len(polygons_at(polygons, point, tolerance(whole.polygons.points))):
        return
    away = shapely.distance(polygons.to_shapely(), shapely.Point(point))
    nearest = whole.name[chosen[int(np.argmin(away))]]
    value = f'point {point.tolist()} is {away.min():.3g} m away from the nearest block "{nearest}"'
    yield value, "a point of a block", "correct the point or the block"


def _segment_findings(
    item: SupportTable | LoadTable, whole: Regions, chosen: Ints
) -> Iterator[_Finding]:
    polygons = whole.polygons.take(chosen)
    segment: Floats = np.asarray(item.segment)
    length = float(np.hypot(*(segment[1] - segment[0])))
    within = tolerance(whole.polygons.points)
    if length <= within:
        yield f"segment of length {length:.3g} m", "a length", "correct its ends"
        return
    end = polygons.points[polygons.next_point]
    covered = float(edges_on(polygons.points, end, segment, within).lengths.sum()) / length
    if covered == 0:
        value = f"segment {segment.tolist()} lies on no edge"
        yield value, "a segment on edges of blocks", "correct its ends"
    elif isinstance(item, LoadTable) and covered < 1 - _COVERED:
        value = f"{covered:.3%} of the segment lies on edges"
        remedy = "shorten it to the edges, so that the whole load acts"
        yield value, "all of a loaded segment", remedy
    elif isinstance(item, LoadTable) and covered > 1 + _COVERED:
        value = "the segment lies on edges of both sides of a joint"
        yield value, "edges of one side", "name the loaded block by block = ..."
