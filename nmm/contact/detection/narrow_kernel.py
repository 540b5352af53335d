"""Narrow phase, compiled: the rules of `narrow_phase`, one vertex after the other.

Numba's functions are written for the machine: no row leaves the cache between its tests, and the
names are those of the array form (`nmm.testing.detection`), which the tests hold equal to this one.
One file holds all that call one another because numba's cache does not see changes to what a file
imports: after a change of the columns in `narrow_tables` this file has to be touched.
"""

import math

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.compiled import compiled
from nmm.contact.detection.narrow_tables import (
    BEFORE,
    BODY,
    CONVEX,
    EX,
    EY,
    LENGTH,
    NEXT,
    OWN,
    PREVIOUS,
    SX,
    SY,
    THICK,
    TX,
    TY,
    Columns,
    Shape,
    Small,
    describe,
    offsets,
    shape_of,
)
from nmm.contact.detection.tolerances import MERGED_BODIES, Rules

Rays = tuple[float, float, float, float]
Lines = tuple[int, int, int, int]

_INTERIOR, _USABLE = 1, 2


@compiled
def _thinner(shape: Shape, one: int, other: int) -> float:
    return float(min(shape.real[one, THICK], shape.real[other, THICK]))


@compiled
def _measure(shape: Shape, v: int, e: int) -> tuple[float, float]:
    """Foot along the edge and signed distance of its line, both from the nearer end."""
    tx, ty = shape.real[e, TX], shape.real[e, TY]
    px, py = shape.real[v, SX], shape.real[v, SY]
    dx, dy = px - shape.real[e, SX], py - shape.real[e, SY]
    s = dx * tx + dy * ty
    if s <= 0.5 * shape.real[e, LENGTH]:
        return s, -(tx * dy - ty * dx)
    dx, dy = px - shape.real[e, EX], py - shape.real[e, EY]
    return dx * tx + dy * ty + shape.real[e, LENGTH], -(tx * dy - ty * dx)


@compiled
def _cover(
    shape: Shape, v: int, edge: Ints, low: int, high: int, s: Floats, gap: Floats, rules: Rules
) -> None:
    """Enter the flush covers of both edges at a vertex."""
    cosine = math.sqrt(1.0 - rules.sine * rules.sine)
    best_own = best_before = 0.0
    for k in range(low, high):
        e = edge[k]
        if shape.link[e, BODY] == shape.link[v, BODY]:
            continue
        flush = rules.flush * _thinner(shape, v, e) + rules.rounding
        length = shape.real[e, LENGTH]
        if abs(gap[k]) > flush or s[k] < -flush or s[k] > length + flush:
            continue
        p, back = shape.link[v, PREVIOUS], length - s[k]
        if s[k] > max(best_own, flush) and _dot(shape, v, e) <= -cosine:
            shape.link[v, OWN], best_own = e, s[k]
        if back > max(best_before, flush) and _dot(shape, p, e) <= -cosine:
            shape.link[v, BEFORE], best_before = e, back


@compiled
def _dot(shape: Shape, one: int, other: int) -> float:
    ax, ay = shape.real[one, TX], shape.real[one, TY]
    return float(ax * shape.real[other, TX] + ay * shape.real[other, TY])


@compiled
def _rays(shape: Shape, v: int, partner: int, rules: Rules) -> Rays:
    """Rays of a vertex, merged with its flush neighbours as long as the union is convex."""
    p = shape.link[v, PREVIOUS]
    ox, oy = shape.real[v, TX], shape.real[v, TY]
    bx, by = -shape.real[p, TX], -shape.real[p, TY]
    if shape.link[v, OWN] < 0 and shape.link[v, BEFORE] < 0:
        return ox, oy, bx, by
    good, ux, uy = _walk(shape, v, partner, ox, oy, bx, by, 1.0, rules)
    if good:
        good, wx, wy = _walk(shape, v, partner, bx, by, ux, uy, -1.0, rules)
        if good:
            return ux, uy, wx, wy
    return ox, oy, bx, by


@compiled
def _leaves(shape: Shape, e: int, ox: float, oy: float, bx: float, by: float, rules: Rules) -> bool:
    """First-order entrance condition: both rays leave the edge's solid, and so does all between."""
    tx, ty = shape.real[e, TX], shape.real[e, TY]
    own, before = ox * ty - oy * tx, bx * ty - by * tx
    flat = max(own, before) <= rules.sine
    return min(own, before) >= -rules.sine and not (flat and ox * tx + oy * ty > 0.0)


