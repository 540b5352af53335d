"""Whether edges end in kinks, in which both edges bound the way of a vertex."""

import math

from nmm.compiled import compiled
from nmm.contact.detection.narrow.edges import dot, thinner
from nmm.contact.detection.narrow.tables import Shape
from nmm.contact.detection.tolerances import MERGED_BODIES, Rules


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
def beside_kink(shape: Shape, v: int, e: int, end: int, rules: Rules) -> int:
    """Return the edge of a third body that makes a kink with an end of an edge, beside it; or -1.

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
    if other < 0:
        return -1
    turn = shape[other].tx * shape[e].ty - shape[other].ty * shape[e].tx
    return other if (turn if end == 0 else -turn) < -rules.sine else -1


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
def _depth(shape: Shape, v: int, e: int, end: int, rules: Rules) -> float:
    """Angle (rad) by which an end of an edge and a third body turn towards each other, or 0."""
    other = beside_kink(shape, v, e, end, rules)
    if other < 0:
        return 0.0
    turn = shape[other].tx * shape[e].ty - shape[other].ty * shape[e].tx
    return math.atan2(abs(turn), dot(shape, other, e))


@compiled
def in_kink_of_two(shape: Shape, v: int, e: int, further: int, rules: Rules) -> bool:
    """Whether a vertex lies in a kink of its body and a flush one, and on the edge by no side.

    As a reentrant vertex it then bounds no way: what stands in the kink slides past it. Where the
    edge ends (``further`` or not) in a kink, too, that is so of the vertex in the deeper one. No
    edge does so with a body that moves as one with that of the vertex, as if supports hold both.
    """
    if shape[v].own == e or shape[v].before == e:
        return False
    one, two = _depth(shape, e, v, 0, rules), _depth(shape, e, shape[v].previous, 1, rules)
    deep = max(one, two)
    return deep > 0.0 and deep > _depth(shape, v, e, further, rules)
