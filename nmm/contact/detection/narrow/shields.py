"""Whether a vertex sees an edge, or material of its own body or of the other lies between."""

import numpy as np

from nmm.compiled import compiled
from nmm.contact.detection.narrow.edges import thinner
from nmm.contact.detection.narrow.tables import (
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
    Shape,
)
from nmm.contact.detection.tolerances import MERGED_BODIES, Rules

Rays = tuple[float, float, float, float]


@compiled
def rays(shape: Shape, v: int, partner: int, rules: Rules) -> Rays:
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
def leaves(shape: Shape, e: int, ox: float, oy: float, bx: float, by: float, rules: Rules) -> bool:
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
        flush = 2.0 * (rules.flush * thinner(shape, at, x) + rules.rounding)
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
    return max(rules.flush * thinner(shape, e, x) + rules.rounding - aside, 0.0) / opening


@compiled
def shielded(shape: Shape, v: int, e: int, s: float, rules: Rules) -> bool:
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
        aside, thin = abs(_aside(shape, e, x, end)), thinner(shape, e, x)
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
