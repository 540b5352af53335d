"""Collapse of short edges of a tessellation, with its boundary and corners kept."""

from __future__ import annotations

import heapq
from collections.abc import Iterator
from itertools import pairwise
from math import dist

import numpy as np
import shapely

from integration.arrays import Floats, Ints
from integration.polygons import Polygons

_FREE, _BOUNDARY, _FIXED = 0, 1, 2
_LEAST_AREA = 0.5  # of a cell's area before the first collapse
_Rings = list[list[int]]


def edge_lengths(polygons: Polygons) -> Floats:
    """Length of every edge, each edge between two cells once."""
    ends = np.stack([polygons.points, polygons.points[polygons.next_point]], axis=1)
    turned = (ends[:, 0, 0] > ends[:, 1, 0]) | (
        (ends[:, 0, 0] == ends[:, 1, 0]) & (ends[:, 0, 1] > ends[:, 1, 1])
    )
    ends[turned] = ends[turned][:, ::-1]
    unique = np.unique(ends.reshape(-1, 4), axis=0)
    return np.asarray(np.hypot(unique[:, 0] - unique[:, 2], unique[:, 1] - unique[:, 3]))


def collapse_short_edges(
    cells: Polygons, shortest: float, fixed: Floats, group: Ints | None = None
) -> Polygons:
    """Cells without edges shorter than a length, as far as the constraints allow.

    Vertices shared by cells stay shared. Vertices inside move to the edge's midpoint; a vertex on
    the outer boundary only slides along it, onto another of its vertices; fixed vertices stay. A
    collapse that would lose a cell, turn one inside out or halve its area is left undone.

    Parameters
    ----------
    cells
        Cells that share their vertices bit by bit.
    shortest
        Length below which an edge is collapsed.
    fixed : (F, 2)
        Points that stay where they are: corners, load and support points.
    group : (N,)
        Cells of different groups have a boundary between them, which is kept; default one group.
    """
    groups = [0] * len(cells) if group is None else group.tolist()
    mesh = _Mesh(cells, fixed, groups)
    # Shortest first, one after the other: a collapse changes the lengths of the edges around it.
    edges = {(min(edge), max(edge)) for edge in mesh.edges()}
    queue = [(dist(*mesh.ends(u, v)), u, v) for u, v in edges]
    queue = sorted(entry for entry in queue if entry[0] < shortest)
    while queue:
        length, u, v = heapq.heappop(queue)
        if not (mesh.cells[u] and mesh.cells[v]) or length != dist(*mesh.ends(u, v)):
            continue
        merged = mesh.collapse(u, v)
        if merged is None:
            continue
        for other in mesh.neighbours(merged):
            u, v = min(merged, other), max(merged, other)
            length = dist(*mesh.ends(u, v))
            if length < shortest:
                heapq.heappush(queue, (length, u, v))
    return mesh.polygons()


class _Mesh:
    """Cells as rings of vertex numbers."""

    def __init__(self, cells: Polygons, fixed: Floats, group: list[int]) -> None:
        cells = cells.oriented()
        points, number = np.unique(cells.points + 0.0, axis=0, return_inverse=True)
        self.points: list[tuple[float, float]] = [(x, y) for x, y in points.tolist()]
        ids = np.split(number.ravel(), cells.ring_offsets[1:-1])
        bounds = pairwise(cells.polygon_offsets.tolist())
        self.rings: list[_Rings] = [[ring.tolist() for ring in ids[a:b]] for a, b in bounds]
        self.areas: Floats = cells.areas
        self.cells: list[set[int]] = [set() for _ in points]
        for cell, rings in enumerate(self.rings):
            for vertex in (vertex for ring in rings for vertex in ring):
                self.cells[vertex].add(cell)
        self.kind = [_FREE] * len(points)
        self.group = group
        home = {
            edge: group[cell]
            for cell, rings in enumerate(self.rings)
            for ring in rings
            for edge in _ring_edges(ring)
        }
        for (u, v), here in home.items():
            if home.get((v, u)) != here:
                self.kind[u] = self.kind[v] = _BOUNDARY
        known = {tuple(point): vertex for vertex, point in enumerate(points.tolist())}
        for point in (fixed + 0.0).tolist():
            if tuple(point) in known:
                self.kind[known[tuple(point)]] = _FIXED

    def edges(self) -> Iterator[tuple[int, int]]:
        for rings in self.rings:
            for ring in rings:
                yield from _ring_edges(ring)

    def ends(self, u: int, v: int) -> tuple[tuple[float, float], tuple[float, float]]:
        return self.points[u], self.points[v]

    def neighbours(self, vertex: int) -> set[int]:
        found = set()
        for ring in (ring for cell in self.cells[vertex] for ring in self.rings[cell]):
            for u, v in _ring_edges(ring):
                if vertex in (u, v):
                    found.add(u + v - vertex)
        return found

    def collapse(self, u: int, v: int) -> int | None:
        """Unite two vertices; the one that stays, or None if that is not allowed."""
        stay, leave = (u, v) if self.kind[u] >= self.kind[v] else (v, u)
        if self.kind[leave] == _FIXED:
            return None
        if self.kind[leave] == _BOUNDARY and not self._is_outer(u, v):
            return None
        before = self.points[stay]
        if self.kind[stay] == _FREE:
            (x0, y0), (x1, y1) = self.ends(u, v)
            self.points[stay] = ((x0 + x1) / 2, (y0 + y1) / 2)
        touched = sorted(self.cells[u] | self.cells[v])
        trial = {cell: _replaced(self.rings[cell], leave, stay) for cell in touched}
        if not self._sound(trial):
            self.points[stay] = before
            return None
        for cell, rings in trial.items():
            self.rings[cell] = rings
        self.cells[stay] = set(touched)
        self.cells[leave] = set()
        return stay

    def _is_outer(self, u: int, v: int) -> bool:
        """Whether an edge has no second cell of the same group."""
        sides = [
            self.group[cell]
            for cell in self.cells[u] & self.cells[v]
            if any({u, v} == set(edge) for ring in self.rings[cell] for edge in _ring_edges(ring))
        ]
        return len(set(sides)) == len(sides)

    def _sound(self, trial: dict[int, _Rings]) -> bool:
        if any(len(ring) < 3 for rings in trial.values() for ring in rings):
            return False
        corners = [[[self.points[v] for v in ring] for ring in rings] for rings in trial.values()]
        shapes = np.array([shapely.Polygon(first, holes) for first, *holes in corners])
        least = _LEAST_AREA * self.areas[list(trial)]
        turned = ~shapely.is_ccw(shapely.get_exterior_ring(shapes))
        return bool(np.all(shapely.is_valid(shapes) & (shapely.area(shapes) > least) & ~turned))

    def polygons(self) -> Polygons:
        return Polygons.from_rings(
            [[[self.points[v] for v in ring] for ring in rings] for rings in self.rings]
        )


def _ring_edges(ring: list[int]) -> Iterator[tuple[int, int]]:
    return zip(ring, ring[1:] + ring[:1], strict=True)


def _replaced(rings: _Rings, leave: int, stay: int) -> _Rings:
    changed = [[stay if vertex == leave else vertex for vertex in ring] for ring in rings]
    return [[a for a, b in _ring_edges(ring) if a != b] for ring in changed]
