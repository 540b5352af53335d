"""Pressures along runs of faces: which functions of multiplier nodes act at which contact points.

A run is a row of points between two faces. Of the two the one gives the nodes that follows a
pressure more easily (`nmm.contact.mortar.trace_space`). Inside, the functions are hats along it,
the first and the last going on to the ends; the end points have functions of their own, so that a
body that tilts turns about its corner, but for those at the tips of cracks. At every point the
functions sum to one.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from covers.concatenate import concatenate
from integration.arrays import Bools, Floats, Ints
from integration.plane_vectors import dot
from nmm.contact.detection.surface import Surface
from nmm.contact.detection.tolerances import ENOUGH_NODES, RUN_APART, SAME_COMPLIANCE
from nmm.contact.mortar.trace_space import TraceSpace
from nmm.contact.points.contact_points import ContactPoints


@dataclass(frozen=True, eq=False)
class Entries:
    """Values of functions at points, one row an entry.

    Attributes
    ----------
    point, function
        (e,) indices.
    value
        (e,) above zero.
    """

    point: Ints
    function: Ints
    value: Floats


def functions_along(contacts: ContactPoints, surface: Surface, space: TraceSpace) -> Entries:
    """Return the functions at the contact points that stand for a length of a face.

    Points of joints and mere vertices have none.
    """
    points = np.flatnonzero((contacts.length > 0) & ~contacts.is_joint)
    if not len(points):  # bodies apart, or at corners alone
        return Entries(points, points, np.zeros(0))
    some = contacts.take(points)
    at, face, other, joined = _sides(some, surface, space)
    order = np.lexsort((at, some.interface, other, face))
    at, who = at[order], np.stack([face, other, some.interface])[:, order]
    step = np.diff(space.node)
    interval = step[np.clip(np.searchsorted(space.node, at, "right") - 1, 0, len(step) - 1)]
    new = np.ones(len(at), dtype=bool)
    new[1:] = (who[:, 1:] != who[:, :-1]).any(axis=0)
    new[1:] |= np.diff(at) > RUN_APART * np.maximum(interval[1:], interval[:-1])
    found = _on_runs(at, new, space, ~joined[order])
    return Entries(points[order][found.point], found.function, found.value)


def _on_runs(at: Floats, new: Bools, space: TraceSpace, free: Bools) -> Entries:
    """Functions at points of runs: of fine nodes where a run has few of the others inside.

    One hat alone, even along a run, would let its faces turn into each other. Where there are more
    fine nodes inside than points, pressures of these are any: each point is held by itself.
    """
    first = np.flatnonzero(new)
    last = np.append(first[1:], len(at)) - 1
    nodes, fine = (
        1 + high - low
        for low, high in (_inner(at[first], at[last], node) for node in (space.node, space.fine))
    )
    few, run = nodes < ENOUGH_NODES, np.cumsum(new) - 1
    single = few & (fine >= last - first)
    parts, count = [Entries(first[:0], first[:0], np.zeros(0))], 0
    for some, node in ((~few[run], space.node), ((few & ~single)[run], space.fine)):
        (points,) = some.nonzero()
        if len(points):
            part = _hats(at[points], new[points], node, free[points])
            parts.append(Entries(points[part.point], count + part.function, part.value))
            count += int(part.function.max()) + 1
    return concatenate(parts, {})


def _sides(
    some: ContactPoints, surface: Surface, space: TraceSpace
) -> tuple[Floats, Ints, Ints, Bools]:
    """Where (m,) points are on the face that gives the nodes, that face, and the other.

    And which are beside a place where both faces of a crack are one.
    """
    a, b, before = some.edge_a, some.edge_b, surface.previous[some.edge_a]
    # A corner belongs to the face that looks at the other body.
    looks = dot(surface.normal[a], some.normal) <= dot(surface.normal[before], some.normal)
    own = (some.parameter_a > 0) | looks
    edge_a = np.where(own, a, before)
    at = np.stack(
        [space.on(edge_a, np.where(own, some.parameter_a, 1.0)), space.on(b, some.parameter_b)]
    )
    face = np.stack([space.face[edge_a], space.face[b]])
    soft = np.stack([space.softness[edge_a], space.softness[b]])
    giver = np.where(_first_follows(at, face, soft, space), 0, 1)
    m = np.arange(len(giver))
    joined = space.welded[edge_a] & space.welded[b]
    return at[giver, m], face[giver, m], face[1 - giver, m], joined


def _first_follows(at: Floats, face: Ints, soft: Floats, space: TraceSpace) -> Bools:
    """Whether the first of the sides (2, m) follows a pressure more easily.

    That is the face with more nodes to its modulus over all points that the two faces share; of
    two alike the one that comes first on the line.
    """
    turned = face[0] > face[1]
    low, high = (np.where(turned, one, other) for one, other in (face[::-1], face))
    _, pair = np.unique(np.stack([low, high]), axis=1, return_inverse=True)
    pair = pair.ravel()
    n = int(pair.max(initial=-1)) + 1
    compliance = []
    for side in (0, 1):
        row = np.where(turned, 1 - side, side)
        where, give = (np.take_along_axis(part, row[None], axis=0)[0] for part in (at, soft))
        least, most = np.full(n, np.inf), np.full(n, -np.inf)
        np.minimum.at(least, pair, where)
        np.maximum.at(most, pair, where)
        count = np.subtract(*np.searchsorted(space.node, np.stack([most, least])))
        compliance.append((1 + count) * np.bincount(pair, give, n) / np.bincount(pair, minlength=n))
    # Equal but for rounding is equal.
    return np.asarray((compliance[0] >= (1 - SAME_COMPLIANCE) * compliance[1])[pair] != turned)


def _hats(at: Floats, new: Bools, node: Floats, free: Bools) -> Entries:
    """Functions at points that lie one after another on runs.

    ``new`` marks the first point of each run. Its ends have functions of their own where they are
    ``free`` (m,) to part: near the tip of a crack a force hardly moves its faces.
    """
    first = np.flatnonzero(new)
    last = np.append(first[1:], len(at)) - 1
    low, high = _inner(at[first], at[last], node)
    count = high - low + 3
    offset = np.cumsum(count) - count

    own_first, own_last = free[first], free[last] & (last > first)
    inside = np.ones(len(at), dtype=bool)
    inside[first[own_first]] = inside[last[own_last]] = False
    point, run = np.flatnonzero(inside), (np.cumsum(new) - 1)[inside]
    x, least, most = at[inside], low[run], high[run]
    left = np.searchsorted(node, x, side="right") - 1
    left = np.clip(left, least, np.maximum(most - 1, least))
    right = np.minimum(left + 1, most)
    # The first and the last hat begin at the ends of the run.
    begin = np.where(left == least, at[first][run], node[left])
    wide = np.where(right == most, at[last][run], node[right]) - begin
    share = np.divide(x - begin, wide, out=np.zeros_like(x), where=right > left)
    hat = offset[run] + 1 + left - low[run]

    one = np.ones(len(first))
    parts = [
        (first[own_first], offset[own_first], one[own_first]),
        (last[own_last], (offset + count - 1)[own_last], one[own_last]),
        (point, hat, 1 - share),
        (point, hat + 1, share),
    ]
    i, j, value = (np.concatenate(column) for column in zip(*parts, strict=True))
    acts = value > 0
    return Entries(i[acts], np.unique(j[acts], return_inverse=True)[1], value[acts])


def _inner(begin: Floats, end: Floats, node: Floats) -> tuple[Ints, Ints]:
    """First and last node inside runs; the same one node where there is none.

    Nodes nearer to an end of the run than half of their interval there do not count.
    """
    low = np.clip(np.searchsorted(node, begin, side="right"), 1, len(node) - 1)
    low = low + (node[low] - begin < 0.5 * (node[low] - node[low - 1]))
    high = np.clip(np.searchsorted(node, end, side="left") - 1, 0, len(node) - 2)
    high = high - (end - node[high] < 0.5 * (node[high + 1] - node[high]))
    low = np.minimum(low, len(node) - 1)
    return low, np.maximum(high, low)
