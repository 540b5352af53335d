"""Supports that hold the same material twice."""

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


def doubled_supports(scene: Scene, whole: Regions) -> Iterator[Fault]:
    """Yield a fault for every two supports that hold a place along the same axis, where that errs.

    A support of a whole block prescribes the way of all its points. Two segments hold one place
    where they share a length, a point meets what holds it. Two that prescribe the same way are
    refused where both are segments, as each would take all of the traction there. What no stage
    has at once does not count.
    """
    within = tolerance(whole.polygons.points)
    pairs = combinations(enumerate(scene.supports), 2)
    for (_, one), (index, other) in pairs:  # a handful of supports
        axes = [axis for axis in one.fix if axis in other.fix]
        apart = [axis for axis in axes if _ways_differ(one, other, axis)]
        edges = one.segment is not None and other.segment is not None
        errs = bool(apart or (axes and edges)) and _at_once(scene, {one.name, other.name})
        if not (errs and _meet(one, other, whole, within)):
            continue
        value = f'"{other.name}" and "{one.name}" hold one '
        value += "place at two displacements" if apart else f"edge along {axes[0]}"
        expected = "one displacement" if apart else "one support of an edge along an axis"
        remedy = f"keep one of them, or let only one fix {(apart or axes)[0]}"
        yield Fault(scene.source.place("supports", index), value, expected, remedy)


def _at_once(scene: Scene, names: set[str]) -> bool:
    """Whether supports act together: in any stage, where the scene has some."""
    listed = [stage.supports for stage in scene.stages] or [None]
    return any(one is None or names <= set(one) for one in listed)


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
