"""Supports at points in prestressed ground: they share the traction on an edge between them.

Between two held points of a straight edge each has what a beam on both would press it with, which
does on every linear field the work of the traction along the edge.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.assembly.places import NEAR, on_segment
from nmm.assembly.tractions.donors import across
from nmm.constraints.imposition import Imposition
from nmm.constraints.laid_springs import faces_another, stretched
from nmm.effects.base import Setup
from nmm.effects.initial.stress_at_start import StressAtStart

# Degree along an edge of what is integrated: a linear stress times a linear share.
ORDER = 2


def laid_at_points(setup: Setup, ties: Sequence[Imposition]) -> list[Imposition]:
    """Return ties whose springs at points carry their share of the initial stress at first.

    It counts in an axis that both points hold, on edges that no support holds along this axis and
    that face no other body. Of an edge beyond its last held point, or with a single one, what
    share is theirs is nobody's to say.
    """
    points = _Points.of(ties)
    if points is None:
        return list(ties)
    force = _shares(setup, points, [tie for tie in ties if tie.interface.first.normal is not None])
    found = list(ties)
    for number in np.unique(points.tie):  # a handful of supports
        tie, own = found[number], force[points.tie == number]
        if own.any() and tie.springs is not None:
            found[number] = tie.laid(stretched(tie.springs, own))
    return found


@dataclass(frozen=True)
class _Points:
    """Held points: their supports (m,), bodies (m,), positions (m, 2) and held axes (m, 2)."""

    tie: Ints
    body: Ints
    position: Floats
    held: Bools

    @classmethod
    def of(cls, ties: Sequence[Imposition]) -> "_Points | None":
        own = [
            (i, tie.interface) for i, tie in enumerate(ties) if tie.interface.first.normal is None
        ]
        if not own:
            return None
        return cls(
            np.concatenate([np.full(len(one), i) for i, one in own]),
            np.concatenate([one.first.points.body for _, one in own]),
            np.concatenate([one.first.position for _, one in own]),
            np.concatenate([np.tile(one.held, (len(one), 1)) for _, one in own]),
        )

    def neighbours(self, axis: int) -> Iterator[tuple[int, int]]:
        """Yield pairs of points of one body that hold an axis, with none of these between them."""
        for body in np.unique(self.body):  # supports at points are a handful
            own = np.flatnonzero((self.body == body) & self.held[:, axis])
            own = own[np.unique(self.position[own], axis=0, return_index=True)[1]]
            apart = self.position[own][:, None] - self.position[own]
            distance = np.hypot(*np.moveaxis(apart, -1, 0))
            for i, j in combinations(range(len(own)), 2):
                around = distance[i] + distance[j]
                if np.count_nonzero(around <= (1 + NEAR) * distance[i, j]) == 2:
                    yield own[i], own[j]


def _shares(setup: Setup, points: _Points, along: Sequence[Imposition]) -> Floats:
    """Forces (m, 2) in N that the stress exerts on points, beside supports ``along`` edges."""
    model, found = setup.model, np.zeros((len(points.tie), 2))
    stress = StressAtStart.declared(setup).within(model)
    for axis in (0, 1):
        held = [tie.interface.first.edge for tie in along if tie.interface.held[axis]]
        edges = np.concatenate([np.zeros(0, dtype=np.int64), *(e for e in held if e is not None)])
        for i, j in points.neighbours(axis):
            start, end = points.position[i], points.position[j]
            place = on_segment(model.manifold, np.stack([start, end]), order=ORDER)
            own, length = place.points.body == points.body[i], np.hypot(*(end - start))
            if not np.isclose(place.weight[own].sum(), length, rtol=NEAR):
                continue
            assert place.normal is not None
            assert place.edge is not None
            own &= ~faces_another(setup, place) & ~np.isin(place.edge, edges)
            traction = across(stress(place.elements, place.position), place.normal)[:, axis]
            force = np.where(own, model.thickness * place.weight * traction, 0.0)
            share = np.hypot(*(place.position - start).T) / length
            found[i, axis] += force @ (1 - share)
            found[j, axis] += force @ share
    return found
