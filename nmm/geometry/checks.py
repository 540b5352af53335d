"""Checks of rings, blocks and places; each returns faults, so that all are reported together."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import shapely

from integration.arrays import Floats, Ints
from integration.polygons import Polygons, areas, diameters
from nmm.errors import Fault

_SAME_POINT = 1e-12  # of the block's diameter
_FLAT = 1e-12  # area over squared diameter
OVERLAP = 1e-6  # of the smaller block's area: what coordinates of six digits leave


def ring_faults(rings: Sequence[Sequence[Sequence[float]]], place: Sequence[str]) -> list[Fault]:
    """Faults of one polygon given as [exterior, hole, ...]; `place` names each ring."""
    arrays = [_open(np.asarray(ring, dtype=float)) for ring in rings]
    found = [
        fault for ring, where in zip(arrays, place, strict=True) for fault in _ring(ring, where)
    ]
    return found or list(_holes(arrays, place))


def _open(ring: Floats) -> Floats:
    closed = len(ring) > 3 and np.array_equal(ring[0], ring[-1])
    return ring[:-1] if closed else ring


def _ring(ring: Floats, place: str) -> Iterator[Fault]:
    polygon = Polygons.from_vertices([ring])
    size = float(diameters(polygon)[0])
    gaps = np.hypot(*(np.roll(ring, -1, axis=0) - ring).T)
    for index in np.flatnonzero(gaps <= _SAME_POINT * size):
        following = (int(index) + 1) % len(ring)
        value = f"vertices {index} and {following} are both {_point(ring[index])}"
        yield Fault(place, value, "different vertices", f"remove vertex {following}")
        return
    area = float(areas(polygon)[0])
    crossing = _crossing(ring)
    if crossing is not None:
        remedy = "list the vertices in the order in which the outline passes them, each once"
        value = f"the outline crosses or touches itself at {_point(crossing)}"
        yield Fault(place, value, "a simple outline", remedy)
    elif area <= _FLAT * size**2:
        value = f"area {area:.3g} m2 at a size of {size:.3g} m"
        yield Fault(place, value, "an area", "correct the vertices or remove the block")


def _crossing(ring: Floats) -> Floats | None:
    """A point where a ring meets itself; edges on one line that turn back count as meeting."""
    line = shapely.LinearRing(ring)
    if shapely.is_simple(line):
        return None
    reason = str(shapely.is_valid_reason(shapely.Polygon(ring)))
    if "[" not in reason:
        return np.asarray(ring[0])
    return np.array([float(x) for x in reason.split("[")[1].rstrip("]").split()])


def _holes(rings: list[Floats], place: Sequence[str]) -> Iterator[Fault]:
    outline, *holes = (shapely.Polygon(ring) for ring in rings)
    for index, hole in enumerate(holes):
        where = place[index + 1]
        if not shapely.contains_properly(outline, hole):
            value = "the hole touches or leaves the outline"
            yield Fault(where, value, "a hole inside the block", "move the hole or cut the outline")
        if any(shapely.intersects(hole, other) for other in holes[:index]):
            yield Fault(where, "the hole meets another hole", "separate holes", "unite the holes")


def overlap_faults(
    polygons: Polygons, group: Ints, name: Sequence[str], place: Sequence[str]
) -> list[Fault]:
    """Blocks of different groups that cover the same ground.

    Blocks of one group share a region and cannot overlap. An overlap of less than `OVERLAP` of the
    smaller block's area is what rounded coordinates leave and passes.
    """
    shapes = polygons.to_shapely()
    first, second = shapely.STRtree(shapes).query(shapes, predicate="intersects")
    once = (first < second) & (group[first] != group[second])
    first, second = first[once], second[once]
    common = shapely.area(shapely.intersection(shapes[first], shapes[second]))
    smaller = np.minimum(polygons.areas[first], polygons.areas[second])
    found = np.flatnonzero(common > OVERLAP * smaller)
    faults = []
    for pair in found:
        a, b = int(first[pair]), int(second[pair])
        if common[pair] >= (1 - OVERLAP) * smaller[pair]:
            inner, outer = (a, b) if polygons.areas[a] < polygons.areas[b] else (b, a)
            value = f'"{name[inner]}" lies inside "{name[outer]}"'
            remedy = "move it, or cut a hole into the other block"
            faults.append(Fault(place[inner], value, "blocks that do not overlap", remedy))
        else:
            value = f'"{name[b]}" overlaps "{name[a]}" by {common[pair]:.3g} m2'
            remedy = "move one of them or share the edge"
            faults.append(Fault(place[b], value, "blocks that do not overlap", remedy))
    return faults


def _point(point: Floats) -> str:
    return f"[{point[0]:.9g}, {point[1]:.9g}]"