@compiled
def _walk(
    shape: Shape,
    v: int,
    partner: int,
    rx: float,
    ry: float,
    ax: float,
    ay: float,
    sense: float,
    rules: Rules,
) -> tuple[bool, float, float]:
    """Turn one ray of a vertex over its flush neighbours; False where the union is not convex.

    ``sense`` is 1 forward and -1 backward: of a truth that is written out each value is compiled.
    """
    at, forward = v, sense > 0.0
    for _ in range(MERGED_BODIES):
        x = shape.link[at, OWN] if forward else shape.link[at, BEFORE]
        if x < 0 or shape.link[x, BODY] == partner or shape.link[x, BODY] == shape.link[v, BODY]:
            break
        corner = shape.link[x, NEXT] if forward else x
        dx = shape.real[corner, SX] - shape.real[at, SX]
        dy = shape.real[corner, SY] - shape.real[at, SY]
        flush = 2.0 * (rules.flush * _thinner(shape, at, x) + rules.rounding)
        if dx * dx + dy * dy > flush * flush or not shape.link[corner, CONVEX]:
            return False, rx, ry
        if forward:
            rx, ry = shape.real[corner, TX], shape.real[corner, TY]
            turn = rx * ay - ry * ax
        else:
            p = shape.link[corner, PREVIOUS]
            rx, ry = -shape.real[p, TX], -shape.real[p, TY]
            turn = ax * ry - ay * rx
        if turn < -rules.sine or (turn <= rules.sine and rx * ax + ry * ay > 0.0):
            return False, rx, ry
        at = corner
    return True, rx, ry


@compiled
def _aside(shape: Shape, e: int, x: int, end: int) -> float:
    """Distance of the start (``end`` 0) or end of an edge from the line of another."""
    px, py = (shape.real[e, SX], shape.real[e, SY])
    if end == 1:
        px, py = (shape.real[e, EX], shape.real[e, EY])
    dx, dy = px - shape.real[x, SX], py - shape.real[x, SY]
    return float(shape.real[x, TX] * dy - shape.real[x, TY] * dx)


@compiled
def _closed(shape: Shape, e: int, x: int, end: int, aside: float, rules: Rules) -> float:
    """How far from the end of an edge another one beside it, that opens, is still flush."""
    opening: float = shape.real[x, TX] * shape.real[e, TY] - shape.real[x, TY] * shape.real[e, TX]
    if end == 0:
        opening = -opening
    if opening <= 0.0:
        return np.inf
    return max(rules.flush * _thinner(shape, e, x) + rules.rounding - aside, 0.0) / opening


@compiled
def _shielded(shape: Shape, v: int, e: int, s: float, rules: Rules) -> bool:
    """Whether the foot is on a stretch of edge, next to its end, that a third body covers."""
    length, partner = shape.real[e, LENGTH], shape.link[v, BODY]
    room = rules.depth * shape.real[v, THICK] + rules.rounding
    foot = min(max(s, 0.0), length)
    total = 0.0
    for end in range(2):
        x = shape.link[e, OWN] if end == 0 else shape.link[shape.link[e, NEXT], BEFORE]
        if x < 0 or shape.link[x, BODY] == partner:
            continue
        if end == 0:
            distance = foot
            dx = shape.real[x, SX] - shape.real[e, SX]
            dy = shape.real[x, SY] - shape.real[e, SY]
        else:
            distance = length - foot
            dx = shape.real[x, EX] - shape.real[e, EX]
            dy = shape.real[x, EY] - shape.real[e, EY]
        aside, thin = abs(_aside(shape, e, x, end)), _thinner(shape, e, x)
        if aside > room:
            continue
        covered = abs(dx * shape.real[e, TX] + dy * shape.real[e, TY])
        covered = min(covered, _closed(shape, e, x, end, aside, rules))
        if covered >= length - (rules.flush * thin + rules.rounding):
            return True
        if distance <= covered - min(rules.depth * thin, 0.5 * covered):
            return True
        total += covered
    return bool(total >= length - rules.flush * shape.real[e, THICK])


