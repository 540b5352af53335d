"""Supports: points, edges or blocks held, or driven along a given displacement, by stiff springs.

The spring is Shi's fixed point (1988): ``p`` times the distance from where the point should be, in
the held directions alone. Its force is read from the whole distance, so nothing drifts over steps.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Self

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Bools, Floats, Ints
from nmm.assembly.motion import State
from nmm.assembly.places import Place, at_point, on_block, on_segment
from nmm.effects.base import Effect, Instant, Setup, factor_of
from nmm.errors import GeometryError

if TYPE_CHECKING:
    from nmm.scene.actions import Support as SceneSupport

# (x, y) in which a support may hold a point.
AXES = np.eye(2)

# Spring of a support in Young's moduli times thickness: Shi's 10 to 1000, at the stiff end.
STIFFNESS = 1000.0


@dataclass(frozen=True)
class Support:
    """One support.

    Attributes
    ----------
    name
        As the scene calls it.
    place
        The points held.
    stiffness
        (m,) of the spring at each point (N/m).
    held
        (2,) whether x and y are held.
    displacement
        From the instant to the prescribed displacement (2,) in m.
    """

    name: str
    place: Place
    stiffness: Floats
    held: Bools
    displacement: Callable[[Instant], Floats]


class Supports(Effect):
    """All supports of a scene."""

    name = "supports"

    def __init__(self, supports: list[Support], n_unknowns: int, state: State) -> None:
        self._supports = supports
        self._n = n_unknowns
        self._stood: tuple[Floats, csc_array] | None = None
        self._anchors = [
            support.place.points.place(state.frames, state.deformation) for support in supports
        ]

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from the ``[[supports]]``."""
        found = [_support(setup, support) for support in setup.scene.supports]
        return cls(found, setup.model.manifold.n_unknowns, setup.start)

    def matrix(self, state: State) -> csc_array:
        """Return the springs' stiffness, the same object as long as no held body turns."""
        angle = np.concatenate([state.frames.angle[body] for body in self._turning])
        if self._stood is None or not np.array_equal(self._stood[0], angle):
            parts = [_stiffness(support, state) for support in self._supports]
            row, column, value = (np.concatenate(part) for part in zip(*parts, strict=True))
            total = csc_array((value, (row, column)), shape=(self._n, self._n))
            self._stood = angle, total
        return self._stood[1]

    def force(self, state: State, end: Instant) -> Floats:
        """Return the springs' pull at the start of the step towards the places at its end."""
        total = np.zeros(self._n)
        for number, support in enumerate(self._supports):
            points = support.place.points
            pull = support.stiffness[:, None] * support.held * self._lag(number, state, end)
            local = points.along(state.frames, pull)
            total += np.bincount(points.rows.unknowns.ravel(), local.ravel(), minlength=self._n)
        return total

    def energy(self, state: State) -> float:
        """Energy of the springs as they stand in ``state``, with places of its own instant."""
        now = Instant(state.time, state.load_factor)
        return 0.5 * sum(
            float(np.sum(s.stiffness[:, None] * s.held * self._lag(i, state, now) ** 2))
            for i, s in enumerate(self._supports)
        )

    def reactions(self, state: State) -> dict[str, Floats]:
        """Return the force (2,) in N that each support exerts on the bodies."""
        now = Instant(state.time, state.load_factor)
        return {
            s.name: np.sum(s.stiffness[:, None] * s.held * self._lag(i, state, now), axis=0)
            for i, s in enumerate(self._supports)
        }

    def _lag(self, number: int, state: State, end: Instant) -> Floats:
        support = self._supports[number]
        place = support.place.points.place(state.frames, state.deformation)
        return self._anchors[number] + support.displacement(end) - place

    @cached_property
    def _turning(self) -> list[Ints]:
        """Bodies whose rotation changes the stiffness: springs alike in x and y do not turn."""
        none = [np.zeros(0, dtype=np.int64)]
        return none + [np.unique(s.place.points.body) for s in self._supports if not s.held.all()]


def _stiffness(support: Support, state: State) -> tuple[Ints, Ints, Floats]:
    """Rows, columns and values of a support's stiffness."""
    points = support.place.points
    unknowns = points.rows.unknowns
    m, size = unknowns.shape
    total = np.zeros((m, size, size))
    if support.held.all():
        values = points.rows.values
        total = np.einsum("mca,m,mcb->mab", values, support.stiffness, values)
    else:
        for axis in np.flatnonzero(support.held).tolist():
            rows = points.along(state.frames, np.tile(AXES[axis], (m, 1)))
            total += np.einsum("ma,m,mb->mab", rows, support.stiffness, rows)
    row = np.repeat(unknowns[:, :, None], size, axis=2)
    return row.ravel(), np.swapaxes(row, 1, 2).ravel(), total.ravel()


def _support(setup: Setup, support: "SceneSupport") -> Support:
    manifold, regions = setup.model.manifold, setup.regions(support.block)
    if support.point is not None:
        place = at_point(manifold, np.array(support.point), regions)
    elif support.segment is not None:
        place = on_segment(manifold, np.array(support.segment), regions)
    else:
        assert regions is not None or support.block == "all"
        everything = np.ones(len(setup.region_name), dtype=bool)
        place = on_block(manifold, everything if regions is None else regions)
    if not len(place):
        raise GeometryError(
            f"support {support.name}: {support.point or support.segment or support.block}: "
            "expected a place on the material: move it onto a block or onto the edge of one"
        )
    share = place.weight / place.weight.sum()
    spring = STIFFNESS * setup.model.modulus[place.elements] * setup.model.thickness * share
    to = np.array(support.displacement)
    return Support(
        name=support.name,
        place=place,
        stiffness=spring * (len(place) if support.point is None else 1),
        held=np.array(["x" in support.fix, "y" in support.fix]),
        displacement=lambda end: to * factor_of(support.history, end.time),
    )
