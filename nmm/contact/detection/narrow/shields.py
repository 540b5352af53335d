"""Whether a vertex sees an edge, or material of its own body or of the other lies between."""

import numpy as np

from nmm.compiled import compiled
from nmm.contact.detection.narrow.edges import thinner
from nmm.contact.detection.narrow.kinks import corner_beside, covered_kink, covering
from nmm.contact.detection.narrow.tables import Shape
from nmm.contact.detection.tolerances import MERGED_BODIES, Rules

Rays = tuple[float, float, float, float]


@compiled
def rays(shape: Shape, v: int, partner: int, mate: int, rules: Rules) -> Rays:
    """Rays of a vertex, merged with its flush neighbours as long as the union is convex.

    The partner is none of them, nor its ``mate`` (-1 for none), which makes a kink with it.
    """
    p = shape[v].previous
    ox, oy = shape[v].tx, shape[v].ty
    bx, by = -shape[p].tx, -shape[p].ty
    if shape[v].own < 0 and shape[v].before < 0:
        return ox, oy, bx, by
    good, ux, uy = _walk(shape, v, (partner, mate), ox, oy, bx, by, 1.0, rules)
    if good:
        good, wx, wy = _walk(shape, v, (partner, mate), bx, by, ux, uy, -1.0, rules)
        if good:
            return ux, uy, wx, wy
    return ox, oy, bx, by


@compiled
def leaves(shape: Shape, e: int, ox: float, oy: float, bx: float, by: float, rules: Rules) -> bool:
    """First-order entrance condition: both rays leave the edge's solid, and so does all between."""
    tx, ty = shape[e].tx, shape[e].ty
    own, before = ox * ty - oy * tx, bx * ty - by * tx
    flat = max(own, before) <= rules.sine
    return min(own, before) >= -rules.sine and not (flat and ox * tx + oy * ty > 0.0)


@compiled
def _walk(
    shape: Shape,
    v: int,
    apart: tuple[int, int],
    rx: float,
    ry: float,
    ax: float,
    ay: float,
    sense: float,
    rules: Rules,
) -> tuple[bool, float, float]:
    """Turn one ray of a vertex over its flush neighbours; False where the union is not convex.

    Bodies ``apart`` are no neighbours. ``sense`` is 1 forward and -1 backward: of a truth that is
    written out each value is compiled.
    """
    at, forward = v, sense > 0.0
    for _ in range(MERGED_BODIES):
        x = shape[at].own if forward else shape[at].before
        if x < 0 or shape[x].body in (shape[v].body, apart[0], apart[1]):
            break
        corner = corner_beside(shape, at, x, forward, rules)
        if corner < 0 or not shape[corner].convex:
            return False, rx, ry
        if forward:
            rx, ry = shape[corner].tx, shape[corner].ty
            turn = rx * ay - ry * ax
        else:
            p = shape[corner].previous
            rx, ry = -shape[p].tx, -shape[p].ty
            turn = ax * ry - ay * rx
        if turn < -rules.sine or (turn <= rules.sine and rx * ax + ry * ay > 0.0):
            return False, rx, ry
        at = corner
    return True, rx, ry


@compiled
def _aside(shape: Shape, e: int, x: int, end: int) -> float:
    """Distance of the start (``end`` 0) or end of an edge from the line of another."""
    px, py = (shape[e].sx, shape[e].sy)
    if end == 1:
        px, py = (shape[e].ex, shape[e].ey)
    dx, dy = px - shape[x].sx, py - shape[x].sy
    return float(shape[x].tx * dy - shape[x].ty * dx)


@compiled
def _closed(shape: Shape, e: int, x: int, end: int, aside: float, rules: Rules) -> float:
    """How far from the end of an edge another one beside it, that opens, is still flush."""
    opening: float = shape[x].tx * shape[e].ty - shape[x].ty * shape[e].tx
    if end == 0:
        opening = -opening
    if opening <= 0.0:
        return np.inf
    return max(rules.flush * thinner(shape, e, x) + rules.rounding - aside, 0.0) / opening


@compiled
def shielded(shape: Shape, v: int, e: int, s: float, gap: float, rules: Rules) -> bool:
    """Whether the foot is on a stretch of edge, next to its end, that a third body covers."""
    length = shape[e].length
    room = rules.depth * shape[v].thick + rules.rounding
    foot = min(max(s, 0.0), length)
    flush = rules.flush * thinner(shape, v, e) + rules.rounding
    beside = min(foot, length - foot)
    if max(beside, abs(gap)) <= flush and covered_kink(shape, v, e, int(foot > beside), rules):
        return False
    total = 0.0
    for end in range(2):
        x = covering(shape, v, e, end)
        if x < 0:
            continue
        if end == 0:
            distance = foot
            dx = shape[x].sx - shape[e].sx
            dy = shape[x].sy - shape[e].sy
        else:
            distance = length - foot
            dx = shape[x].ex - shape[e].ex
            dy = shape[x].ey - shape[e].ey
        aside, thin = abs(_aside(shape, e, x, end)), thinner(shape, e, x)
        if aside > room:
            continue
        covered = abs(dx * shape[e].tx + dy * shape[e].ty)
        covered = min(covered, _closed(shape, e, x, end, aside, rules))
        if covered >= length - (rules.flush * thin + rules.rounding):
            return True
        if distance <= covered - min(rules.depth * thin, 0.5 * covered):
            return True
        total += covered
    return bool(total >= length - rules.flush * shape[e].thick)
