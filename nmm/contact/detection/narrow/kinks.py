"""Whether edges end in kinks, in which both edges bound the way of a vertex."""

import math

from nmm.compiled import compiled
from nmm.contact.detection.narrow.edges import dot, thinner
from nmm.contact.detection.narrow.tables import Shape
from nmm.contact.detection.tolerances import MERGED_BODIES, RANKED, Rules

Way = tuple[int, int]


@compiled
def covering(shape: Shape, v: int, e: int, end: int) -> int:
    """Return the edge of a third body that lies flush on an edge next to an end of it; or -1."""
    x: int = shape[e].own if end == 0 else shape[shape[e].next].before
    return -1 if x >= 0 and shape[x].body == shape[v].body else x


@compiled
def corner_beside(shape: Shape, at: int, x: int, forward: bool, rules: Rules) -> int:
    """Return the corner of the edge ``x``, flush on one at a corner, that lies there; or -1."""
    corner: int = shape[x].next if forward else x
    dx = shape[corner].sx - shape[at].sx
    dy = shape[corner].sy - shape[at].sy
    flush = 2.0 * (rules.flush * thinner(shape, at, x) + rules.rounding)
    return corner if math.sqrt(dx * dx + dy * dy) <= flush else -1


@compiled
def _beyond(shape: Shape, v: int, e: int, end: int, rules: Rules) -> int:
    """Return the edge of a third body that goes on where an edge ends, beside it; or -1.

    Both bodies are flush there, as slope and flat side by side are. Pieces of the third body lie
    between; what moves as one with the vertex is no third body.
    """
    at = e if end == 0 else shape[e].next
    other, last = -1, -1
    for _ in range(MERGED_BODIES):
        x: int = shape[at].before if end == 0 else shape[at].own
        if x < 0 or shape[x].moves == shape[v].moves or shape[x].body == shape[e].body:
            break
        if last >= 0 and shape[x].moves != shape[last].moves:
            break
        at = corner_beside(shape, at, x, end == 1, rules)
        if at < 0:
            return -1
        other, last = shape[at].previous if end == 0 else at, x
    return other


@compiled
def _turned(shape: Shape, e: int, end: int, other: int, rules: Rules) -> bool:
    """Whether an ``end`` of an edge and the ``other`` one beyond it turn towards each other."""
    if other < 0:
        return False
    turn = shape[other].tx * shape[e].ty - shape[other].ty * shape[e].tx
    return bool((turn if end == 0 else -turn) < -rules.sine)


@compiled
def beside_kink(shape: Shape, v: int, e: int, end: int, rules: Rules) -> int:
    """Return the edge of a third body that makes a kink with an end of an edge, beside it; or -1.

    See `_beyond`.
    """
    other = _beyond(shape, v, e, end, rules)
    return other if _turned(shape, e, end, other, rules) else -1


@compiled
def covered_kink(shape: Shape, v: int, e: int, end: int, rules: Rules) -> bool:
    """Whether an edge ends in a kink, of its body or of two, beside which a third body covers it.

    Both edges that meet there bound the way of a vertex as what covers them gives way.
    """
    if covering(shape, v, e, end) < 0:
        return False
    corner = e if end == 0 else shape[e].next
    return not shape[corner].convex or beside_kink(shape, v, e, end, rules) >= 0


@compiled
def within_kink(shape: Shape, v: int, e: int, side: int, rules: Rules) -> bool:
    """Whether an edge ends in a kink of two, within which the ``side`` next to it lies."""
    if side == shape[e].next:
        return beside_kink(shape, v, e, 1, rules) >= 0
    return bool(side == shape[e].previous and beside_kink(shape, v, e, 0, rules) >= 0)


@compiled
def _depth(shape: Shape, e: int, other: int) -> float:
    """Angle (rad) by which two edges that make a kink turn towards each other."""
    turn = shape[other].tx * shape[e].ty - shape[other].ty * shape[e].tx
    return math.atan2(abs(turn), dot(shape, other, e))


@compiled
def _along(shape: Shape, other: int, end: int, x: float, y: float) -> float:
    """What of a vector goes along an edge, the ``other`` one beyond an ``end``, to the corner."""
    rate = x * shape[other].tx + y * shape[other].ty
    return float(max(rate if end == 0 else -rate, 0.0))


@compiled
def _passing(shape: Shape, pair: Way, kink: Way, behind: Way) -> int:
    """Whether the body of a vertex passes that of an edge (1), that passes it (-1), or unknown (0).

    Both are flush with one body, whose edges ``kink`` and ``behind`` bear them: the first beyond
    the edge, the second beyond a side of the vertex, each with the end it is beyond. Weight says
    so, and where it drives neither how they move.
    """
    (v, e), (other, end), (mate, side_end) = pair, kink, behind
    f = e if end == 0 else shape[e].next
    ahead = _along(shape, other, end, shape[v].wx, shape[v].wy)
    ahead -= _along(shape, mate, side_end, shape[f].wx, shape[f].wy)
    size = math.hypot(shape[v].wx, shape[v].wy) + math.hypot(shape[f].wx, shape[f].wy)
    if abs(ahead) <= RANKED * size:
        ahead = _along(shape, other, end, shape[v].mx, shape[v].my)
        ahead -= _along(shape, mate, side_end, shape[f].mx, shape[f].my)
        size = math.hypot(shape[v].mx, shape[v].my) + math.hypot(shape[f].mx, shape[f].my)
    if abs(ahead) <= RANKED * size:
        return 0
    return 1 if ahead > 0.0 else -1


@compiled
def in_kink_of_two(shape: Shape, v: int, e: int, further: int, rules: Rules) -> bool:
    """Whether a vertex lies in a kink of its body and a flush one, and on the edge by no side.

    As a reentrant vertex it then bounds no way: what stands in the kink slides past it. Where the
    edge ends (``further`` or not) in a kink, too, weight says which body passes the other: the one
    that it drives faster along what both are flush with. Where it drives neither their motion does,
    and at rest that is so of the vertex in the deeper kink. No edge ends in a kink with a body that
    moves as one with that of the vertex, as if supports hold both.
    """
    if shape[v].own == e or shape[v].before == e:
        return False
    last = shape[v].previous
    one, two = _beyond(shape, e, v, 0, rules), _beyond(shape, e, last, 1, rules)
    if max(one, two) < 0:
        return False
    deep_one = _depth(shape, v, one) if _turned(shape, v, 0, one, rules) else 0.0
    deep_two = _depth(shape, last, two) if _turned(shape, last, 1, two, rules) else 0.0
    deep, other = max(deep_one, deep_two), beside_kink(shape, v, e, further, rules)
    if other < 0:
        return deep > 0.0
    # The flush body lies before the vertex where it lies beyond the end of the edge.
    mate, end = (one, 0) if further == 1 else (two, 1)
    passed = _passing(shape, (v, e), (other, further), (mate, end)) if mate >= 0 else 0
    return passed < 0 or (passed == 0 and deep > _depth(shape, e, other))
