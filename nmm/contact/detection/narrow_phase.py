"""Narrow phase: which candidate pairs are contacts, with gap, normal and identity.

Bodies meet where a vertex of one stands before an edge of the other (Shi 1988). The rules:

Entrance
    A vertex meets an edge only if both of its own edges leave the edge's solid, to first order and
    within `ANGLE`. A reentrant vertex meets nothing.
Least penetration
    Where several edges of a convex part of one body, or the four edges at two near vertices, could
    be entered, the line of the largest signed distance is the contact; the line of the last step
    stays as long as it is not worse by more than `FLUSH`. With ``motion`` the distance is the
    smallest over the step, so that a body passing along a surface is not held by the end of it.
One contact a pair of vertices
    Parallel edges make two contacts, at the two ends of their overlap; as the overlap shrinks
    below `FLUSH` the two become one.
Flush neighbours
    A stretch of edge that a third body covers up to the edge's end is no entrance, as far as the
    two are closed to within `FLUSH`, and a vertex whose sides are covered is seen together with the
    coverers as long as their union is convex. So the vertices inside a floor of several blocks
    catch nothing, and a wedge between faces that open meets both. A vertex in a kink meets the
    edge that is covered there too: whatever covers it may give way.
Kinks of two bodies
    Slope and flat that are flush side by side bound what stands in their kink as one body does: it
    is merged with neither, meets both, and slides over their corners, which are reentrant together.
    Wedge and slope make one with the flat, too. The body passes the other that weight drives faster
    along the slope's sides, or its motion where weight drives neither; else the deeper kink stands.

What these rules overlook is found afterwards: a step that lets a vertex through an edge is solved
again with that pair (`with_pairs`), and what still overlaps as it appears stores no energy
(`nmm.contact.points.continued.reference_gap`).

`ANGLE`, `DEPTH` and `FLUSH` stand in `tolerances`; the last two are fractions of the thickness
(twice the area over the perimeter) of the thinner of the two bodies.
"""

from __future__ import annotations

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.contact.detection.contacts import (
    NO_CONTACTS,
    VERTEX_EDGE,
    VERTEX_VERTEX,
    Contacts,
    joined,
)
from nmm.contact.detection.measures import flush_distance, measure, rules_of
from nmm.contact.detection.surface import Surface, pair_key
from nmm.contact.detection.tolerances import Rules


def find_contacts(
    surface: Surface,
    vertex: Ints,
    edge: Ints,
    reach: float,
    last: Contacts | None = None,
    motion: Floats | None = None,
) -> Contacts:
    """Contacts among candidate pairs.

    Parameters
    ----------
    surface
        The edges where they are now.
    vertex, edge
        (m,) candidates, complete up to the reach, as `NeighbourList` gives them for a skin
        of twice the reach or more.
    reach
        Largest gap of a contact (m): how far two points can approach each other in a step.
    last
        Contacts of the last step, preferred where two lines are equally good.
    motion
        (n, 2) what each vertex is expected to move in the step (m); chooses among the lines of
        pairs that are still open.
    """
    if not len(vertex):
        return NO_CONTACTS
    rules = rules_of(surface, reach)
    # Compiled code is loaded by the first search, not by whoever names this module.
    from nmm.contact.detection.narrow.selection import find

    known = np.empty(0, np.int64) if last is None else last.key
    ahead = np.empty((0, 2)) if motion is None else np.ascontiguousarray(motion)
    return Contacts(*find(surface, vertex, edge, known, ahead, rules))


def with_pairs(surface: Surface, found: Contacts, vertex: Ints, edge: Ints) -> Contacts:
    """Return contacts with other pairs of a vertex and an edge beside them, in order of keys."""
    key, first = np.unique(pair_key(surface, vertex, edge), return_index=True)
    new = first[~np.isin(key, found.key)]
    if not len(new):
        return found
    v, e = vertex[new], edge[new]
    along, gap = measure(surface, v, e)
    more = contacts_of(
        surface, v, e, along, gap, np.zeros(len(v), dtype=bool), rules_of(surface, 0)
    )
    return joined([found, more])


def contacts_of(
    surface: Surface, v: Ints, e: Ints, along: Floats, gap: Floats, beyond: Bools, rules: Rules
) -> Contacts:
    """Return contacts of pairs with the foot ``along`` the edge; ``beyond``: past an end of it."""
    length = surface.length[e]
    parameter = np.clip(along / length, 0.0, 1.0)
    corner = np.where(parameter > 0.5, surface.next[e], e)
    beside = np.minimum(np.abs(along), np.abs(length - along))
    near = beside <= flush_distance(surface, v, e, rules)
    return Contacts(
        vertex=v,
        edge=e,
        parameter=parameter,
        normal=surface.normal[e],
        gap=gap,
        kind=np.where(beyond | near, VERTEX_VERTEX, VERTEX_EDGE),
        key=pair_key(surface, v, e),
        body=surface.body[e],
        corner=corner,
    )
