"""Polygons with holes as ragged arrays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt
import shapely

from integration.arrays import Floats, Ints
from integration.ragged import offsets, ranges, sums
from integration.rings import open_ring, ring_integrals

_TOPOLOGY = ("next_point", "ring_of_point", "polygon_of_ring", "polygon_of_point", "first_point")


@dataclass(frozen=True, eq=False)
class Polygons:
    """Any number of polygons, each an exterior ring and its holes.

    Rings are open (the first vertex is not repeated) and may turn either way: every function of
    this package adds exteriors and subtracts holes whatever their sense.

    Attributes
    ----------
    points : (P, 2)
        vertices of all rings, ring after ring, in the unit of length of the caller.
    ring_offsets : (R + 1,)
        ring ``r`` is ``points[ring_offsets[r]:ring_offsets[r + 1]]``.
    polygon_offsets : (N + 1,)
        polygon ``n`` has the rings ``polygon_offsets[n]:polygon_offsets[n + 1]``, exterior first.
    """

    points: Floats
    ring_offsets: Ints
    polygon_offsets: Ints

    @classmethod
    def from_rings(cls, polygons: Sequence[Sequence[npt.ArrayLike]]) -> Polygons:
        """Polygons from nested sequences ``[[exterior, hole, ...], ...]`` of (n, 2) vertices.

        A closing vertex equal to the first one is dropped.

        Raises
        ------
        ValueError
            A polygon without rings, a ring of fewer than three vertices, of another shape than
            (n, 2), or with a coordinate that is not finite.
        """
        rings = [
            open_ring(ring, f"polygon {n}, {'exterior' if k == 0 else f'hole {k}'}")
            for n, polygon in enumerate(polygons)
            for k, ring in enumerate(polygon)
        ]
        counts = [len(polygon) for polygon in polygons]
        if 0 in counts:
            raise ValueError(
                f"polygon {counts.index(0)}: no ring: an exterior ring expected: "
                "give its vertices or leave the polygon out"
            )
        built = cls(
            np.concatenate([np.empty((0, 2)), *rings]),
            offsets([len(ring) for ring in rings]),
            offsets(counts),
        )
        _check_finite(built)
        return built

    @classmethod
    def from_vertices(cls, rings: Sequence[npt.ArrayLike]) -> Polygons:
        """Polygons without holes, one for each ring; errors as `from_rings`."""
        return cls.from_rings([[ring] for ring in rings])

    @classmethod
    def from_shapely(cls, polygons: npt.ArrayLike | Sequence[Any]) -> Polygons:
        """Polygons from an array of shapely polygons (vectorised).

        Raises
        ------
        ValueError
            An empty geometry, one that is not a single polygon, or a coordinate that is not finite.
        """
        geometries = np.atleast_1d(np.asarray(polygons, dtype=object))
        bad = (shapely.get_type_id(geometries) != 3) | shapely.is_empty(geometries)
        if bad.any():
            n = int(np.flatnonzero(bad)[0])
            raise ValueError(
                f"polygon {n}: {geometries[n]!s:.60}: a polygon with area expected: "
                "split collections with shapely.get_parts and drop what is empty"
            )
        rings, owner = shapely.get_rings(geometries, return_index=True)
        points, ring = shapely.get_coordinates(rings, return_index=True)
        counts = np.bincount(ring, minlength=len(rings))
        keep = np.ones(len(points), dtype=bool)
        keep[np.cumsum(counts) - 1] = False
        built = cls(
            points[keep],
            offsets(counts - 1),
            offsets(np.bincount(owner, minlength=len(geometries))),
        )
        _check_finite(built)
        return built

    def to_shapely(self) -> npt.NDArray[np.object_]:
        """The polygons as an array (N,) of shapely polygons."""
        if not len(self):
            return np.empty(0, dtype=object)
        rings = np.asarray(shapely.linearrings(self.points, indices=self.ring_of_point))
        return np.asarray(shapely.polygons(rings, indices=self.polygon_of_ring), dtype=object)

    @classmethod
    def concatenate(cls, parts: Sequence[Polygons]) -> Polygons:
        """All polygons of the parts, in order."""
        return cls(
            np.concatenate([np.empty((0, 2)), *(part.points for part in parts)]),
            offsets(np.concatenate([[], *(np.diff(part.ring_offsets) for part in parts)])),
            offsets(np.concatenate([[], *(np.diff(part.polygon_offsets) for part in parts)])),
        )

    def __len__(self) -> int:
        return len(self.polygon_offsets) - 1

    def take(self, indices: npt.ArrayLike) -> Polygons:
        """The polygons at ``indices`` (integers or a mask), in that order."""
        given = np.asarray(indices)
        chosen = np.arange(len(self))[given if given.dtype == bool else given.astype(np.int64)]
        rings, ring_counts = ranges(self.polygon_offsets, chosen)
        points, point_counts = ranges(self.ring_offsets, rings)
        return Polygons(self.points[points], offsets(point_counts), offsets(ring_counts))

    def with_points(self, points: Floats) -> Polygons:
        """The same rings with their vertices moved to ``points`` (P, 2)."""
        if points.shape != self.points.shape:
            raise ValueError(
                f"points: shape {points.shape}: {self.points.shape} expected: "
                "give one row for each vertex of every ring"
            )
        moved = Polygons(points, self.ring_offsets, self.polygon_offsets)
        known = {name: self.__dict__[name] for name in _TOPOLOGY if name in self.__dict__}
        moved.__dict__.update(known)
        return moved

    def oriented(self) -> Polygons:
        """The same polygons with exteriors counter-clockwise and holes clockwise."""
        turned = (self.ring_areas * self.ring_signs < 0)[self.ring_of_point]
        mirrored = (self.ring_offsets[:-1] + self.ring_offsets[1:] - 1)[self.ring_of_point]
        index = np.arange(len(self.points))
        return self.with_points(self.points[np.where(turned, mirrored - index, index)])

    @cached_property
    def next_point(self) -> Ints:
        """(P,) index of the following vertex in the same ring."""
        following = np.arange(1, len(self.points) + 1)
        following[self.ring_offsets[1:] - 1] = self.ring_offsets[:-1]
        return following

    @cached_property
    def ring_of_point(self) -> Ints:
        """(P,) ring of each vertex."""
        return np.repeat(np.arange(len(self.ring_offsets) - 1), np.diff(self.ring_offsets))

    @cached_property
    def polygon_of_ring(self) -> Ints:
        """(R,) polygon of each ring."""
        return np.repeat(np.arange(len(self)), np.diff(self.polygon_offsets))

    @cached_property
    def polygon_of_point(self) -> Ints:
        """(P,) polygon of each vertex."""
        return np.repeat(np.arange(len(self)), np.diff(self.ring_offsets[self.polygon_offsets]))

    @cached_property
    def first_point(self) -> Ints:
        """(N,) index of the first vertex of each polygon."""
        return self.ring_offsets[self.polygon_offsets[:-1]]

    @cached_property
    def ring_signs(self) -> Floats:
        """(R,) +1 for exteriors, -1 for holes."""
        signs = np.full(len(self.ring_offsets) - 1, -1.0)
        signs[self.polygon_offsets[:-1]] = 1.0
        return signs

    @cached_property
    def ring_areas(self) -> Floats:
        """(R,) signed area of each ring, positive when counter-clockwise."""
        return self._ring_integrals[0]

    @cached_property
    def areas(self) -> Floats:
        """(N,) area of each polygon, holes subtracted (read only)."""
        return _read_only(sums(np.abs(self.ring_areas) * self.ring_signs, self.polygon_offsets))

    @cached_property
    def centroids(self) -> Floats:
        """(N, 2) centroid of each polygon; mean vertex where the area is zero (read only)."""
        area, first = self._ring_integrals
        start = self.points[self.ring_offsets[:-1]]
        anchor = self.points[self.first_point]
        first = first + area[:, None] * (start - anchor[self.polygon_of_ring])
        first *= (np.sign(area) * self.ring_signs)[:, None]
        first = sums(first, self.polygon_offsets)
        flat = self.areas == 0.0
        with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
            centroid = anchor + first / self.areas[:, None]
        if flat.any():
            vertices = np.diff(self.ring_offsets[self.polygon_offsets])[:, None]
            offset = self.points - anchor[self.polygon_of_point]
            mean = anchor + sums(offset, self.ring_offsets[self.polygon_offsets]) / vertices
            centroid[flat] = mean[flat]
        return _read_only(centroid)

    @cached_property
    def _ring_integrals(self) -> tuple[Floats, Floats]:
        return ring_integrals(self.points, self.ring_offsets, self.next_point)

    @cached_property
    def extent(self) -> float:
        """Diagonal of the box around all polygons."""
        return float(np.hypot(*np.ptp(self.points, axis=0)))


def diameters(polygons: Polygons) -> Floats:
    """Diagonal (N,) of the bounding box of each polygon."""
    if not len(polygons):
        return np.zeros(0)
    low = np.minimum.reduceat(polygons.points, polygons.first_point, axis=0)
    high = np.maximum.reduceat(polygons.points, polygons.first_point, axis=0)
    return np.asarray(np.hypot(*(high - low).T))


def _check_finite(polygons: Polygons) -> None:
    finite = np.isfinite(polygons.points).all(axis=1)
    if not finite.all():
        n = int(np.flatnonzero(~finite)[0])
        raise ValueError(
            f"polygon {polygons.polygon_of_point[n]}: vertex {polygons.points[n].tolist()}: "
            "finite numbers expected: correct the coordinates"
        )


def _read_only(values: Floats) -> Floats:
    values.flags.writeable = False
    return values
