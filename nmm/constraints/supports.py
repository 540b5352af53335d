"""Supports: points, edges or blocks held, or driven along a given displacement.

Whatever the method, the force is read from the whole distance to where points should be, so that
nothing drifts over steps.
"""

from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, Self

import numpy as np
from scipy.sparse import csc_array, csr_array

from integration.arrays import Floats, Ints
from nmm.assembly.motion import State
from nmm.assembly.places import Place, at_point, on_block, on_segment
from nmm.constraints.edge_supports import Method, method_of
from nmm.constraints.linear_matter import method_for
from nmm.constraints.support_methods import (
    Multipliers,
    Nitsche,
    Springs,
    Support,
    Tractions,
    share_multipliers,
)
from nmm.constraints.volume_lift import sharing
from nmm.effects.base import Effect, Instant, Setup
from nmm.effects.load_factor import displacement_factor
from nmm.errors import GeometryError

if TYPE_CHECKING:
    from nmm.effects.change import Change
    from nmm.scene.actions import SupportTable as SceneSupport

# Spring of a support in Young's moduli times thickness: Shi's 10 to 1000, at the stiff end.
STIFFNESS = 1000.0

# Multipliers (k,) of each space as found last and as the step began (Pa).
LastMultipliers = tuple[tuple[Floats | None, Floats | None], ...]


