"""Contacts that search finds: vertices before edges, some for a segment of a face."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Self, TypeVar

import numpy as np

from covers.concatenate import concatenate
from integration.arrays import Bools, Floats, Ints
from integration.plane_vectors import dot
from nmm.contact.detection.tolerances import FACING

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


@dataclass(frozen=True, eq=False)
class FaceContacts(Contacts):
    """Contacts of which some stand for a segment of a face.

    A point inside an overlap has the kind `FACE`, and ``vertex`` is the edge it lies on.

    Attributes
    ----------
    parameter_a
        (m,) place on the edge ``vertex``; 0 for a vertex.
    length
        (m,) of the stretch (m); 0 of a mere vertex.
    """

    parameter_a: Floats
    length: Floats


_NONE, _NO_NUMBER = np.empty(0, np.int64), np.empty(0)
NO_CONTACTS = Contacts(
    *(_NONE, _NONE, _NO_NUMBER, np.empty((0, 2)), _NO_NUMBER), *(_NONE, _NONE, _NONE, _NONE)
)
Some = TypeVar("Some", bound=Contacts)


def joined(parts: Sequence[Some]) -> Some:
    """Return contacts of one kind together, in order of keys."""
    together = concatenate(parts, {})
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


def _top(values: Ints) -> int:
    return int(values.max(initial=-1))