@compiled
def _rank(
    shape: Shape, motion: Floats, v: int, e: int, s: float, gap: float, known: bool, rules: Rules
) -> float:
    """Smallest gap over the step in whole grains, so that rounding does not choose."""
    rank = gap
    tx, ty = shape.real[e, TX], shape.real[e, TY]
    if len(motion) > 0:
        length = shape.real[e, LENGTH] if shape.real[e, LENGTH] > 0.0 else 1.0
        a, f = min(max(s / length, 0.0), 1.0), shape.link[e, NEXT]
        mx = motion[v, 0] - (motion[e, 0] + a * (motion[f, 0] - motion[e, 0]))
        my = motion[v, 1] - (motion[e, 1] + a * (motion[f, 1] - motion[e, 1]))
        rank = min(gap, gap + mx * ty - my * tx)
    if known:
        rank += rules.flush * _thinner(shape, v, e)
    return math.floor(rank / rules.grain + 0.5)


@compiled
def _inside(shape: Shape, one: int, other: int, rules: Rules) -> bool:
    """Whether the middle of one edge is not outside the line of the other."""
    mx = 0.5 * (shape.real[one, SX] + shape.real[one, EX]) - shape.real[other, SX]
    my = 0.5 * (shape.real[one, SY] + shape.real[one, EY]) - shape.real[other, SY]
    off = mx * shape.real[other, TY] - my * shape.real[other, TX]
    both = shape.real[one, LENGTH] + shape.real[other, LENGTH]
    return bool(off <= 0.5 * rules.sine * both)


@compiled
def _judge(
    shape: Shape,
    v: int,
    edge: Ints,
    low: int,
    high: int,
    s: Floats,
    gap: Floats,
    known: Bools,
    state: Small,
    rules: Rules,
) -> None:
    """Enter for each row of a vertex whether the foot is inside and the edge can be entered."""
    p = shape.link[v, PREVIOUS]
    ox, oy = shape.real[v, TX], shape.real[v, TY]
    bx, by = -shape.real[p, TX], -shape.real[p, TY]
    covered = shape.link[v, OWN] >= 0 or shape.link[v, BEFORE] >= 0
    for k in range(low, high):
        e = edge[k]
        # A contact stays a little beyond the end of its edge, lest two vertices take turns.
        slop = rules.rounding
        slop += (
            rules.flush * _thinner(shape, v, e) if known[k] else rules.end * shape.real[e, LENGTH]
        )
        state[k] = 0
        if s[k] >= -slop and s[k] <= shape.real[e, LENGTH] + slop:
            state[k] = _INTERIOR
        if not shape.link[v, CONVEX] or gap[k] > rules.reach or shape.real[e, LENGTH] <= 0.0:
            continue
        # In one body the far face of a thin neck looks like a face that is overlapped.
        trusted = known[k] or shape.link[v, BODY] != shape.link[e, BODY]
        if gap[k] < -(rules.depth if trusted else rules.flush) * _thinner(shape, v, e):
            continue
        if not _leaves(shape, e, ox, oy, bx, by, rules):
            continue
        if covered:
            ux, uy, wx, wy = _rays(shape, v, shape.link[e, BODY], rules)
            if not _leaves(shape, e, ux, uy, wx, wy, rules):
                continue
        if not _shielded(shape, v, e, s[k], rules):
            state[k] |= _USABLE


@compiled
def _passes(shape: Shape, v: int, e: int, s: float, gap: float) -> bool:
    """Whether one of the edges at a vertex outside an edge passes through it."""
    p = shape.link[v, PREVIOUS]
    tx, ty = shape.real[e, TX], shape.real[e, TY]
    for side in range(2):
        if side == 0:
            rx, ry, length = shape.real[v, TX], shape.real[v, TY], shape.real[v, LENGTH]
        else:
            rx, ry, length = -shape.real[p, TX], -shape.real[p, TY], shape.real[p, LENGTH]
        down = ry * tx - rx * ty
        if down > 0.0 and gap <= down * length:
            at = s + gap / down * (rx * tx + ry * ty)
            if at > 0.0 and at < shape.real[e, LENGTH]:
                return True
    return False


