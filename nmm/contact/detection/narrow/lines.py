"""Each line of a vertex and an edge by itself, and those of one vertex among each other."""

import math

from integration.arrays import Bools, Floats
from nmm.compiled import compiled
from nmm.contact.detection.narrow.edges import thinner
from nmm.contact.detection.narrow.kinks import (
    beside_kink,
    covered_kink,
    in_kink_of_two,
    within_kink,
)
from nmm.contact.detection.narrow.shields import leaves, rays, shielded
from nmm.contact.detection.narrow.tables import EdgesOfVertex, Shape, Small
from nmm.contact.detection.tolerances import Rules

INTERIOR, USABLE = 1, 2
"""Bits of a state."""


@compiled
def rank_of(
    shape: Shape, motion: Floats, v: int, e: int, s: float, gap: float, known: bool, rules: Rules
) -> float:
    """Smallest gap over the step in whole grains, so that rounding does not choose."""
    rank = gap
    tx, ty = shape[e].tx, shape[e].ty
    if len(motion) > 0:
        length = shape[e].length if shape[e].length > 0.0 else 1.0
        a, f = min(max(s / length, 0.0), 1.0), shape[e].next
        mx = motion[v, 0] - (motion[e, 0] + a * (motion[f, 0] - motion[e, 0]))
        my = motion[v, 1] - (motion[e, 1] + a * (motion[f, 1] - motion[e, 1]))
        rank = min(gap, gap + mx * ty - my * tx)
    if known:
        rank += rules.flush * thinner(shape, v, e)
    return math.floor(rank / rules.grain + 0.5)


@compiled
def _inside(shape: Shape, one: int, other: int, rules: Rules) -> bool:
    """Whether the middle of one edge is not outside the line of the other."""
    mx = 0.5 * (shape[one].sx + shape[one].ex) - shape[other].sx
    my = 0.5 * (shape[one].sy + shape[one].ey) - shape[other].sy
    off = mx * shape[other].ty - my * shape[other].tx
    both = shape[one].length + shape[other].length
    return bool(off <= 0.5 * rules.sine * both)


@compiled
def _beside(shape: Shape, v: int, e: int, s: float, known: bool, rules: Rules) -> bool:
    """Whether the foot of a vertex is on an edge, or a little beyond the end.

    A contact stays there, lest two vertices take turns; in a covered kink both edges bound the way.
    """
    sharp = rules.end * shape[e].length + rules.rounding
    flush = rules.flush * thinner(shape, v, e) + rules.rounding
    # Beside the nearer end; an end that is written out is compiled once for each.
    room = flush if known or covered_kink(shape, v, e, int(s > 0.0), rules) else sharp
    return bool(s >= -room and s <= shape[e].length + room)


@compiled
def judge(
    shape: Shape, v: int, before: EdgesOfVertex, known: Bools, state: Small, rules: Rules
) -> None:
    """Enter for each row of a vertex whether the foot is inside and the edge can be entered."""
    edge, low, high, s, gap = before
    p = shape[v].previous
    ox, oy = shape[v].tx, shape[v].ty
    bx, by = -shape[p].tx, -shape[p].ty
    covered = shape[v].own >= 0 or shape[v].before >= 0
    for k in range(low, high):
        e = edge[k]
        state[k] = 0
        if _beside(shape, v, e, s[k], known[k], rules):
            state[k] = INTERIOR
        if not shape[v].convex or gap[k] > rules.reach or shape[e].length <= 0.0:
            continue
        # In one body the far face of a thin neck looks like a face that is overlapped.
        trusted = known[k] or shape[v].body != shape[e].body
        if gap[k] < -(rules.depth if trusted else rules.flush) * thinner(shape, v, e):
            continue
        if not leaves(shape, e, ox, oy, bx, by, rules):
            continue
        if covered:
            further = int(s[k] > 0.5 * shape[e].length)
            if in_kink_of_two(shape, v, e, further, rules):
                continue
            mate = beside_kink(shape, v, e, further, rules)
            mate = shape[mate].body if mate >= 0 else -1
            ux, uy, wx, wy = rays(shape, v, shape[e].body, mate, rules)
            if not leaves(shape, e, ux, uy, wx, wy, rules):
                continue
        if not shielded(shape, v, e, s[k], gap[k], rules):
            state[k] |= USABLE


@compiled
def _passes(shape: Shape, v: int, e: int, s: float, gap: float) -> bool:
    """Whether one of the edges at a vertex outside an edge passes through it."""
    p = shape[v].previous
    tx, ty = shape[e].tx, shape[e].ty
    for side in range(2):
        if side == 0:
            rx, ry, length = shape[v].tx, shape[v].ty, shape[v].length
        else:
            rx, ry, length = -shape[p].tx, -shape[p].ty, shape[p].length
        down = ry * tx - rx * ty
        if down > 0.0 and gap <= down * length:
            at = s + gap / down * (rx * tx + ry * ty)
            if at > 0.0 and at < shape[e].length:
                return True
    return False


@compiled
def dominate(
    shape: Shape,
    v: int,
    before: EdgesOfVertex,
    state: Small,
    rank: Floats,
    kept: Small,
    rules: Rules,
) -> None:
    """Keep of the rows of a vertex those over which no other edge of the same body stands."""
    edge, low, high, s, gap = before
    both = INTERIOR | USABLE
    for i in range(low, high):
        kept[i] = 0
        if state[i] != both:
            continue
        kept[i] = 1
        for j in range(low, high):
            if i == j or not state[j] & INTERIOR or shape[edge[i]].body != shape[edge[j]].body:
                continue
            if state[j] == both:
                better = rank[j] > rank[i] or (rank[j] == rank[i] and j < i)
            else:
                better = gap[j] > rules.grain and gap[i] < 0.0
                better = better and not _passes(shape, v, edge[j], s[j], gap[j])
                better = better and not within_kink(shape, v, edge[i], edge[j], rules)
            if (
                better
                and _inside(shape, edge[i], edge[j], rules)
                and _inside(shape, edge[j], edge[i], rules)
            ):
                kept[i] = -1
                break
