"""Snapping: lines meet in common points and nowhere else.

In the manner of iterated snap rounding (Hobby 1999; Halperin and Packer 2002): points within a step
(`covers.cutting.resolution`) are one; a line that passes a point within `NEAR` steps is bent to
pass through it; crossings become points; until nothing changes. In the end every point keeps more
than `NEAR` steps from all lines that do not end in it, which makes angles about a point distinct in
double precision. `NEAR` is less than the step, so that a bend always shortens a line.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import shapely

from covers.cutting.resolution import Resolution, clusters
from integration.arrays import Bools, Floats, Ints
from integration.plane_vectors import cross
from integration.ragged import within

NEAR = 0.75
SNAP_PASSES = 60


@dataclass(frozen=True)
class Lines:
    """Pieces of lines between points.

    Attributes
    ----------
    steps, points : (V, 2)
        points more than a step apart, in steps and in m.
    start, end : (n,)
        points of each piece, in the sense of the line that it comes from.
    source : (n,)
        the line, or -1.
    """

    steps: Floats
    points: Floats
    start: Ints
    end: Ints
    source: Ints

    def with_points(self, steps: Floats, points: Floats) -> tuple[Lines, Ints]:
        """More points, and the number of each: that of a known point within a step if any."""
        from scipy.spatial import cKDTree

        distance, nearest = cKDTree(self.steps).query(steps, distance_upper_bound=1.0)
        number = np.asarray(nearest, dtype=np.int64)
        new = np.flatnonzero(np.isinf(distance))
        if len(new):
            first, cluster = clusters(steps[new])
            number[new] = len(self.steps) + cluster
            steps, points = steps[new[first]], points[new[first]]
            all_steps = np.concatenate([self.steps, steps])
            return replace(
                self, steps=all_steps, points=np.concatenate([self.points, points])
            ), number
        return self, number

    def with_pieces(self, start: Ints, end: Ints, source: Ints) -> Lines:
        """The same points with more pieces."""
        return replace(
            self,
            start=np.concatenate([self.start, start]),
            end=np.concatenate([self.end, end]),
            source=np.concatenate([self.source, source]),
        )


def lines_between(points: Floats, resolution: Resolution, start: Ints, end: Ints) -> Lines:
    """Lines (m,) between points (n, 2); of points within a step the first remains."""
    steps = resolution.steps(points)
    first, vertex = clusters(steps)
    return Lines(steps[first], points[first], vertex[start], vertex[end], np.arange(len(start)))


def node(lines: Lines, fresh: Bools, resolution: Resolution) -> Lines:
    """Split lines at all points where they meet.

    Parameters
    ----------
    fresh : (n,)
        pieces that may meet others; the rest is known to meet only in common points.

    Raises
    ------
    ValueError
        No end after `SNAP_PASSES` passes.
    """
    for _ in range(SNAP_PASSES):  # passes over all lines: two to four in practice
        kept = lines.start != lines.end
        lines = replace(
            lines, start=lines.start[kept], end=lines.end[kept], source=lines.source[kept]
        )
        fresh = fresh[kept]
        edges, edge = undirected(lines.start, lines.end)
        is_fresh = np.zeros(len(edges), dtype=bool)
        is_fresh[edge[fresh]] = True
        if not is_fresh.any():
            return lines
        lines, fresh = _split(lines, edges, edge, is_fresh, resolution)
    raise ValueError(
        f"lines: still meeting between points after {SNAP_PASSES} passes: lines apart or crossing "
        "expected: remove cracks that lie on one another within rounding"
    )


def undirected(start: Ints, end: Ints) -> tuple[Ints, Ints]:
    """Distinct edges (m, 2), lower point first, and the edge of each piece."""
    low, high = np.minimum(start, end), np.maximum(start, end)
    size = int(high.max(initial=0)) + 1
    key, edge = np.unique(low * size + high, return_inverse=True)
    return np.stack([key // size, key % size], axis=1), edge


@dataclass(frozen=True)
class _Meetings:
    """Edges to be split: at known points, and at crossings that become new points."""

    edge: Ints
    parameter: Floats
    point: Ints
    crossing: Floats
    first: Ints
    first_parameter: Floats
    second: Ints
    second_parameter: Floats


def _meetings(steps: Floats, edges: Ints, fresh: Bools) -> _Meetings:
    one, two = _close_pairs(steps, edges, fresh)
    edge = np.concatenate([one, one, two, two])
    point = np.concatenate([edges[two].T.ravel(), edges[one].T.ravel()])
    near, parameter = _passes(steps, edges[edge], point)
    # Crossings wait until lines that run together are one: else each would have its own crossing.
    share = (edges[one][:, :, None] == edges[two][:, None, :]).any(axis=(1, 2)) | near.any()
    one, two = one[~share], two[~share]
    crosses, t, s = _crossings(
        *(steps[edges[side][:, end]] for side in (one, two) for end in (0, 1))
    )
    one, two, t, s = one[crosses], two[crosses], t[crosses], s[crosses]
    start, end = steps[edges[one]].swapaxes(0, 1)
    return _Meetings(
        edge[near], parameter[near], point[near], start + t[:, None] * (end - start), one, t, two, s
    )


def _close_pairs(steps: Floats, edges: Ints, fresh: Bools) -> tuple[Ints, Ints]:
    """Pairs of edges with boxes that meet, at least one of them fresh."""
    corners = steps[edges]
    low, high = corners.min(axis=1) - 1, corners.max(axis=1) + 1
    boxes = shapely.box(low[:, 0], low[:, 1], high[:, 0], high[:, 1])
    asked = np.flatnonzero(fresh)
    found, other = shapely.STRtree(boxes).query(boxes[asked])
    one = asked[found]
    once = (one < other) | ~fresh[other]
    return one[once], other[once]


def _passes(steps: Floats, edge: Ints, point: Ints) -> tuple[Bools, Floats]:
    """Whether edges pass points within `NEAR` between their ends, and the parameter there."""
    start, end = steps[edge[:, 0]], steps[edge[:, 1]]
    along, away = end - start, steps[point] - start
    square = (along**2).sum(axis=1)
    parameter = (along * away).sum(axis=1) / square
    cross = along[:, 0] * away[:, 1] - along[:, 1] * away[:, 0]
    near = np.abs(cross) <= NEAR * np.sqrt(square)
    near &= (parameter > 0) & (parameter < 1)
    return near & (point != edge[:, 0]) & (point != edge[:, 1]), parameter


def _crossings(a: Floats, b: Floats, c: Floats, d: Floats) -> tuple[Bools, Floats, Floats]:
    """Whether segments ab and cd cross between their ends, and the parameters on both.

    No end is nearer than `NEAR` to the other segment, so that the signs are certain.
    """
    ab, cd, ac = b - a, d - c, c - a
    of_c, of_d = cross(ab, ac), cross(ab, d - a)
    of_a, of_b = -cross(cd, ac), cross(cd, b - c)
    crosses = (of_c * of_d < 0) & (of_a * of_b < 0)
    with np.errstate(divide="ignore", invalid="ignore"):
        return crosses, of_a / (of_a - of_b), of_c / (of_c - of_d)


def _split(
    lines: Lines, edges: Ints, edge: Ints, is_fresh: Bools, resolution: Resolution
) -> tuple[Lines, Bools]:
    """Lines with edges split at their meetings, and which pieces may meet others again."""
    meetings = _meetings(lines.steps, edges, is_fresh)
    lines, new = lines.with_points(meetings.crossing, resolution.points(meetings.crossing))
    chain_start, chain_end, chain_edge = _chains(
        edges,
        np.concatenate([meetings.edge, meetings.first, meetings.second]),
        np.concatenate([meetings.parameter, meetings.first_parameter, meetings.second_parameter]),
        np.concatenate([meetings.point, new, new]),
    )
    number = np.bincount(chain_edge, minlength=len(edges))
    begin = np.cumsum(number) - number
    count = number[edge]
    piece = np.repeat(np.arange(len(edge)), count)
    link = begin[edge[piece]] + within(count)
    forward = (lines.start == edges[edge, 0])[piece]
    start = np.where(forward, chain_start[link], chain_end[link])
    end = np.where(forward, chain_end[link], chain_start[link])
    split = replace(lines, start=start, end=end, source=lines.source[piece])
    fresh = number > 1
    if len(meetings.edge):
        fresh |= is_fresh  # its crossings have not been looked for
    return split, fresh[edge[piece]]


def _chains(edges: Ints, edge: Ints, parameter: Floats, point: Ints) -> tuple[Ints, Ints, Ints]:
    """Pieces of all edges in order of edge and parameter: start, end, edge."""
    n = len(edges)
    all_edges = np.concatenate([edge, np.arange(n), np.arange(n)])
    all_parameters = np.concatenate([parameter, np.full(n, -1.0), np.full(n, 2.0)])
    all_points = np.concatenate([point, edges[:, 0], edges[:, 1]])
    order = np.lexsort((all_points, all_parameters, all_edges))
    all_edges, all_points = all_edges[order], all_points[order]
    # A point met by several lines splits the edge once.
    link = (all_edges[1:] == all_edges[:-1]) & (all_points[1:] != all_points[:-1])
    return all_points[:-1][link], all_points[1:][link], all_edges[1:][link]
