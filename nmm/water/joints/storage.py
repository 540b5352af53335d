"""The effect: transient flow in joints, with storage by their opening and by compressible water.

With the force ``C`` of unit pressures on the blocks, whose transpose gives the volume that their
motion ``d`` opens, the balance of a step (`nmm.water.joints.balance`) is

    M (h1 - h0) + dt G h1 = - (V - V0) - C^T d.

The force ``w C h1`` on the blocks is linear in ``d``; so the matrix ``w C (M + dt G)^-1 C^T`` is
added to the stiffness, heads and motion are found together, and steps are stable however stiff the
water is. Where a node loses or gains its pressure in a step the force is no longer linear, and the
step is solved by Newton's method.
"""

from collections.abc import Mapping
from functools import cached_property
from typing import Any, Self

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.assembly.kept import kept, kept_of_place
from nmm.assembly.state import State
from nmm.diffusion.problem import step_between
from nmm.effects.base import Instant, Setup, Span, StepForce
from nmm.effects.change import Change
from nmm.water.full_matrix import full_matrix, refuse_full
from nmm.water.joints.balance import JointBalance, OpenJoints
from nmm.water.joints.joint_water import JointWater
from nmm.water.joints.stored_water import SolvedWater, WaterStored


class JointStorage(JointWater):
    """Transient flow in the joints of a scene."""

    name = "transient joint flow"
    _began: WaterStored
    _end: WaterStored
    _balance: JointBalance
    _start: OpenJoints | None = None
    _last: SolvedWater | None = None
    _second, _time = 1.0, 0.0

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from ``[joint_flow]`` with ``transient = true``."""
        table = setup.scene.joint_flow
        assert table is not None
        assert table.initial is not None
        place = setup.scene.source.place("joint_flow", "transient")
        refuse_full(setup, place, "take fewer blocks, or steady flow")
        found = super().from_setup(setup)
        level, thick = found.sites.places[:, 1], setup.model.thickness
        squeeze = found.weight / table.bulk_modulus
        found._balance = JointBalance(found.network, level, found._initial, thick, squeeze)
        found._second = 1.0 if table.duration is None else table.duration
        head = np.full(found.network.n, table.initial - setup.origin[1])
        begin = setup.start.time * found._second
        found._began = WaterStored(begin, head, found._open(setup.start).volume)
        found._end = found._began
        return found

    @property
    def steady(self) -> bool:
        """See `Effect.steady`: the pressure at the end of a step depends on its duration."""
        return False

    def heads(self, state: State, time: float) -> Floats:
        """Heads (n,) of an accepted state."""
        time = time * self._second
        if time == self._began.time:
            return self._began.head
        return self._end.head if time == self._end.time else self._water(state, time).head

    def force(self, state: State, end: Instant) -> Floats:
        """Return the force (n_unknowns,) of the pressure at the end of a step without motion."""
        if end.time > state.time and state.time * self._second == self._end.time:
            self._began = self._end
        time = end.time * self._second
        if time == self._began.time:  # the force at the start of the step, whose duration stays
            return super().force(state, end)
        self._time, self._start = time, self._open(state)
        return self._push(state, self._pressure(self._water(state, time).head))

    def matrix(self, state: State) -> csc_array:
        """Return minus the derivative of the pressure's force by the motion (n, n)."""
        return self._relief(state, self._water(state, self._time))

    @property
    def symmetric(self) -> bool:
        """See `Effect.symmetric`: not where pressures that fall give way sooner."""
        return False

    def step_force(self, before: State, after: State, span: Span) -> StepForce:
        """See `Effect.step_force`: pressures of the motion at the end, nowhere below zero.

        What motion takes from a pressure it takes from that of the start as well, so that a joint
        that opens gets no more work than it gave as it closed.
        """
        volume, time = self._balance.volumes(super().apertures(after)), after.time * self._second
        end = self._solved(self._open(before), volume, time)
        last, still = (self._pressure(one.head) for one in (end, self._water(before, time)))
        fallen = np.maximum(still - last, 0.0)
        first = np.maximum(self._pressure(self._began.head) - fallen, 0.0)
        weight, both = span.weight, (fallen > 0) & (first > 0)
        force = self._push(before, weight * last + (1 - weight) * first)

        def stiffness() -> csc_array:
            return self._relief(before, end, np.where(both, 1.0, weight))

        return StepForce(force, stiffness)

    def accepted(self, state: State) -> None:
        """See `Effect.accepted`: the heads that acted at the end of the step."""
        time = state.time * self._second
        if time > self._began.time:
            self._end = self._water(state, time)

    def history(self, state: State) -> Mapping[str, float]:
        """Return the largest pressure (Pa) and aperture (m), inflows and what is stored (m3)."""
        pressure = float(self.pressures(state, state.time).max())
        taken = {f"taken:{name}": amount for name, amount in self._end.taken.items()}
        largest = {"pressure": pressure, "aperture": float(self.apertures(state).max())}
        return {**taken, "stored": self._end.stored, **largest}

    def carried(self) -> Any:
        ends = self._began, self._end
        return tuple((one.time, one.head, one.volume, dict(one.taken), one.stored) for one in ends)

    def carry(self, carried: Any) -> None:
        self._began, self._end = (WaterStored(*one) for one in carried)
        self.forget()

    def apertures(self, state: State) -> Floats:
        return self._open(state).aperture

    def forget(self) -> None:
        super().forget()
        self._last = None

    def follow(self, change: Change) -> "JointStorage":
        """Return the water on the new model, with the heads of nodes that it shares."""
        from scipy.spatial import KDTree

        new = type(self).from_setup(change.setup)
        near, nearest = KDTree(self.sites.places).query(new.sites.places)
        known = near <= 1e-9 * (1 + np.abs(self.sites.places).max())
        old = self._end
        head = np.where(known, old.head[nearest], new._began.head)
        volume = new._open(change.state).volume
        new._began = new._end = WaterStored(old.time, head, volume, old.taken, old.stored)
        return new

    def _pressure(self, head: Floats) -> Floats:
        """Pressures (n,) of heads (n,): there is no suction (Pa)."""
        return np.asarray(self.weight * np.maximum(head - self._balance.level, 0.0))

    def _push(self, state: State, pressure: Floats) -> Floats:
        """Force (n_unknowns,) of pressures (n,) on the faces of joints."""
        if not pressure.any():
            return np.zeros(self.n_unknowns)
        forces = self.sites.forces(state, pressure[self.sites.nodes])
        return self.sites.interface.spread(state, forces)

    def _relief(self, state: State, end: WaterStored, share: Floats | None = None) -> csc_array:
        """Matrix (n_unknowns, n_unknowns) of the motion on the pressure at the end of a step.

        With shares (n,) it is the derivative of so much of the pressures; without it is symmetric,
        of nodes under pressure that respond to their volumes alone.
        """
        free = self._balance.free(self.given(end.time / self._second)[0])
        wet = free & self._balance.pressed(end.head)
        if not wet.any():
            return self._nothing
        # Neither from heads nor for them does it matter how much an empty node could hold.
        moved = wet if share is None else free & ~self._balance.dry(end.head, end.volume)
        step = step_between(self._began.time, end.time)
        matrix = self._balance.matrix(self._open(state), end.head, end.volume, step)
        coupling = self._coupling(state)
        used = np.flatnonzero(np.abs(coupling[moved]).any(axis=0))
        some = np.where(moved[:, None], coupling[:, used], 0.0)
        answers = np.linalg.solve(matrix[np.ix_(free, free)], some[free])
        counts = 1.0 if share is None else share[wet, None]
        pressed = counts * coupling[np.ix_(wet, used)]
        return full_matrix(self.weight * (pressed.T @ answers[wet[free]]), used, self.n_unknowns)

    @cached_property
    def _nothing(self) -> csc_array:
        """The matrix without entries, one for all steps: sums with it are kept."""
        return csc_array((self.n_unknowns, self.n_unknowns))

    def _step_to(self, state: State, time: float) -> tuple[int, int, float]:
        """What tells the water of a step from that of another."""
        return id(state), id(self._began), time

    @kept(_step_to)
    def _water(self, state: State, time: float) -> WaterStored:
        """Return the water at a time with the volumes of a state."""
        now = self._open(state)
        return self._solved(self._start or now, now.volume, time)

    def _solved(self, joints: OpenJoints, volume: Floats, time: float) -> WaterStored:
        """Return the water at a time with volumes (n,), by the joints at the start of the step."""
        began, last = self._began, self._last
        if last is None or not last.serves(joints, began, volume, time):
            last = SolvedWater(joints, began, self._balanced(joints, began, volume, time))
            self._last = last
        return last.water

    def _balanced(
        self, joints: OpenJoints, began: WaterStored, volume: Floats, time: float
    ) -> WaterStored:
        given = self.given(time / self._second)
        step = step_between(began.time, time)
        head, inflow = self._balance.heads(joints, began.head, (began.volume, volume), given, step)
        taken = {
            one.name: began.taken.get(one.name, 0.0) + float(inflow[one.nodes].sum())
            for one in self.prescribed
        }
        first, last = (
            float((self._balance.beyond(joints, one, filled) + filled).sum())
            for one, filled in ((began.head, began.volume), (head, volume))
        )
        return WaterStored(time, head, volume, taken, began.stored + last - first)

    @kept_of_place
    def _open(self, state: State) -> OpenJoints:
        return self._balance.opened(super().apertures(state))

    def _coupling(self, state: State) -> Floats:
        """Force (n, n_unknowns) of a unit of pressure at each node (m2)."""
        sites, interface = self.sites, self.sites.interface
        piece = interface.first.piece
        assert piece is not None
        unknowns, jump = interface.rows(state)
        push = -interface.area[:, None] * interface.normal(state)
        along = np.einsum("mcl,mc->ml", jump, push)
        found = np.zeros((self.network.n, self.n_unknowns))
        for end, share in enumerate((1 - sites.share, sites.share)):  # both ends of a joint
            node = sites.nodes[piece, end]
            np.add.at(found, (node[:, None], unknowns), share[:, None] * along)
        return found
