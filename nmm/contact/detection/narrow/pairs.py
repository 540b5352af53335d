"""The four lines of two near vertices, judged as a whole."""

import math

from integration.arrays import Floats, Ints
from nmm.compiled import compiled
from nmm.contact.detection.narrow.edges import dot, thinner
from nmm.contact.detection.narrow.lines import USABLE
from nmm.contact.detection.narrow.shields import rays
from nmm.contact.detection.narrow.tables import Shape, Small
from nmm.contact.detection.tolerances import Rules

Four = tuple[int, int, int, int]
StepChoice = tuple[bool, bool, bool, bool]


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
    ox, oy, bx, by = rays(shape, w, partner, -1, rules)
    return dx * ox + dy * oy <= slop and dx * bx + dy * by <= slop


@compiled
def _best(lines: Four, eligible: StepChoice, rank: Floats) -> int:
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
def pair(
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
    dx = shape[v].sx - shape[w].sx
    dy = shape[v].sy - shape[w].sy
    thin = thinner(shape, v, w)
    if math.sqrt(dx * dx + dy * dy) > max(rules.reach, rules.depth * thin):
        return
    p, q = shape[v].previous, shape[w].previous
    one, two = _find(edge, offset, v, w), _find(edge, offset, v, q)
    three, four = _find(edge, offset, w, v), _find(edge, offset, w, p)
    lines = one, two, three, four
    entered = False
    for k in lines:
        entered |= k >= 0 and kept[k] != 0
    if entered:
        _thin_out(shape, lines, (w, q, v, p), (dx, dy), thin, rank, kept, final, rules)
        return
    free = _usable(state, one), _usable(state, two), _usable(state, three), _usable(state, four)
    best = _best(lines, free, rank)
    if best < 0:
        return
    longest = max(shape[v].length, shape[w].length, shape[p].length, shape[q].length)
    slop = rules.end * longest + rules.rounding
    if _beyond(shape, w, shape[v].body, dx, dy, slop, rules) and _beyond(
        shape, v, shape[w].body, -dx, -dy, slop, rules
    ):
        final[lines[best]] = 2


@compiled
def _usable(state: Small, k: int) -> bool:
    return bool(k >= 0 and state[k] & USABLE != 0)


@compiled
def _stands(kept: Small, k: int) -> bool:
    return bool(k >= 0 and kept[k] == 1)


@compiled
def _thin_out(
    shape: Shape,
    lines: Four,
    on: Four,
    apart: tuple[float, float],
    thin: float,
    rank: Floats,
    kept: Small,
    final: Small,
    rules: Rules,
) -> None:
    """Drop the lines, on the edges ``on``, that say what the best of those that stand says."""
    standing = (
        _stands(kept, lines[0]),
        _stands(kept, lines[1]),
        _stands(kept, lines[2]),
        _stands(kept, lines[3]),
    )
    best = _best(lines, standing, rank)
    if best < 0:
        return
    # Contacts that are one above the other are one, however wide the gap.
    tx, ty = shape[on[best]].tx, shape[on[best]].ty
    merged = abs(apart[0] * tx + apart[1] * ty) <= rules.flush * thin + rules.rounding
    for i in range(4):
        if i == best or not standing[i]:
            continue
        # Edges of the other body have the opposite sense.
        agree = dot(shape, on[i], on[best])
        if (i < 2) != (best < 2):
            agree = -agree
        if merged or agree < 1.0 - 2.0 * rules.sine * rules.sine:
            final[lines[i]] = -1