class Supports(Effect):
    """All supports of a scene."""

    name = "supports"

    def __init__(
        self,
        supports: list[Support],
        n_unknowns: int,
        state: State,
        in_time: bool = False,
        still: bool = True,
    ) -> None:
        self._supports = _sharing(supports)
        self._n = n_unknowns
        self._in_time, self._still = in_time, still
        self._stood: tuple[Floats, csc_array] | None = None
        self._known: list[tuple[State, list[Floats]]] = []
        self._anchors = [
            support.place.points.moved(state.frames, state.deformation) for support in supports
        ]

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from the ``[[supports]]``."""
        found = [_support(setup, support) for support in setup.scene.supports]
        method = _method(setup)
        if method.size is not None:
            found = share_multipliers(setup.model, found, method.size)
        scene = setup.scene
        still = all(one.history is None or not any(one.displacement) for one in scene.supports)
        n_unknowns = setup.model.manifold.n_unknowns
        return cls(found, n_unknowns, setup.start, scene.inertia is not None, still)

    def follow(self, change: "Change") -> "Supports":
        """Return the supports of the new model; those that are new hold the material as it is."""
        new, state = type(self).from_setup(change.setup), change.state
        known = {support.name: number for number, support in enumerate(self._supports)}
        for number, support in enumerate(new._supports):
            if support.name in known:
                before = known[support.name]
                held = self._supports[before].place.position, self._anchors[before]
                new._anchors[number] = _nearest(support.place.position, *held)
            else:
                points = support.place.points
                new._anchors[number] = points.moved(state.frames, state.deformation)
        return new

    @property
    def about(self) -> str:
        """See `Effect.about`."""
        kinds = {Springs: "springs", Nitsche: "Nitsche's method"}
        said = [
            f"{word} at {sum(len(s.place) for s in self._supports if isinstance(s, kind))} points"
            for kind, word in kinds.items()
            if any(isinstance(s, kind) for s in self._supports)
        ]
        if self.multipliers:
            said.append(f"{self.multipliers} Lagrange multipliers")
        return ", ".join(said)

    def matrix(self, state: State) -> csc_array:
        """Return the supports' stiffness, the same object as long as no held body turns."""
        angle = np.concatenate([state.frames.angle[body] for body in self._turning])
        if self._stood is None or not np.array_equal(self._stood[0], angle):
            parts = [support.stiffness(state) for support in self._supports]
            row, column, value = (np.concatenate(part) for part in zip(*parts, strict=True))
            total = csc_array((value, (row, column)), shape=(self._n, self._n))
            self._stood = angle, total
        return self._stood[1]

    def force(self, state: State, end: Instant) -> Floats:
        """Return the pull at the start of the step towards the places at its end."""
        total = np.zeros(self._n)
        for number, support in enumerate(self._supports):
            total += support.pull(state, self._lag(number, state, end), self._n)
        return total

    def border(self, state: State, end: Instant) -> tuple[csr_array, Floats] | None:
        """Conditions ``rows @ d = sides`` on the step's unknowns; None without multipliers."""
        from scipy.sparse import vstack

        spaces: dict[int, list[tuple[csr_array, Floats]]] = {}
        for number, support in enumerate(self._supports):
            if isinstance(support, Multipliers):
                own = support.border(state, self._lag(number, state, end), self._n)
                spaces.setdefault(id(support.shared), []).append(own)
        if not spaces:
            return None
        rows = [sum((row for row, _ in parts[1:]), parts[0][0]) for parts in spaces.values()]
        sides = [sum((side for _, side in parts[1:]), parts[0][1]) for parts in spaces.values()]
        return csr_array(vstack(rows)), np.concatenate(sides)

    @property
    def multipliers(self) -> int:
        """Number of conditions that multipliers hold."""
        return sum(shared.size for shared in self._spaces)

    @property
    def _spaces(self) -> list[Tractions]:
        """Multipliers, those that supports share once."""
        found = {id(s.shared): s.shared for s in self._supports if isinstance(s, Multipliers)}
        return list(found.values())

    def keep(self, multipliers: Floats) -> Floats:
        """Remember the multipliers of the last solution, for reactions; return the others."""
        for shared in self._spaces:
            shared.values, multipliers = multipliers[: shared.size], multipliers[shared.size :]
        return multipliers

    def carried(self) -> LastMultipliers:
        """See `Effect.carried`: the last multipliers, and those before, of each space."""
        return tuple((shared.values, shared.before) for shared in self._spaces)

    def carry(self, carried: LastMultipliers) -> None:
        """See `Effect.carry`."""
        for shared, (values, before) in zip(self._spaces, carried, strict=True):
            shared.values, shared.before = values, before

    def forget(self) -> None:
        """See `Effect.forget`."""
        self._stood, self._known = None, []

    def energy(self, state: State) -> float:
        """Energy of the springs as they stand in ``state``, with places of its own instant."""
        now = Instant(state.time, state.load_factor)
        return sum(s.energy(state, self._lag(i, state, now)) for i, s in enumerate(self._supports))

    @property
    def steady(self) -> bool:
        """See `Effect.steady`."""
        return self._still

    def work(self, before: State, after: State) -> float:
        """Mean reaction of each driven support times the way it is driven."""
        start, end = (Instant(one.time, one.load_factor) for one in (before, after))
        total = 0.0
        for i, support in enumerate(self._supports):
            way = np.asarray(support.displacement(end) - support.displacement(start))
            if way.any():
                last = support.reaction(after, self._lag(i, after, end))
                first = self._first(support, i, before, last)
                total += float((first + last) / 2 @ np.atleast_2d(way).mean(axis=0))
        for shared in self._spaces:
            shared.before = shared.values
        return total

    def first_work(self, before: State, after: State) -> float:
        """Work (J) that `work` lacks in the first step of statics; to be asked ahead of it.

        What is driven at the start of statics is driven there from nothing in the first step, and
        the reaction grows with it.
        """
        start, end = (Instant(one.time, one.load_factor) for one in (before, after))
        total = 0.0
        for i, support in enumerate(self._supports):
            stood = np.atleast_2d(support.displacement(start)).mean(axis=0)
            if stood.any():
                way = np.atleast_2d(support.displacement(end)).mean(axis=0)
                last = support.reaction(after, self._lag(i, after, end))
                total += float(last @ way) / 2
                first = self._first(support, i, before, last)
                total -= float((first + last) / 2 @ (way - stood))
        return total

    def _first(self, support: Support, number: int, before: State, last: Floats) -> Floats:
        """Return the reaction (2,) in N as the step began.

        In time a multiplier is the mean force of its step, in statics the force at its end.
        """
        if isinstance(support, Multipliers):
            return last if self._in_time else support.earlier()
        start = Instant(before.time, before.load_factor)
        return support.reaction(before, self._lag(number, before, start))

    def reactions(self, state: State) -> dict[str, Floats]:
        """Return the force (2,) in N that each support exerts on the bodies."""
        now = Instant(state.time, state.load_factor)
        return {
            s.name: s.reaction(state, self._lag(i, state, now))
            for i, s in enumerate(self._supports)
        }

    def gap_volume(self, state: State, k: int) -> Floats:
        """See `Effect.gap_volume`."""
        now, total = Instant(state.time, state.load_factor), np.zeros(k)
        for i, support in enumerate(self._supports):
            if isinstance(support, Nitsche):
                total += support.gap_volume(state, self._lag(i, state, now), k)
        return total

    def tied_unknowns(self) -> Ints:
        """Return the unknowns in the ghost terms of Nitsche's supports."""
        none = [np.empty(0, dtype=np.int64)]
        ghosts = [s.ghost for s in self._supports if isinstance(s, Nitsche)]
        return np.unique(np.concatenate(none + [ghost.nonzero()[0] for ghost in ghosts]))

    def _lag(self, number: int, state: State, end: Instant) -> Floats:
        now = self._anchors[number] + self._supports[number].displacement(end)
        return np.asarray(now - self._ways(state)[number])

    def _ways(self, state: State) -> list[Floats]:
        """How far the points of each support have come; those at both ends of a step are kept."""
        for known, places in self._known:
            if known is state:
                return places
        points = (support.place.points for support in self._supports)
        places = [one.moved(state.frames, state.deformation) for one in points]
        self._known = [*self._known[-1:], (state, places)]
        return places

    @cached_property
    def _turning(self) -> list[Ints]:
        """Bodies whose rotation changes the stiffness: springs alike in x and y do not turn."""
        none = [np.zeros(0, dtype=np.int64)]
        return none + [np.unique(s.place.points.body) for s in self._supports if s.turns]


