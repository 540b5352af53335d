"""Supports: points, edges or blocks tied to the ground, or driven along with it."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Self

import numpy as np

from integration.arrays import Floats
from integration.contraction import summed
from nmm.assembly.applied_forces import AppliedForces, joined
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.assembly.stress_points import StressAt
from nmm.constraints.chosen_method import support_method
from nmm.constraints.declared_supports import declared, lets_turn, sudden_starts
from nmm.constraints.driven_bodies import DrivenBodies, driven
from nmm.constraints.followed_supports import exerted, followed, with_those_gone
from nmm.constraints.imposed_supports import imposed
from nmm.constraints.imposition import Imposition
from nmm.constraints.nitsche.volume_lift import sharing
from nmm.constraints.ties.tied_interfaces import TiedInterfaces
from nmm.constraints.turned_axes import turning
from nmm.effects.base import Instant, Setup
from nmm.effects.motion.ground import Ground
from nmm.effects.motion.reactions import Reactions
from nmm.effects.motion.still_ground import still_ground
from nmm.frozen import MadeOnce
from nmm.geometry.tessellation.cover_types import highest_degree

if TYPE_CHECKING:
    from nmm.effects.change import Change
    from nmm.integrators.base import Integrator


class Supports(TiedInterfaces):
    """All supports of a scene."""

    name = "supports"

    def __init__(
        self,
        supports: Sequence[Imposition],
        n_unknowns: int,
        state: State,
        in_time: bool = False,
        turning: Model | None = None,
        model: Model | None = None,
        caution: str = "",
    ) -> None:
        held = [_anchored(one, state) for one in _sharing(supports)]
        super().__init__(held, n_unknowns, turning)
        self._in_time, self._whole, self._caution = in_time, model, caution
        grounds = [tie.interface.displacement for tie in self.ties]
        self._grounds = [ground for ground in grounds if isinstance(ground, Ground)]
        self.jumps.still = in_time and self.steady and len(self._grounds) == len(grounds)

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from the ``[[supports]]``."""
        scene, cover = setup.scene, setup.formulation.cover
        size = cover.finest if setup.model.manifold.shared_covers else None
        part = setup.formulation.supports
        method = support_method(setup.model, part, size, highest_degree(cover), setup.only_strained)
        interfaces = [declared(setup, support, method) for support in scene.supports]
        found, shared = imposed(setup, interfaces, method)
        n_unknowns, in_time = setup.model.manifold.n_unknowns, scene.inertia is not None
        turns = turning(setup) if lets_turn(setup.model, interfaces) else None
        told = sudden_starts(setup, interfaces), shared, still_ground(scene)
        caution = "; ".join(filter(None, told))
        return cls(found, n_unknowns, setup.start, in_time, turns, setup.model, caution)

    @property
    def caution(self) -> str:
        """See `Effect.caution`: jumps of the ground, members that stay, shared tractions."""
        return self._caution

    def join_run(self, state: State) -> None:
        """See `Effect.join_run`: the first supports of a run hold the material as it is."""
        self.jumps.ties = followed((), self.ties, state)

    def follow(self, change: "Change") -> "Supports":
        """Return the supports of the new model; those that are new hold the material as it is.

        Springs that the change makes stiffer or softer exert what they did.
        """
        new, former = type(self).from_setup(change.setup), change.former
        held = self._each(former, Instant.of(former))
        new.jumps.ties = followed(held, new.ties, change.state)
        return new

    def left(self, change: "Change", stresses: Sequence[StressAt]) -> list[Reactions]:
        """Return, on the new model, what the supports exert that the change takes away."""
        gone = self.follow(with_those_gone(change))
        gone.receive_stresses(stresses)
        state = change.state
        return exerted(gone.ties, gone._pulls(state, Instant.of(state)), state, self.ties)

    @MadeOnce
    def steady(self) -> bool:
        """Whether the ground stands still."""
        return all(ground.still for ground in self._grounds)

    @property
    def resolves(self) -> float | None:
        return min((one.step for one in self._grounds if one.step is not None), default=None)

    def driven(self, state: State, end: Instant) -> DrivenBodies | None:
        """Return how supports carry bodies to the end of a step, see `driven_bodies.driven`.

        None as well where multipliers hold supports, in which no digit is lost.
        """
        if self._spaces:
            return None
        return driven(self.ties, self.jumps.at(state, Instant.of(state)), state, end)

    def work(self, before: State, after: State) -> float:
        """Mean reaction of each driven support times the way it is driven."""
        total = super().work(before, after)
        for _, first, last, way in self._pushed(before, after):
            total += float(np.sum((first + last) / 2 * way))
        for shared in self._spaces:
            shared.before = shared.values
        return total

    def late_work(self, before: State, after: State, rule: "Integrator") -> float:
        """Work (J) of driven supports beyond `work`, as ``rule`` has them act (`Integrator.late`).

        A multiplier, which is the force at the weighed instant of its step, is taken from there.
        """
        total = 0.0
        for number, first, last, way in self._pushed(before, after):
            late, tie = rule.late, self.ties[number]
            if tie.shared is not None and self._in_time:
                first, late = self._earlier(number, before), late + 0.5 - rule.end_weight
            total += late * float(np.sum((last - first) * way))
        return total

    def first_work(self, before: State, after: State) -> float:
        """See `Effect.first_work`.

        What is driven at the start of statics is driven there from nothing in the first step, and
        the reaction grows with it. Where loose blocks were brought to rest under the whole load
        what they stand on has gone with them: it is driven from where they stand. Half of the
        work of a stress that acts there is withdrawn as if it were driven already: it goes back.
        """
        total = self.received_stress_energy(before) / 2
        jumps = self.jumps.at(before, Instant.of(before))
        for number, start, end in self._driven(before, after):
            if jumps[number].any():
                first, last = self._ends(number, before, after)
                total += float(np.sum(last * (end - start - jumps[number]))) / 2
                total -= float(np.sum((first + last) / 2 * (end - start)))
        return total

    def reactions(self, state: State) -> dict[str, Floats]:
        """Return the force (2,) in N that each support exerts on the bodies."""
        found = self._at_points(state)
        return {tie.interface.name: summed(forces) for tie, forces in found}

    def applied_forces(self, state: State) -> AppliedForces:
        """See `Effect.applied_forces`: what supports exert within bodies and on crack faces."""
        model = self._whole
        assert model is not None
        if not any(AppliedForces.counts(model, tie.interface.first) for tie in self.ties):
            return AppliedForces.of_densities()
        found = self._at_points(state)
        return joined(AppliedForces.on(model, tie.interface.first, one) for tie, one in found)

    def _at_points(self, state: State) -> Iterator[tuple[Imposition, Floats]]:
        """Yield each support with its forces (m, 2) on the bodies at its points (N)."""
        for tie, jump in self._each(state, Instant.of(state)):
            yield tie, self._with_added(tie.point_forces(state, jump), tie, state)

    def _with_added(self, forces: Floats, tie: Imposition, state: State) -> Floats:
        """Forces (m, 2) in N with those of stresses that other effects add."""
        if not self._stresses:
            return forces
        return forces + tie.interface.held * self._added(tie, state, Instant.of(state))

    def _pushed(self, before: State, after: State) -> Iterator[tuple[int, Floats, Floats, Floats]]:
        """Number of a support, forces (m, 2) at both ends of a step, way; of those that move."""
        still = self._in_time and self.steady
        for number, start, end in () if still else self._driven(before, after):
            if (end != start).any():
                yield number, *self._ends(number, before, after), end - start

    def _driven(self, before: State, after: State) -> Iterator[tuple[int, Floats, Floats]]:
        """Number of each support and its displacements, (2,) or (m, 2), at both ends of a step."""
        start, end = Instant.of(before), Instant.of(after)
        for number, tie in enumerate(self.ties):
            driven = tie.interface.displacement
            yield number, driven(start), driven(end)

    def _ends(self, number: int, before: State, after: State) -> tuple[Floats, Floats]:
        """Forces (m, 2) in N of a support on its points at both ends of a step.

        In time a multiplier is the mean force of its step, in statics the force at its end.
        """
        tie = self.ties[number]
        jump = self.jumps.at(after, Instant.of(after))[number]
        last = self._with_added(tie.point_forces(after, jump), tie, after)
        if tie.shared is not None and self._in_time:
            return last, last
        return self._earlier(number, before), last

    def _earlier(self, number: int, before: State) -> Floats:
        """Forces (m, 2) in N of a support on its points as the step began."""
        tie, jump = self.ties[number], self.jumps.at(before, Instant.of(before))[number]
        return self._with_added(tie.earlier_forces(before, jump), tie, before)


def _anchored(tie: Imposition, state: State) -> Imposition:
    """Return a support whose ground is tied to the points where they are now."""
    return replace(tie, interface=replace(tie.interface, anchor=tie.interface.motion(state)))


def _sharing(supports: Sequence[Imposition]) -> list[Imposition]:
    """Return supports whose pressures know of one another."""
    pairs = zip(supports, sharing([s.lift for s in supports]), strict=True)
    return [s if one is None else s.with_lift(one) for s, one in pairs]
