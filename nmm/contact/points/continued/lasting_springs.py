"""Springs of face segments that push: in time they keep the stiffness they began with.

Springs of segments are as stiff as these are long, and points inside a segment move with its ends.
Both change as bodies turn and slide, with no work that pays for it. So a spring that pushes is one
of the material until it opens, and inside a face it continues nothing that was open. One that began
on a short segment grows stiffer with it, less stretched by ``sqrt(k_0 / k_1)``: it holds what it
held.
"""

from dataclasses import replace

import numpy as np

from integration.arrays import Floats, Ints
from integration.contraction import contract
from nmm.contact.detection.surface import Surface
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.points.continued.kept_energy import stretched
from nmm.contact.points.continued.predecessors import Predecessors
from nmm.frozen import with_parts


def pushing_on(
    new: ContactPoints, before: Predecessors, surface: Surface
) -> tuple[ContactPoints, Predecessors]:
    """Return new points with springs that push as they were, and what they continue."""
    old, source, lasting = before.old, before.source, before.lasting
    pushes = before.known & ((old.gap < 0) | (old.normal_force != 0))[source] & lasting
    least = np.where(pushes, old.spring_factor[source], 0.0)
    factor = np.maximum(least, new.spring_factor)
    if not np.array_equal(factor, new.spring_factor):
        new = with_parts(new, spring_factor=factor)
    within = new.parameter_a > 0
    inside = np.flatnonzero(within & pushes & before.stay(new))
    before = replace(before, number=np.where(within & ~pushes & lasting, -1, before.number))
    if not len(inside):
        return new, before
    edges = new.edge_a[inside], new.edge_b[inside]
    last = old.parameter_a[source[inside]], old.parameter_b[source[inside]]
    # Both sides go half of the way that they have slid, and the gap is across the line between.
    middle = (surface.at(edges[0], last[0]) + surface.at(edges[1], last[1])) / 2
    on_a, on_b = (_foot(surface, edge, middle) for edge in edges)
    over = (np.minimum(on_a, on_b) >= 0) & (np.maximum(on_a, on_b) <= 1)
    return _placed(new, surface, inside[over], (on_a[over], on_b[over])), before


def as_stretched(new: ContactPoints, before: Predecessors) -> ContactPoints:
    """Return points that hold what they held where they are stiffer than they were."""
    factor = before.old.spring_factor[before.source]
    stiffer = before.lasting & before.stay(new) & (new.spring_factor > factor)
    if not stiffer.any():
        return new
    return stretched(new, np.where(stiffer, np.sqrt(factor / new.spring_factor), 1.0), slip=True)


def _foot(surface: Surface, edge: Ints, place: Floats) -> Floats:
    """Parameters (m,) on edges of the points nearest to places (m, 2)."""
    along = contract("mi,mi->m", place - surface.start[edge], surface.direction[edge])
    return np.asarray(along / surface.length[edge])


def _placed(
    points: ContactPoints, surface: Surface, which: Ints, parameters: tuple[Floats, Floats]
) -> ContactPoints:
    """Return points of which some are at other parameters on both sides."""
    on_a, on_b, gap = points.parameter_a.copy(), points.parameter_b.copy(), points.gap.copy()
    on_a[which], on_b[which] = parameters
    apart = surface.at(points.edge_a[which], on_a[which])
    apart -= surface.at(points.edge_b[which], on_b[which])
    gap[which] = contract("mi,mi->m", apart, points.normal[which])
    return with_parts(points, parameter_a=on_a, parameter_b=on_b, gap=gap)
