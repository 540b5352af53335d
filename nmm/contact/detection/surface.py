"""Boundary edges of all bodies where they are now: all that contact search knows of a body."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from integration.arrays import Floats, Ints
from integration.plane_vectors import clockwise, cross


@dataclass(frozen=True, eq=False)
class Surface:
    """Closed rings of edges with the solid on the left hand of start -> end.

    Vertex ``i`` is the start of edge ``i``; edges ``previous[i]`` and ``i`` meet there.

    Attributes
    ----------
    start, end
        (n, 2) ends of each edge (m).
    body
        (n,) body of each edge.
    next, previous
        (n,) the edges that follow and precede it in its ring.
    together
        (n,) a number that bodies share which cannot move apart; None where each goes alone.
    weight
        (n, 2) the acceleration that weight gives each edge's body, 0 for bodies that supports hold
        (m/s2); None without any.
    """

    start: Floats
    end: Floats
    body: Ints
    next: Ints
    previous: Ints
    together: Ints | None = None
    weight: Floats | None = None

    @property
    def moves(self) -> Ints:
        """(n,) numbers of what moves as one: ``together``, or the bodies."""
        return self.body if self.together is None else self.together

    @property
    def falls(self) -> Floats:
        """(n, 2) the ``weight``, or zeros (m/s2)."""
        return np.zeros_like(self.start) if self.weight is None else self.weight

    def __len__(self) -> int:
        return len(self.body)

    @cached_property
    def direction(self) -> Floats:
        """(n, 2) unit vectors from start to end; zero for an edge without length."""
        length = self.length[:, None]
        return np.divide(
            self.end - self.start, length, out=np.zeros_like(self.start), where=length > 0.0
        )

    @cached_property
    def normal(self) -> Floats:
        """(n, 2) outward unit normals: the directions turned clockwise."""
        return clockwise(self.direction)

    @cached_property
    def length(self) -> Floats:
        """(n,) lengths of the edges (m)."""
        return np.asarray(np.hypot(*(self.end - self.start).T))

    @cached_property
    def thickness(self) -> Floats:
        """(n,) twice the area over the perimeter of each edge's body (m): h for a thin strip."""
        first = np.full(int(self.body.max(initial=-1)) + 1, -1)
        first[self.body[::-1]] = np.arange(len(self))[::-1]
        origin = self.start[first[self.body]]
        a, b = self.start - origin, self.end - origin
        twice = np.bincount(self.body, cross(a, b), len(first))
        around = np.bincount(self.body, self.length, len(first))
        size = np.divide(np.abs(twice), around, out=np.zeros(len(first)), where=around > 0.0)
        return np.asarray(size[self.body])

    @cached_property
    def grain(self) -> Floats:
        """(n,) half the mean edge of each edge's body (m)."""
        count = np.maximum(np.bincount(self.body), 1)
        return np.asarray((np.bincount(self.body, self.length) / (2 * count))[self.body])

    def at(self, edge: Ints, parameter: Floats) -> Floats:
        """Points (m, 2) at fractions of edges."""
        return self.start[edge] + parameter[:, None] * (self.end[edge] - self.start[edge])


def pair_key(surface: Surface, vertex: Ints, edge: Ints) -> Ints:
    """Identity (m,) of pairs of a vertex and an edge: ``vertex * n + edge``."""
    return vertex * len(surface) + edge


def unordered_key(one: Ints, other: Ints, n: int) -> Ints:
    """Identity (m,) of pairs of two edges, or two bodies, of ``n`` in all, in either order."""
    return np.minimum(one, other) * n + np.maximum(one, other)