def _nearest(points: Floats, known: Floats, values: Floats) -> Floats:
    """Values (m, 2) of the nearest of ``known`` points for each of ``points``."""
    from scipy.spatial import KDTree

    return np.asarray(values[KDTree(known).query(points)[1]])


def _sharing(supports: list[Support]) -> list[Support]:
    """Return supports whose pressures know of one another."""
    lifts = sharing([s.lift if isinstance(s, Nitsche) else None for s in supports])
    pairs = zip(supports, lifts, strict=True)
    return [replace(s, lift=own) if isinstance(s, Nitsche) and own else s for s, own in pairs]


def _method(setup: Setup) -> Method:
    cover = setup.formulation.cover
    mesh = not cover.of_blocks
    asked = setup.formulation.supports
    if mesh:
        asked = asked.model_copy(
            update={"method": method_for(setup.model, asked.method, "penalty")}
        )
    return method_of(asked, cover.finest, cover.highest_degree, mesh)


def _support(setup: Setup, support: "SceneSupport") -> Support:
    method = _method(setup)
    mesh = not setup.formulation.cover.of_blocks
    place = _place(setup, support, method.order(setup.model) if mesh else 4)
    to = np.array(support.displacement)
    held = ("x" in support.fix, "y" in support.fix)
    factor = displacement_factor(setup, support)

    def displacement(end: Instant) -> Floats:
        return to * factor(end)

    if mesh and support.point is None:
        return method.hold(setup.model, place, displacement, held, support.name)
    share = place.weight / place.weight.sum()
    spring = STIFFNESS * setup.model.modulus[place.elements] * setup.model.thickness * share
    spring = spring * (len(place) if support.point is None else 1)
    return Springs(support.name, place, np.array(held), displacement, spring)


def _place(setup: Setup, support: "SceneSupport", order: int) -> Place:
    manifold, regions = setup.model.manifold, setup.regions(support.block)
    if support.point is not None:
        place = at_point(manifold, np.array(support.point), regions)
    elif support.segment is not None:
        place = on_segment(manifold, np.array(support.segment), regions, order)
    else:
        assert regions is not None or support.block == "all"
        everything = np.ones(len(setup.region_name), dtype=bool)
        place = on_block(manifold, everything if regions is None else regions, order)
    if not len(place):
        raise GeometryError(
            f"support {support.name}: {support.point or support.segment or support.block}: "
            "expected a place on the material: move it onto a block or onto the edge of one"
        )
    return place
