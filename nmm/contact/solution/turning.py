"""Turning bodies as contact sees them, compiled: where forces should act, and what they owe."""

import numpy as np

from integration.arrays import Floats, Ints
from nmm.assembly.moving.moved_bodies import Entries, mean, spread
from nmm.compiled import compiled

Pressing = tuple[Ints, Ints, Floats, Floats]
"""Edges of sides a and b, normal force and gap (m,) of contacts."""


@compiled
def matters(
    contacts: Pressing,
    body: Ints,
    motions: tuple[Floats, Floats, Floats, Floats],
    share: float,
    least: float,
) -> bool:
    """Whether gaps are off, with forces not half way, by a ``share`` of the deepest.

    That counts no less than ``least`` of the largest way: exact contacts leave gaps of rounding.
    ``motions`` of bodies (B,): turns (rad) and ways (m) to half way and to there from where forces
    act; ``body`` (n,) of the edges.
    """
    edge_a, edge_b, force, gap = contacts
    turn, way, turned, moved = motions
    deepest, farthest = 0.0, _largest(way)
    for c in range(len(gap)):
        if force[c] != 0.0:
            deepest = max(deepest, abs(gap[c]), least * farthest)
    # Most steps turn no body by as much as would matter to any.
    most = _largest(turned) * farthest + _largest(moved) * _largest(turn)
    if not 2 * most > share * deepest > 0:
        return False
    off = 0.0
    for c in range(len(gap)):
        if force[c] != 0.0:
            a, b = body[edge_a[c]], body[edge_b[c]]
            one = max(turned[a], turned[b]) * max(way[a], way[b])
            off = max(off, one + max(moved[a], moved[b]) * max(turn[a], turn[b]))
    return 2 * off > share * deepest


@compiled
def _largest(sizes: Floats) -> float:
    """Largest of some sizes: numba's own takes 0.4 s to compile."""
    largest = 0.0
    for size in sizes:
        largest = max(largest, size)
    return largest


@compiled
def foreseen(
    flights: tuple[Floats, Floats],
    projection: Entries,
    contacts: Pressing,
    bodies: tuple[Ints, Floats],
    share: float,
    least: float,
) -> tuple[bool, Floats]:
    """Whether bodies turn so far in a step that its forces should act half way, and its way (n,).

    ``flights`` (n,) are ways at the velocity now and, had its acceleration not changed, in the last
    step: what rattles neither goes on nor flies, so bodies go as far as both agree. ``bodies`` are
    those of the edges, and how wide they are (m).
    """
    flight, last = flights
    way = np.zeros(len(flight))
    for k in range(len(way)):
        if last[k] * flight[k] > 0:
            way[k] = np.copysign(min(abs(last[k]), abs(flight[k])), flight[k])
    whole = mean(projection, way)
    body, across = bodies
    turn, moved = np.empty(len(across)), np.empty(len(across))
    for b in range(len(across)):
        turn[b] = abs(whole[3 * b + 2]) / 2
        moved[b] = np.hypot(whole[3 * b], whole[3 * b + 1]) / 2
    motions = turn, moved + turn * across, turn, moved
    return matters(contacts, body, motions, share, least), way


@compiled
def owed(
    rest: Floats,
    push: Floats,
    modes: Entries,
    edges: tuple[Floats, Ints, Ints],
    centre: Floats,
    contacts: tuple[Ints, Ints, Floats, Floats, Ints],
    through: tuple[Floats, Floats, Floats],
    gain: Floats,
) -> Floats:
    """Return the velocity (n,) that keeps momentum and angular momentum.

    Parameters
    ----------
    rest, push
        (n,) what is left of the forces, and those of contact (N).
    modes
        Columns (n, 3 B) of rigid motions.
    edges
        Where their starts are half way (k, 2), the edge that follows each, and their bodies.
    contacts
        Edges and parameters (m,) of both sides, and keys.
    through
        Normals (m, 2), and forces (m,) along them and across.
    gain
        (3 B,) velocity by force (s / kg).
    """
    acting = moments(edges, centre, contacts, through)
    left, acted = mean(modes, rest - push), mean(modes, push)
    for b in range(len(acting)):
        left[3 * b + 2] += acted[3 * b + 2] - acting[b]
    found: Floats = spread(modes, gain * left, len(rest))
    return found


@compiled
def moments(
    edges: tuple[Floats, Ints, Ints],
    centre: Floats,
    contacts: tuple[Ints, Ints, Floats, Floats, Ints],
    through: tuple[Floats, Floats, Floats],
) -> Floats:
    """Moments (B,) about ``centre`` (B, 2) of the contact forces; see `owed`.

    Between two faces, in joints and inside stretches, neither side is the first: forces act half
    way from side a to side b; elsewhere on side a.
    """
    start, following, body = edges
    edge_a, edge_b, parameter_a, parameter_b, key = contacts
    direction, normal, shear = through
    found = np.zeros(len(centre))
    for c in range(len(normal)):
        share = 0.5 if key[c] < 0 or parameter_a[c] > 0 else 0.0
        x = y = 0.0
        for side in range(2):
            at, s = (edge_a[c], parameter_a[c]) if side == 0 else (edge_b[c], parameter_b[c])
            part, end = share if side else 1.0 - share, following[at]
            x += part * (start[at, 0] + s * (start[end, 0] - start[at, 0]))
            y += part * (start[at, 1] + s * (start[end, 1] - start[at, 1]))
        # The tangent is the normal turned clockwise.
        fx = normal[c] * direction[c, 0] + shear[c] * direction[c, 1]
        fy = normal[c] * direction[c, 1] - shear[c] * direction[c, 0]
        one, other = body[edge_a[c]], body[edge_b[c]]
        found[one] += (x - centre[one, 0]) * fy - (y - centre[one, 1]) * fx
        found[other] -= (x - centre[other, 0]) * fy - (y - centre[other, 1]) * fx
    return found
