"""The material to be cut: regions, their groups and layers, and lines as segments."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
import shapely

from integration.arrays import Bools, Floats, Ints
from integration.polygons import Polygons


@dataclass(frozen=True)
class Segments:
    """Straight segments of lines.

    Attributes
    ----------
    start, end : (n, 2)
        end points, m; neighbours on a line have identical ends.
    owner : (n,)
        region or crack of each.
    """

    start: Floats
    end: Floats
    owner: Ints

    def __len__(self) -> int:
        return len(self.owner)

    def take(self, chosen: Ints | Bools) -> Segments:
        """The chosen segments."""
        return Segments(self.start[chosen], self.end[chosen], self.owner[chosen])

    def lines(self) -> npt.NDArray[np.object_]:
        """The segments as shapely lines."""
        return np.asarray(shapely.linestrings(np.stack([self.start, self.end], axis=1)))


@dataclass(frozen=True)
class Domain:
    """Regions of material.

    Attributes
    ----------
    regions : Polygons
        exteriors counter-clockwise, holes clockwise.
    shapes : (R,)
        the same as shapely polygons.
    group : (R,)
        regions of the same number share physical covers across common boundaries.
    layer : (R,)
        layer of each region; regions of a layer do not overlap.
    """

    regions: Polygons
    shapes: npt.NDArray[np.object_]
    group: Ints
    layer: Ints

    def __len__(self) -> int:
        return len(self.regions)

    def boundary(self, layer: int) -> Segments:
        """Boundaries of the regions of a layer, with the material on their left."""
        polygons = self.regions
        chosen = (self.layer == layer)[polygons.polygon_of_point]
        start, end = polygons.points, polygons.points[polygons.next_point]
        chosen &= (start != end).any(axis=1)
        return Segments(start, end, polygons.polygon_of_point).take(chosen)


def domain_of(
    regions: Polygons | npt.ArrayLike | Sequence[object],
    glue: npt.ArrayLike | None,
    rounding: float,
) -> Domain:
    """Check regions and divide them into layers without overlap.

    Parameters
    ----------
    glue : (R,), optional
        regions of the same number share physical covers; by default none do.
    rounding : float
        thickness of an overlap up to which it is rounding, m.

    Raises
    ------
    ValueError
        A region has no area or crosses itself, or regions that share covers overlap.
    """
    polygons = regions if isinstance(regions, Polygons) else Polygons.from_shapely(regions)
    polygons = polygons.oriented()
    shapes = _valid_shapes(polygons, rounding)
    group = np.arange(len(polygons)) if glue is None else np.asarray(glue, dtype=np.int64)
    if group.shape != (len(polygons),):
        raise ValueError(
            f"glue: shape {group.shape}: ({len(polygons)},) expected: "
            "give one number for each region"
        )
    overlaps = _overlaps(shapes, rounding)
    glued = group[overlaps[:, 0]] == group[overlaps[:, 1]]
    if glued.any():
        one, two = overlaps[np.flatnonzero(glued)[0]].tolist()
        raise ValueError(
            f"regions {one} and {two}: glued and overlapping: common boundaries expected: "
            "cut one by the other or do not glue them"
        )
    return Domain(polygons, shapes, group, _layers(len(polygons), overlaps))


def _valid_shapes(polygons: Polygons, rounding: float) -> npt.NDArray[np.object_]:
    """Regions as valid shapely polygons; vertices that differ by rounding are merged."""
    shapes = polygons.to_shapely()
    flat = np.flatnonzero(polygons.areas <= rounding * shapely.length(shapes))
    if len(flat):
        raise ValueError(
            f"region {flat[0]}: area {polygons.areas[flat[0]]:.3g}: a region wider than "
            f"{rounding:.3g} m expected: correct its vertices or leave it out"
        )
    for n in np.flatnonzero(~np.asarray(shapely.is_valid(shapes))):  # few or none
        reason = shapely.is_valid_reason(shapes[n])
        shapes[n] = shapely.remove_repeated_points(shapes[n], rounding)
        if not shapes[n].is_valid:
            raise ValueError(
                f"region {n}: {reason}: a polygon that does not meet itself expected: "
                "split it there or correct the vertices"
            )
    return shapes


def _overlaps(shapes: npt.NDArray[np.object_], rounding: float) -> Ints:
    """Pairs (n, 2) of regions that overlap by more than rounding."""
    one, two = shapely.STRtree(shapes).query(shapes, predicate="intersects")
    one, two = one[one < two], two[one < two]
    # With a grid size, as GEOS may return a whole polygon for two that touch up to rounding.
    common = shapely.intersection(shapes[one], shapes[two], grid_size=rounding)
    area = np.asarray(shapely.area(common))
    length = np.minimum(shapely.length(shapes[one]), shapely.length(shapes[two]))
    return np.asarray(np.stack([one, two], axis=1)[area > rounding * length], dtype=np.int64)


def _layers(n: int, overlaps: Ints) -> Ints:
    """Lowest layer for each region in which it overlaps no earlier one."""
    layer = np.zeros(n, dtype=np.int64)
    for two in np.unique(overlaps[:, 1]):  # overlapping regions only: greedy colouring
        taken = set(layer[overlaps[overlaps[:, 1] == two, 0]].tolist())
        layer[two] = next(k for k in range(n) if k not in taken)
    return layer
