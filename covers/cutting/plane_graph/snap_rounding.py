"""Snap rounding: lines meet at common end points only.

As in iterated snap rounding (Hobby 1999; Halperin and Packer 2002), points within a step
(`covers.cutting.resolution`) are merged, a line that passes a point within `NEAR` steps is bent to
pass through it, and crossings become points, until nothing changes. In the end every point is more
than `NEAR` steps away from all lines that do not end at it, so that angles about a point are
distinct in double precision. `NEAR` is less than a step, so that a bend always shortens a line.
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
    """Segments of lines between points.

    Attributes
    ----------
    steps, points : (V, 2)
        points more than a step apart, in steps and in m.
    start, end : (n,)
        points of each segment, in the direction of its line.
    source : (n,)
        line of each, or -1.
    """

    steps: Floats
    points: Floats
    start: Ints
    end: Ints
    source: Ints

    def with_points(self, steps: Floats, points: Floats) -> tuple[Lines, Ints]:
        """Add points; return the number of each, which is that of a known point within a step."""
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
        """Add segments."""
        return replace(
            self,
            start=np.concatenate([self.start, start]),
            end=np.concatenate([self.end, end]),
            source=np.concatenate([self.source, source]),
        )


def lines_between(points: Floats, resolution: Resolution, start: Ints, end: Ints) -> Lines:
    """Return lines (m,) between points (n, 2), of which those within a step are merged."""
    steps = resolution.steps(points)
    first, vertex = clusters(steps)
    return Lines(steps[first], points[first], vertex[start], vertex[end], np.arange(len(start)))


def node(lines: Lines, fresh: Bools, resolution: Resolution) -> Lines:
    """Split lines at all points where they meet.

    Parameters
    ----------
    fresh : (n,)
        segments that may cross others; the rest is known to meet at common points only.

    Raises
    ------
    ValueError
        Lines still cross after `SNAP_PASSES` passes.
    """
    for _ in range(SNAP_PASSES):  # two to four in practice
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
    """Return distinct edges (m, 2), lower point first, and the edge of each segment."""
    low, high = np.minimum(start, end), np.maximum(start, end)
    size = int(high.max(initial=0)) + 1
    key, edge = np.unique(low * size + high, return_inverse=True)
    return np.stack([key // size, key % size], axis=1), edge


@dataclass(frozen=True)
class _Meetings:
    """Edges to be split: at known points, and at crossings, which become new points."""

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
    # Crossings wait until overlapping lines are merged, as each would have a crossing of its own.
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
    """Pairs of edges whose bounding boxes meet, at least one of them fresh."""
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
    near = np.abs(cross(along, away)) <= NEAR * np.sqrt(square)
    near &= (parameter > 0) & (parameter < 1)
    return near & (point != edge[:, 0]) & (point != edge[:, 1]), parameter


def _crossings(a: Floats, b: Floats, c: Floats, d: Floats) -> tuple[Bools, Floats, Floats]:
    """Whether segments ab and cd cross between their ends, and the parameters on both.

    No end is within `NEAR` of the other segment, so that the signs are certain.
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
    """Split edges where they meet; return also which segments may cross others again."""
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
        fresh |= is_fresh  # their crossings have not been searched for
    return split, fresh[edge[piece]]


def _chains(edges: Ints, edge: Ints, parameter: Floats, point: Ints) -> tuple[Ints, Ints, Ints]:
    """Segments of all edges, by edge and parameter: start, end, edge."""
    n = len(edges)
    all_edges = np.concatenate([edge, np.arange(n), np.arange(n)])
    all_parameters = np.concatenate([parameter, np.full(n, -1.0), np.full(n, 2.0)])
    all_points = np.concatenate([point, edges[:, 0], edges[:, 1]])
    order = np.lexsort((all_points, all_parameters, all_edges))
    all_edges, all_points = all_edges[order], all_points[order]
    # A point on several lines splits the edge once.
    link = (all_edges[1:] == all_edges[:-1]) & (all_points[1:] != all_points[:-1])
    return all_points[:-1][link], all_points[1:][link], all_edges[1:][link]
