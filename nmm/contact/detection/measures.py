"""Measures of a vertex and an edge, and the rules of the narrow phase in the units of a surface."""

from __future__ import annotations

import numpy as np

from integration.arrays import Floats, Ints
from integration.plane_vectors import cross, dot
from nmm.contact.detection.surface import Surface
from nmm.contact.detection.tolerances import ANGLE, DEPTH, EDGE_END, FLUSH, RANKED, Rules

SHIFTED = float(8.0 * np.finfo(float).eps)
"""Rounding of coordinates that have been turned and shifted once, as a share of the largest."""
SINE = float(np.sin(ANGLE))


def rules_of(surface: Surface, reach: float) -> Rules:
    """Rules for the coordinates of a surface."""
    rounding = float(SHIFTED * np.abs(surface.start).max(initial=0.0))
    return Rules(reach, RANKED * reach + rounding, rounding, DEPTH, FLUSH, SINE, EDGE_END)


def measure(surface: Surface, v: Ints, e: Ints) -> tuple[Floats, Floats]:
    """Foot along the edge and signed distance of its line, both from the nearer end."""
    p, t, length = surface.start[v], surface.direction[e], surface.length[e]
    from_start, from_end = p - surface.start[e], p - surface.end[e]
    first = dot(from_start, t) <= 0.5 * length
    offset = np.where(first[:, None], from_start, from_end)
    return dot(offset, t) + np.where(first, 0.0, length), -cross(t, offset)


def thinner(surface: Surface, one: Ints, other: Ints) -> Floats:
    """Thickness (m) of the thinner of two bodies, each given by an edge."""
    return np.minimum(surface.thickness[one], surface.thickness[other])


def flush_distance(surface: Surface, one: Ints, other: Ints, rules: Rules) -> Floats:
    """Distance (m) below which the edges of two bodies count as flush."""
    return np.asarray(rules.flush * thinner(surface, one, other) + rules.rounding)