@compiled
def _dominate(
    shape: Shape,
    v: int,
    edge: Ints,
    low: int,
    high: int,
    s: Floats,
    gap: Floats,
    state: Small,
    rank: Floats,
    kept: Small,
    rules: Rules,
) -> None:
    """Keep of the rows of a vertex those over which no other edge of the same body stands."""
    both = _INTERIOR | _USABLE
    for i in range(low, high):
        kept[i] = 0
        if state[i] != both:
            continue
        kept[i] = 1
        for j in range(low, high):
            if (
                i == j
                or not state[j] & _INTERIOR
                or shape.link[edge[i], BODY] != shape.link[edge[j], BODY]
            ):
                continue
            if state[j] == both:
                better = rank[j] > rank[i] or (rank[j] == rank[i] and j < i)
            else:
                better = gap[j] > rules.grain and gap[i] < 0.0
                better = better and not _passes(shape, v, edge[j], s[j], gap[j])
            if (
                better
                and _inside(shape, edge[i], edge[j], rules)
                and _inside(shape, edge[j], edge[i], rules)
            ):
                kept[i] = -1
                break


@compiled
def _find(edge: Ints, offset: Ints, v: int, e: int) -> int:
    for k in range(offset[v], offset[v + 1]):
        if edge[k] == e:
            return k
    return -1


@compiled
def _beyond(
    shape: Shape, w: int, partner: int, dx: float, dy: float, slop: float, rules: Rules
) -> bool:
    ox, oy, bx, by = _rays(shape, w, partner, rules)
    return dx * ox + dy * oy <= slop and dx * bx + dy * by <= slop


@compiled
def _best(lines: Lines, eligible: tuple[bool, bool, bool, bool], rank: Floats) -> int:
    """Index of the eligible line of highest rank, the first row among equals; -1 without any."""
    best = -1
    for i in range(4):
        if not eligible[i]:
            continue
        k, b = lines[i], lines[best]
        if best < 0 or rank[k] > rank[b] or (rank[k] == rank[b] and k < b):
            best = i
    return best


@compiled
def _pair(
    shape: Shape,
    v: int,
    w: int,
    edge: Ints,
    offset: Ints,
    state: Small,
    rank: Floats,
    kept: Small,
    final: Small,
    rules: Rules,
) -> None:
    """Judge the four lines at a pair of near vertices as a whole."""
    dx = shape.real[v, SX] - shape.real[w, SX]
    dy = shape.real[v, SY] - shape.real[w, SY]
    apart = math.sqrt(dx * dx + dy * dy)
    thin = _thinner(shape, v, w)
    if apart > max(rules.reach, rules.depth * thin):
        return
    p, q = shape.link[v, PREVIOUS], shape.link[w, PREVIOUS]
    lines = (
        _find(edge, offset, v, w),
        _find(edge, offset, v, q),
        _find(edge, offset, w, v),
        _find(edge, offset, w, p),
    )
    on = (w, q, v, p)
    entered = False
    for k in lines:
        entered |= k >= 0 and kept[k] != 0
    if entered:
        standing = (
            lines[0] >= 0 and kept[lines[0]] == 1,
            lines[1] >= 0 and kept[lines[1]] == 1,
            lines[2] >= 0 and kept[lines[2]] == 1,
            lines[3] >= 0 and kept[lines[3]] == 1,
        )
        best = _best(lines, standing, rank)
        if best < 0:
            return
        # Contacts that are one above the other are one, however wide the gap.
        beside = abs(dx * shape.real[on[best], TX] + dy * shape.real[on[best], TY])
        merged = beside <= rules.flush * thin + rules.rounding
        for i in range(4):
            if i == best or not standing[i]:
                continue
            # Edges of the other body have the opposite sense.
            agree = _dot(shape, on[i], on[best])
            if (i < 2) != (best < 2):
                agree = -agree
            if merged or agree < 1.0 - 2.0 * rules.sine * rules.sine:
                final[lines[i]] = -1
        return
    free = (
        lines[0] >= 0 and state[lines[0]] & _USABLE != 0,
        lines[1] >= 0 and state[lines[1]] & _USABLE != 0,
        lines[2] >= 0 and state[lines[2]] & _USABLE != 0,
        lines[3] >= 0 and state[lines[3]] & _USABLE != 0,
    )
    best = _best(lines, free, rank)
    if best < 0:
        return
    longest = max(
        shape.real[v, LENGTH], shape.real[w, LENGTH], shape.real[p, LENGTH], shape.real[q, LENGTH]
    )
    slop = rules.end * longest + rules.rounding
    if _beyond(shape, w, shape.link[v, BODY], dx, dy, slop, rules) and _beyond(
        shape, v, shape.link[w, BODY], -dx, -dy, slop, rules
    ):
        final[lines[best]] = 2


