"""A vertex beside an edge, and two edges beside each other."""

import math

from integration.arrays import Floats, Ints
from nmm.compiled import compiled
from nmm.contact.detection.narrow.tables import (
    BEFORE,
    BODY,
    EX,
    EY,
    LENGTH,
    OWN,
    PREVIOUS,
    SX,
    SY,
    THICK,
    TX,
    TY,
    Shape,
)
from nmm.contact.detection.tolerances import Rules


@compiled
def thinner(shape: Shape, one: int, other: int) -> float:
    """Thickness (m) of the thinner of the bodies of two edges."""
    return float(min(shape.real[one, THICK], shape.real[other, THICK]))


@compiled
def measure(shape: Shape, v: int, e: int) -> tuple[float, float]:
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
def cover(
    shape: Shape, v: int, edge: Ints, low: int, high: int, s: Floats, gap: Floats, rules: Rules
) -> None:
    """Enter the flush covers of both edges at a vertex."""
    cosine = math.sqrt(1.0 - rules.sine * rules.sine)
    best_own = best_before = 0.0
    for k in range(low, high):
        e = edge[k]
        if shape.link[e, BODY] == shape.link[v, BODY]:
            continue
        flush = rules.flush * thinner(shape, v, e) + rules.rounding
        length = shape.real[e, LENGTH]
        if abs(gap[k]) > flush or s[k] < -flush or s[k] > length + flush:
            continue
        p, back = shape.link[v, PREVIOUS], length - s[k]
        if s[k] > max(best_own, flush) and dot(shape, v, e) <= -cosine:
            shape.link[v, OWN], best_own = e, s[k]
        if back > max(best_before, flush) and dot(shape, p, e) <= -cosine:
            shape.link[v, BEFORE], best_before = e, back


@compiled
def dot(shape: Shape, one: int, other: int) -> float:
    """Cosine between the directions of two edges."""
    ax, ay = shape.real[one, TX], shape.real[one, TY]
    return float(ax * shape.real[other, TX] + ay * shape.real[other, TY])
