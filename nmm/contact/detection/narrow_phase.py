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
    catch nothing, and a wedge between faces that open meets both.

What these rules overlook is found afterwards: a step that lets a vertex through an edge is solved
again with that pair (`with_pairs`), and what still overlaps as it appears stores no energy
(`nmm.contact.points.continued.reference_gap`).

`ANGLE`, `DEPTH` and `FLUSH` stand in `tolerances`; the last two are fractions of the thickness
(twice the area over the perimeter) of the thinner of the two bodies.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Self, TypeVar

import numpy as np

from integration.arrays import Bools, Floats, Ints
from integration.plane_vectors import dot
from nmm.contact.detection.measures import flush_distance, measure, rules_of
from nmm.contact.detection.pair_keys import pair_key
from nmm.contact.detection.surface import Surface
from nmm.contact.detection.tolerances import FACING, Rules

VERTEX_EDGE = 0
VERTEX_VERTEX = 1
FACE = 2


@dataclass(frozen=True, eq=False)
class Contacts:
    """One row a contact point: a vertex (side a) before an edge of another body (side b).

    Attributes
    ----------
    vertex, edge
        (m,) indices in the surface; no pair occurs twice.
    parameter
        (m,) foot of the vertex on the edge as a fraction of it, clipped to [0, 1].
    normal
        (m, 2) outward from the edge, from side b to side a.
    gap
        (m,) signed distance of the vertex from the line of the edge (m), positive open.
    kind
        (m,) `VERTEX_EDGE` or `VERTEX_VERTEX`: at an end of the edge.
    key
        (m,) identity that stands as long as vertex and edge meet, see `pair_key`; rising.
    body
        (m,) body of the edge.
    corner
        (m,) the vertex at the nearer end of the edge.
    """

    vertex: Ints
    edge: Ints
    parameter: Floats
    normal: Floats
    gap: Floats
    kind: Ints
    key: Ints
    body: Ints
    corner: Ints

    def __len__(self) -> int:
        return len(self.vertex)

    def take(self, index: Ints | Bools) -> Self:
        """Return some of the contacts."""
        return type(self)(*(getattr(self, part.name)[index] for part in fields(self)))


_NO_PAIR, _NO_NUMBER = np.empty(0, np.int64), np.empty(0)
NO_CONTACTS = Contacts(
    vertex=_NO_PAIR,
    edge=_NO_PAIR,
    parameter=_NO_NUMBER,
    normal=np.empty((0, 2)),
    gap=_NO_NUMBER,
    kind=_NO_PAIR,
    key=_NO_PAIR,
    body=_NO_PAIR,
    corner=_NO_PAIR,
)
Some = TypeVar("Some", bound=Contacts)


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
    new = ~np.isin(pair_key(surface, vertex, edge), found.key)
    if not new.any():
        return found
    v, e = vertex[new], edge[new]
    along, gap = measure(surface, v, e)
    more = contacts_of(
        surface, v, e, along, gap, np.zeros(len(v), dtype=bool), rules_of(surface, 0)
    )
    return joined([found, more])


def joined(parts: Sequence[Some]) -> Some:
    """Return contacts of one kind together, in order of keys."""
    names = [part.name for part in fields(parts[0])]
    columns = ([getattr(part, name) for part in parts] for name in names)
    together = type(parts[0])(*(np.concatenate(column) for column in columns))
    return together.take(np.argsort(together.key, kind="stable"))


def follow(old: Contacts, new: Contacts) -> Ints:
    """Predecessor (m,) of each new contact among the old ones, -1 where there is none.

    The same vertex before the same edge; or else the vertex before another edge of the same body,
    having slid around its corner; or else two vertices whose roles have changed; or else the vertex
    before an edge of another body that faces the same way, having slid on to it.
    """
    if len(old) and np.array_equal(old.key, new.key) and (np.diff(new.key) > 0).all():
        return np.arange(len(new))
    found = np.full(len(new), -1, dtype=np.int64)
    if not len(old):
        return found
    span = 1 + max(_top(old.vertex), _top(new.vertex), _top(old.body), _top(new.body))
    span = max(span, 1 + max(_top(old.corner), _top(new.corner)))
    was_on, is_on = (part.vertex + span * (part.kind == FACE) for part in (old, new))
    for was, now, onward in (
        (old.key, new.key, False),
        (was_on * span + old.body, is_on * span + new.body, False),
        (old.corner * span + old.vertex, new.vertex * span + new.corner, False),
        (was_on, is_on, True),
    ):
        free = np.ones(len(old), dtype=bool)
        free[found[found >= 0]] = False
        source, target = np.flatnonzero(free), np.flatnonzero(found < 0)
        values, first = np.unique(was[source], return_index=True)
        _, once = np.unique(now[target], return_index=True)  # a predecessor has one successor
        target = target[once]
        if not len(values) or not len(target):
            break
        at = np.minimum(np.searchsorted(values, now[target]), len(values) - 1)
        hit = values[at] == now[target]
        if onward:
            hit &= dot(new.normal[target], old.normal[source[first[at]]]) >= FACING
        found[target[hit]] = source[first[at[hit]]]
    return found


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


def _top(values: Ints) -> int:
    return int(values.max(initial=-1))
