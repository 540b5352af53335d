"""Point rules for integrands singular at a point, such as the fields at a crack tip.

About the tip a polygon is the signed sum of the triangles that the tip spans with its edges
(the fan of simplex integration), wherever the tip lies: outside parts of the triangles cancel.
On one triangle, with the edge at distance h from the tip and e the coordinate along the edge from
the foot of the tip, points are ``tip + u^2 (h n + e t)``, n and t normal to and along the
edge, with ``e = h sinh(s)``:

- r = u^2 in the radius (Duffy 1982 with a quadratic grading) turns the half powers of r of the
  Williams series into polynomials of u;
- e = h sinh(s) along the edge (Johnston and Elliott 2005) makes the distance to the tip
  ``h cosh(s)``, so that Gauss points do as well for a tip close to an edge or for a needle as for
  an equilateral triangle.

The area element is ``2 u^3 h^2 cosh(s) du ds``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from integration import gauss
from integration.arrays import Floats, Ints
from integration.plane_vectors import clockwise
from integration.polygons import Polygons
from integration.ragged import within
from integration.rules import PointRule

_LONGEST_PIECE = 1.0
_FEWEST = 12


@dataclass(frozen=True, eq=False)
class TipRule(PointRule):
    """A point rule about tips.

    Attributes
    ----------
    offsets : (Q, 2)
        points relative to the tip of their owner, free of the rounding of ``points``: what to
        evaluate singular functions with.
    """

    offsets: Floats


def apex_rule(apex: Floats, start: Floats, end: Floats, order: int) -> TipRule:
    """Points on the triangles (apex, start, end) for integrands singular at the apex.

    Parameters
    ----------
    apex, start, end : (T, 2)
        corners of the triangles; a clockwise triangle gets negative weights, a flat one no points.
    order : int
        the integrand is a sum of ``r^(m/2) g_m(angle)`` with whole ``-3 <= m <= 2 order``, such
        as a polynomial of this degree times ``1/r``. The radius is integrated exactly. For
        trigonometric ``g`` of half angles, up to degree six in the angle, the error was measured
        below 1e-13 of the integral of the modulus for triangles of any shape and orders up to 8.

    Returns
    -------
    TipRule
        ``owner`` is the triangle.
    """
    p, q, edge = start - apex, end - apex, end - start
    left, right = p[:, 0] * edge[:, 1], p[:, 1] * edge[:, 0]
    rounding = 2.0 * np.finfo(float).eps * (np.abs(left) + np.abs(right))
    solid = np.flatnonzero(np.abs(left - right) > rounding)
    p, q, edge, twice = p[solid], q[solid], edge[solid], (left - right)[solid]
    length = np.hypot(*edge.T)
    along = edge / length[:, None]
    height = twice / length
    reach = np.abs(height)
    first = np.einsum("ij,ij->i", p, along) / reach
    last = np.einsum("ij,ij->i", q, along) / reach
    span = _arcsinh_difference(first, last, length / reach)
    piece, s, ws = _pieces(np.arcsinh(first), span, max(_FEWEST, order + 4))
    foot = height[:, None] * clockwise(along)
    on_edge = foot[piece, None] + (reach[piece, None] * np.sinh(s))[..., None] * along[piece, None]
    over_edge = (height * reach)[piece, None] * np.cosh(s) * ws
    u, wu = gauss.interval(order + 2)
    offsets = (u**2)[:, None] * on_edge[:, :, None]
    points = apex[solid][piece, None, None] + offsets
    weights = over_edge[:, :, None] * (2.0 * u**3 * wu)
    owner = np.repeat(solid[piece], s.shape[1] * len(u))
    return TipRule(points.reshape(-1, 2), weights.ravel(), owner, offsets.reshape(-1, 2))


def tip_rule(polygons: Polygons, tips: npt.ArrayLike, order: int) -> TipRule:
    """Points for integrals over polygons of functions singular at a tip of each.

    The tip may lie inside, on the boundary, in a hole or outside. Points lie inside the polygon
    where it is seen whole from the tip; elsewhere some lie outside and some weights are negative,
    so that the integrand must be defined there. A polygon in which the integrand jumps across a
    ray from the tip needs a vertex where the ray leaves it, so that no triangle spans the jump. For
    a tip many diameters away the terms cancel: prefer `integration.rules.polygon_rule` there.

    Parameters
    ----------
    polygons : Polygons
        rings may turn either way.
    tips : (N, 2) or (2,)
        tip of each polygon.
    order : int
        as in `apex_rule`.
    """
    owner = polygons.polygon_of_point
    tip = np.broadcast_to(np.asarray(tips, dtype=float), (len(polygons), 2))[owner]
    start, end = polygons.points, polygons.points[polygons.next_point]
    sense = np.sign(polygons.ring_areas) * polygons.ring_signs
    rule = apex_rule(tip, start, end, order)
    weights = rule.weights * sense[polygons.ring_of_point][rule.owner]
    return TipRule(rule.points, weights, owner[rule.owner], rule.offsets)


def _arcsinh_difference(a: Floats, b: Floats, b_less_a: Floats) -> Floats:
    """arcsinh(b) - arcsinh(a) without cancellation when a and b are large and close."""
    one, two = b * np.sqrt(1.0 + a * a), a * np.sqrt(1.0 + b * b)
    with np.errstate(invalid="ignore", divide="ignore"):
        ratio = b_less_a * (b + a) / (one + two)
    return np.asarray(np.arcsinh(np.where(a * b > 0.0, ratio, one - two)))


def _pieces(first: Floats, length: Floats, number: int) -> tuple[Ints, Floats, Floats]:
    """Gauss points (M, number) from ``first`` on, in pieces short enough for the rule.

    The integrand is analytic up to a distance pi/2 from the real line, hence the error of a piece
    of length 1 falls by a factor of about forty with each point.
    """
    counts = np.maximum(np.ceil(length / _LONGEST_PIECE), 1).astype(np.int64)
    interval = np.repeat(np.arange(len(counts)), counts)
    width = (length / counts)[interval]
    nodes, weights = gauss.interval(number)
    s = (first[interval] + within(counts) * width)[:, None] + width[:, None] * nodes
    return interval, s, width[:, None] * weights
