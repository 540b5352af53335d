"""Boundary of cut bodies (outer edges, interfaces, both faces of cracks) and crack tips."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from covers.concatenate import numbers
from covers.cutting.boundary import BoundaryEdges
from covers.cutting.pieces import Pieces, joined_sides, neighbours
from covers.cutting.plane_graph.faces import Faces
from integration.arrays import Bools, Floats, Ints


@dataclass(frozen=True)
class CutBoundary(BoundaryEdges):
    """Boundary edges of cut bodies.

    Attributes
    ----------
    crack
        (n,) crack of which the edge is a face; -1 on the boundary of the region.
    opposite
        (n,) edge with the same ends on the other side of a crack or of an interface with another
        region; -1 without one.
    """

    crack: Ints
    opposite: Ints = field(metadata=numbers("edge"))


@dataclass(frozen=True)
class CrackTips:
    """Crack tips inside bodies.

    Attributes
    ----------
    point
        (n, 2) tips, m.
    direction
        (n, 2) unit vectors ahead of the cracks.
    element
        (n,) element ahead of each tip.
    crack
        (n,) crack of each tip.
    """

    point: Floats
    direction: Floats
    element: Ints = field(metadata=numbers("element"))
    crack: Ints

    def __len__(self) -> int:
        return len(self.element)


def boundary_of(
    faces: Faces, pieces: Pieces, group: Ints, part: bool
) -> tuple[CutBoundary, CrackTips]:
    """Return the boundary edges of a layer, with bodies yet to be filled in, and its crack tips.

    Parameters
    ----------
    part : bool
        whether the faces are those of a part of the cells only: at its rim links may then be
        missing, -1.

    Raises
    ------
    ValueError
        A boundary is not closed.
    """
    half = faces.half
    element = pieces.of_loop[half.loop]
    across = neighbours(faces, pieces, element)
    joined = joined_sides(faces, pieces, element, across, group)
    is_rim = (element >= 0) & ~joined
    rim = np.flatnonzero(is_rim)
    x, y = faces.points[half.origin[rim]].T
    rim = rim[np.lexsort((y, x, element[rim]))]
    number = np.full(len(element), -1, dtype=np.int64)
    number[rim] = np.arange(len(rim))
    ahead = _next_on_rim(faces, rim, is_rim, part)
    following = np.where(ahead >= 0, number[ahead], -1)
    previous = np.full(len(rim), -1, dtype=np.int64)
    previous[following[ahead >= 0]] = np.flatnonzero(ahead >= 0)
    parted = (across >= 0) & (group[pieces.region[element]] == group[pieces.region[across]])
    crack = np.where(parted, np.repeat(faces.crack, 2), -1)
    boundary = CutBoundary(
        start=faces.points[half.origin[rim]],
        end=faces.points[half.head[rim]],
        element=element[rim],
        body=np.full(len(rim), -1, dtype=np.int64),
        next=following,
        previous=previous,
        crack=crack[rim],
        opposite=number[rim ^ 1],
    )
    return boundary, _tips(faces, element, rim, crack)


def _next_on_rim(faces: Faces, rim: Ints, is_rim: Bools, part: bool) -> Ints:
    """Next edge of the boundary: turn about the head through joined faces."""
    half = faces.half
    following = half.next[rim]
    first, inner = following.copy(), np.flatnonzero(~is_rim[following])
    while len(inner):  # as many passes as faces about a point
        following[inner] = half.next[following[inner] ^ 1]
        round_about = inner[following[inner] == first[inner]]
        if len(round_about) and not part:
            place = faces.points[half.head[rim[round_about[0]]]].tolist()
            raise ValueError(
                f"boundary: no following edge at {place}: a closed boundary expected: report the "
                "regions and cracks that lead here"
            )
        following[round_about] = -1
        inner = inner[(following[inner] >= 0) & ~is_rim[following[inner]]]
    return following


def _tips(faces: Faces, element: Ints, rim: Ints, crack: Ints) -> CrackTips:
    """Points at which a single edge of a crack ends and no other boundary passes."""
    half, n = faces.half, len(faces.steps)
    cracked = rim[crack[rim] >= 0]
    once = cracked[cracked % 2 == 0]
    ends = np.bincount(faces.edges[once // 2].ravel(), minlength=n)
    outer = np.zeros(n, dtype=bool)
    outer[faces.edges[rim[crack[rim] < 0] // 2]] = True
    back = np.flatnonzero(
        ((ends == 1) & ~outer)[half.origin] & np.isin(np.arange(2 * len(faces.edges)), cracked)
    )
    x, y = faces.points[half.origin[back]].T
    back = back[np.lexsort((y, x, crack[back]))]
    tip = half.origin[back]
    ahead = faces.steps[tip] - faces.steps[half.head[back]]
    direction = ahead / np.hypot(*ahead.T)[:, None]
    return CrackTips(
        faces.points[tip], direction, element[_sectors(faces, tip, direction)], crack[back]
    )


def _sectors(faces: Faces, points: Ints, direction: Floats) -> Ints:
    """Half-edge from each point whose face contains the direction."""
    half = faces.half
    row = np.full(len(faces.steps), -1, dtype=np.int64)
    row[points] = np.arange(len(points))
    out = np.flatnonzero(row[half.origin] >= 0)
    tip = row[half.origin[out]]
    wanted = np.arctan2(direction[tip, 1], direction[tip, 0])
    # A closure ahead of the tip has the same direction up to rounding: count it as before.
    turn = np.mod(wanted - half.angle[out] + 1e-9, 2 * np.pi)
    order = np.lexsort((turn, tip))
    return out[order[np.unique(tip[order], return_index=True)[1]]]