@compiled
def _known(edge: Ints, offset: Ints, last: Ints) -> Bools:
    """Which rows were contacts before; both lists rise, so one walk along them tells."""
    n = len(offset) - 1
    known = np.zeros(len(edge), np.bool_)
    at = 0
    for v in range(n):
        for k in range(offset[v], offset[v + 1]):
            key = v * n + edge[k]
            while at < len(last) and last[at] < key:
                at += 1
            known[k] = at < len(last) and last[at] == key
    return known


@compiled
def select(
    shape: Shape, vertex: Ints, edge: Ints, offset: Ints, last: Ints, motion: Floats, rules: Rules
) -> tuple[Ints, Small, Floats, Floats]:
    """Return the kept rows, and kept, along and gap of all rows.

    ``kept`` is 0 for no contact, 1 for a vertex over an edge, 2 for one beyond its end; ``along``
    the foot's distance from the start of the edge; ``last`` keys of the last contacts, rising.
    """
    m, n = len(vertex), len(offset) - 1
    s, gap = np.empty(m), np.empty(m)
    for v in range(n):
        low, high = offset[v], offset[v + 1]
        for k in range(low, high):
            s[k], gap[k] = _measure(shape, v, edge[k])
        _cover(shape, v, edge, low, high, s, gap, rules)
    state, kept = np.empty(m, np.int8), np.empty(m, np.int8)
    rank = np.empty(m)
    known = _known(edge, offset, last)
    for v in range(n):
        low, high = offset[v], offset[v + 1]
        _judge(shape, v, edge, low, high, s, gap, known, state, rules)
        for k in range(low, high):
            if state[k] & _USABLE:
                rank[k] = _rank(shape, motion, v, edge[k], s[k], gap[k], known[k], rules)
        _dominate(shape, v, edge, low, high, s, gap, state, rank, kept, rules)
    final = kept.copy()
    for k in range(m):
        v, w = vertex[k], edge[k]
        if v < w and shape.link[v, CONVEX] and shape.link[w, CONVEX]:
            _pair(shape, v, w, edge, offset, state, rank, kept, final, rules)
    rows, count = np.empty(m, np.int64), 0
    for k in range(m):
        if final[k] > 0:
            rows[count] = k
            count += 1
    return rows[:count].copy(), final, s, gap


@compiled
def _contacts(
    start: Floats,
    end: Floats,
    body: Ints,
    following: Ints,
    previous: Ints,
    vertex: Ints,
    edge: Ints,
    last: Ints,
    motion: Floats,
    rules: Rules,
) -> tuple[bool, Columns]:
    """Whether both lists rise, and if so the columns of `narrow.Contacts`."""
    offset, rising = offsets(vertex, edge, len(start))
    for k in range(1, len(last)):
        rising &= last[k] >= last[k - 1]
    if not rising:
        vertex, edge = vertex[:0], edge[:0]
        offset[:] = 0
    shape = shape_of(start, end, body, following, previous, rules.sine)
    rows, final, s, gap = select(shape, vertex, edge, offset, last, motion, rules)
    return rising, describe(shape, vertex, edge, rows, final, s, gap, rules)


def find(
    start: Floats,
    end: Floats,
    body: Ints,
    following: Ints,
    previous: Ints,
    vertex: Ints,
    edge: Ints,
    last: Ints,
    motion: Floats,
    rules: Rules,
) -> Columns:
    """Columns of `narrow.Contacts`; candidates in any order, ``last`` keys in any order."""
    surface = start, end, body, following, previous
    rising, columns = _contacts(*surface, vertex, edge, last, motion, rules)
    if not rising:
        key = np.unique(vertex * len(start) + edge)
        vertex, edge = key // len(start), key % len(start)
        _, columns = _contacts(*surface, vertex, edge, np.sort(last), motion, rules)
    return columns
