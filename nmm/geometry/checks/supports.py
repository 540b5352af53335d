"""Supports that prescribe two displacements of the same material."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

import numpy as np
import shapely

from integration.arrays import Ints
from nmm.errors import Fault
from nmm.geometry.blocks import Regions
from nmm.geometry.places import edges_on, tolerance
from nmm.scene.actions import SupportTable
from nmm.scene.model import Scene


def contradicting_supports(scene: Scene, whole: Regions) -> Iterator[Fault]:
    """Yield a fault for every two supports that prescribe different displacements of a place.

    A support of a whole block prescribes the way of all its points. Two segments contradict each
    other where they share a length, a point contradicts what holds it.
    """
    moving = [n for n, item in enumerate(scene.supports) if any(item.displacement)]
    if not moving:
        return
    within = tolerance(whole.polygons.points)
    pairs = combinations(enumerate(scene.supports), 2)
    for (_, one), (index, other) in pairs:  # a handful of supports
        axes = [axis for axis in one.fix if axis in other.fix and _ways_differ(one, other, axis)]
        if axes and _meet(one, other, whole, within):
            value = f'"{other.name}" and "{one.name}" hold one place at two displacements'
            remedy = f"keep one of them, or let only one fix {axes[0]}"
            yield Fault(scene.source.place("supports", index), value, "one displacement", remedy)


def _ways_differ(one: SupportTable, other: SupportTable, axis: str) -> bool:
    number = "xy".index(axis)
    ways = [(item.displacement[number], item.history) for item in (one, other)]
    if not any(way for way, _ in ways):
        return False
    return ways[0] != ways[1]


def _meet(one: SupportTable, other: SupportTable, whole: Regions, within: float) -> bool:
    common = np.intersect1d(whole.select(one.block), whole.select(other.block))
    if not len(common):
        return False
    first, second = (_shape(item) for item in (one, other))
    if first is None or second is None:
        item = one if first is not None else other
        return first is second or _held(item, common, whole, within)
    if one.segment is not None and other.segment is not None:
        shared = shapely.intersection(shapely.buffer(first, within), second)
        return bool(shapely.length(shared) > 4 * within)
    return bool(shapely.distance(first, second) <= within)


def _held(item: SupportTable, common: Ints, whole: Regions, within: float) -> bool:
    """Whether a support at a point or segment acts on some of the blocks and on no others."""
    if item.segment is None:
        near = (
            shapely.distance(whole.polygons.to_shapely(), shapely.Point(item.point or ())) <= within
        )
        return bool(near[common].any() and near.sum() == near[common].sum())
    polygons, segment = whole.polygons.take(common), np.array(item.segment)
    end = polygons.points[polygons.next_point]
    length = float(np.hypot(*(segment[1] - segment[0])))
    return length > within and bool(len(edges_on(polygons.points, end, segment, within).edge))


def _shape(item: SupportTable) -> shapely.Geometry | None:
    if item.point is not None:
        return shapely.Point(item.point)
    return None if item.segment is None else shapely.LineString(item.segment)
