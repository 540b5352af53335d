"""A vertex beside an edge, and two edges beside each other."""

import math

from nmm.compiled import compiled
from nmm.contact.detection.narrow.tables import EdgesOfVertex, Shape
from nmm.contact.detection.tolerances import Rules


@compiled
def thinner(shape: Shape, one: int, other: int) -> float:
    """Thickness (m) of the thinner of the bodies of two edges."""
    return float(min(shape[one].thick, shape[other].thick))


@compiled
def measure(shape: Shape, v: int, e: int) -> tuple[float, float]:
    """Foot along the edge and signed distance of its line, both from the nearer end."""
    tx, ty = shape[e].tx, shape[e].ty
    px, py = shape[v].sx, shape[v].sy
    dx, dy = px - shape[e].sx, py - shape[e].sy
    s = dx * tx + dy * ty
    if s <= 0.5 * shape[e].length:
        return s, -(tx * dy - ty * dx)
    dx, dy = px - shape[e].ex, py - shape[e].ey
    return dx * tx + dy * ty + shape[e].length, -(tx * dy - ty * dx)


@compiled
def cover(shape: Shape, v: int, before: EdgesOfVertex, rules: Rules) -> None:
    """Enter the flush covers of both edges at a vertex."""
    edge, low, high, s, gap = before
    cosine = math.sqrt(1.0 - rules.sine * rules.sine)
    best_own = best_before = 0.0
    for k in range(low, high):
        e = edge[k]
        if shape[e].body == shape[v].body:
            continue
        flush = rules.flush * thinner(shape, v, e) + rules.rounding
        length = shape[e].length
        if abs(gap[k]) > flush or s[k] < -flush or s[k] > length + flush:
            continue
        p, back = shape[v].previous, length - s[k]
        if s[k] > max(best_own, flush) and dot(shape, v, e) <= -cosine:
            shape[v].own, best_own = e, s[k]
        if back > max(best_before, flush) and dot(shape, p, e) <= -cosine:
            shape[v].before, best_before = e, back


@compiled
def dot(shape: Shape, one: int, other: int) -> float:
    """Cosine between the directions of two edges."""
    ax, ay = shape[one].tx, shape[one].ty
    return float(ax * shape[other].tx + ay * shape[other].ty)
