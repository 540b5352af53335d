"""Checks of rings, blocks and places; each returns faults, so that all are reported together."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np
import numpy.typing as npt
import shapely

from integration.arrays import Bools, Floats, Ints
from integration.polygons import Polygons, diameters
from nmm.errors import Fault

_SAME_POINT = 1e-12  # of the block's diameter
_FLAT = 1e-12  # area over squared diameter
_TINY = float(np.finfo(float).tiny)  # below it numbers lose their digits, and quotients overflow
OVERLAP = 1e-6  # of the smaller block's area: what coordinates of six digits leave


def outline_faults(outlines: Polygons, place: Callable[[int, int], str]) -> list[Fault]:
    """Outlines and holes that are not sound; `place` names ring `k` of polygon `n`.

    Holes are looked at when all outlines are sound.
    """
    rings = _rings(outlines)
    start = outlines.points
    if (lost := _vanishing(outlines, place)) is not None:
        return [lost]
    gap = np.hypot(*(start[outlines.next_point] - start).T)
    twice = gap <= _SAME_POINT * diameters(rings)[outlines.ring_of_point]
    lines = np.asarray(shapely.linearrings(start, indices=outlines.ring_of_point), dtype=object)
    flat = rings.areas <= _FLAT * diameters(rings) ** 2
    doubtful = ~shapely.is_simple(lines) | flat
    doubtful[outlines.ring_of_point[twice]] = True
    bad = np.flatnonzero(doubtful)
    owner = outlines.polygon_of_ring
    number = bad - outlines.polygon_offsets[owner[bad]]
    found = [
        _ring_fault(rings.take([r]), place(owner[r], k)) for r, k in zip(bad, number, strict=True)
    ]
    with_holes = np.flatnonzero(np.diff(outlines.polygon_offsets) > 1)
    if found or not len(with_holes):
        return found
    return [fault for n in with_holes for fault in _hole_faults(outlines, int(n), place)]


def _vanishing(outlines: Polygons, place: Callable[[int, int], str]) -> Fault | None:
    """Return a fault of the first coordinate that is neither zero nor a number with its digits."""
    found = np.argwhere((outlines.points != 0) & (np.abs(outlines.points) < _TINY))
    if not len(found):
        return None
    point, axis = (int(one) for one in found[0])
    ring = int(outlines.ring_of_point[point])
    owner = int(outlines.polygon_of_ring[ring])
    value = f"a coordinate of {outlines.points[point, axis]:.3g} m"
    number = ring - int(outlines.polygon_offsets[owner])
    return Fault(place(owner, number), value, "zero, or a length", "write 0")


def _rings(polygons: Polygons) -> Polygons:
    """Every ring as a polygon of its own."""
    count = len(polygons.ring_offsets)
    return Polygons(polygons.points, polygons.ring_offsets, np.arange(count))


def _ring_fault(ring: Polygons, place: str) -> Fault:
    size, points = float(diameters(ring)[0]), ring.points
    gap = np.hypot(*(points[ring.next_point] - points).T)
    if gap.min() <= _SAME_POINT * size:
        index = int(np.argmin(gap))
        following = (index + 1) % len(points)
        value = f"vertices {index} and {following} are both {_point(points[index])}"
        return Fault(place, value, "different vertices", f"remove vertex {max(index, following)}")
    hull = shapely.MultiPoint(points).convex_hull.area  # the area itself is 0 for a bow tie too
    if hull > _FLAT * size**2 and not shapely.is_simple(shapely.LinearRing(points)):
        value = f"the outline crosses or touches itself at {_crossing(points)}"
        remedy = "list the vertices in the order in which the outline passes them, each once"
        return Fault(place, value, "a simple outline", remedy)
    value = f"area {ring.areas[0]:.3g} m2 at a size of {size:.3g} m"
    return Fault(place, value, "an area", "correct the vertices or remove the block")


def _crossing(ring: Floats) -> str:
    """A point where a ring meets itself, as GEOS words it: "Self-intersection[0.5 0.5]"."""
    reason = str(shapely.is_valid_reason(shapely.Polygon(ring)))
    if "[" not in reason:
        return "a vertex"
    return _point(np.array([float(x) for x in reason.split("[")[1].rstrip("]").split()]))


def _hole_faults(
    outlines: Polygons, polygon: int, place: Callable[[int, int], str]
) -> Iterator[Fault]:
    outline, *holes = _rings(outlines.take([polygon])).to_shapely()
    for index, hole in enumerate(holes):
        where = place(polygon, index + 1)
        if not shapely.contains_properly(outline, hole):
            value = "the hole touches or leaves the outline"
            yield Fault(where, value, "a hole inside the block", "move the hole or cut the outline")
        if any(shapely.intersects(hole, other) for other in holes[:index]):
            yield Fault(where, "the hole meets another hole", "separate holes", "unite the holes")


def overlap_faults(
    polygons: Polygons,
    group: Ints,
    name: Sequence[str],
    place: Callable[[int], str],
    meet: Callable[[Ints, Ints], Bools],
) -> list[Fault]:
    """Blocks of different groups that cover the same ground; `place` names a group.

    Only those count that ``meet``, that is, of pairs (k,), which are there at the same time.
    Blocks of one group share a region and cannot overlap. An overlap of less than `OVERLAP` of the
    smaller block's area is what rounded coordinates leave and passes.
    """
    shapes = polygons.to_shapely()
    first, second = _deep_boxes(shapes, polygons.areas, group)
    there = meet(first, second)
    first, second = first[there], second[there]
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
            faults.append(
                Fault(place(int(group[inner])), value, "blocks that do not overlap", remedy)
            )
        else:
            value = f'"{name[b]}" overlaps "{name[a]}" by {common[pair]:.3g} m2'
            remedy = "move one of them or share the edge"
            faults.append(Fault(place(int(group[b])), value, "blocks that do not overlap", remedy))
    return faults


def _deep_boxes(shapes: npt.NDArray[np.object_], areas: Floats, group: Ints) -> tuple[Ints, Ints]:
    """Pairs of blocks of different groups that meet, and whose boxes share more than may overlap.

    Blocks laid flush, as bricks, share next to none, and their intersections need not be found.
    """
    first, second = shapely.STRtree(shapes).query(shapes, predicate="intersects")
    once = (first < second) & (group[first] != group[second])
    first, second = first[once], second[once]
    boxes = shapely.bounds(shapes)
    low = np.maximum(boxes[first, :2], boxes[second, :2])
    high = np.minimum(boxes[first, 2:], boxes[second, 2:])
    shared = np.prod(np.maximum(high - low, 0.0), axis=1)
    deep = shared > OVERLAP * np.minimum(areas[first], areas[second])
    return first[deep], second[deep]


def _point(point: Floats) -> str:
    return f"[{point[0]:.9g}, {point[1]:.9g}]"
