"""The effect: transient flow in joints, with storage by their opening and by compressible water.

The volume ``V`` of water at a node is about half of that of each joint that ends there. A change of
pressure ``dp`` stores ``V dp / K``, and an opening ``dV``. With the cubic law for the flow
(Witherspoon and others 1980) the balance of a step is

    M (h1 - h0) + dt G h1 = - (V - V0) - C^T d,    M = w V / K,

where ``G`` is the conductance with known apertures and ``C`` the force of unit pressures on the
blocks, so that ``C^T d`` is the volume that their motion ``d`` opens. The force ``w C h1`` on the
blocks is linear in ``d``; so the matrix ``w C (M + dt G)^-1 C^T`` is added to the stiffness, heads
and motion are found together, and steps are stable however stiff the water is.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Self

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Bools, Floats
from nmm.assembly.state import State
from nmm.diffusion.problem import step_between
from nmm.effects.base import Instant, Setup
from nmm.effects.change import Change
from nmm.water.full_matrix import full_matrix, refuse_full
from nmm.water.joint_water import JointWater


@dataclass(frozen=True)
class WaterStored:
    """The water at a time.

    Attributes
    ----------
    time
        s.
    head, volume
        (n,) heads of the nodes (m), and volumes of the joints at them (m3).
    taken
        Volume that came in since the start (m3), by the name of the prescribed head.
    """

    time: float
    head: Floats
    volume: Floats
    taken: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class OpenJoints:
    """Volumes and conductances of the joints in a state.

    Attributes
    ----------
    state
        The state.
    aperture
        (j, 2) apertures at their ends (m).
    volume, store
        (n,) volumes of the joints at their nodes (m3), and their storage by a unit of head (m2).
    flow
        (n, n) conductance matrix ``G`` of the network (m2/s).
    """

    state: State
    aperture: Floats
    volume: Floats
    store: Floats
    flow: Floats


class JointStorage(JointWater):
    """Transient flow in the joints of a scene."""

    name = "transient joint flow"
    _began: WaterStored
    _end: WaterStored
    _bulk, _second = 2.2e9, 1.0
    _step, _time = 0.0, 0.0
    _open: OpenJoints | None = None
    _found: tuple[State, WaterStored, WaterStored] | None = None

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from ``[joint_flow]`` with ``transient = true``."""
        table = setup.scene.joint_flow
        assert table is not None
        assert table.initial is not None
        place = setup.scene.source.place("joint_flow", "transient")
        refuse_full(place, setup.model.manifold.n_unknowns, "take fewer blocks, or steady flow")
        found = super().from_setup(setup)
        found._bulk = table.bulk_modulus
        found._second = 1.0 if table.duration is None else table.duration
        head = np.full(found.network.n, table.initial - setup.origin[1])
        begin = setup.start.time * found._second
        found._began = WaterStored(begin, head, found._volume(setup.start))
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
        return self._end.head if time == self._end.time else self._at(state, time).head

    def force(self, state: State, end: Instant) -> Floats:
        """Return the force (n_unknowns,) of the pressure at the end of a step without motion."""
        if end.time > state.time and state.time * self._second == self._end.time:
            self._began = self._end
        time = end.time * self._second
        if time == self._began.time:  # the force at the start of the step, whose duration stays
            return super().force(state, end)
        self._step, self._time = step_between(self._began.time, time), time
        head = self._at(state, time).head
        pressure = self.weight * np.maximum(head - self.sites.places[:, 1], 0.0)
        forces = self.sites.forces(state, pressure[self.sites.nodes])
        return self.sites.interface.spread(state, forces)

    def matrix(self, state: State) -> csc_array:
        """Return minus the derivative of the pressure's force by the motion (n, n)."""
        free = self._free(self._time)
        # There is no suction: only nodes under pressure respond.
        wet = free & (self._at(state, self._time).head > self.sites.places[:, 1])
        if not wet.any():
            return csc_array((self.n_unknowns, self.n_unknowns))
        coupling = self._coupling(state, wet)
        used = np.flatnonzero(np.abs(coupling).any(axis=1))
        full = np.zeros((self.network.n, len(used)))
        full[wet] = coupling[used].T
        answers = np.linalg.solve(self._matrix(state, self._step)[np.ix_(free, free)], full[free])
        found = self.weight * (coupling[used] @ answers[wet[free]])
        return full_matrix(found, used, self.n_unknowns)

    def accepted(self, state: State) -> None:
        """See `Effect.accepted`: solve for the heads with the apertures of the accepted state."""
        time = state.time * self._second
        if time > self._began.time:
            self._end = self._at(state, time)

    def history(self, state: State) -> Mapping[str, float]:
        """Return the largest pressure (Pa) and aperture (m), and inflows since the start (m3)."""
        pressure = float(self.pressures(state, state.time).max())
        taken = {f"taken:{name}": amount for name, amount in self._end.taken.items()}
        return {**taken, "pressure": pressure, "aperture": float(self.apertures(state).max())}

    def carried(self) -> Any:
        return tuple(
            (one.time, one.head, one.volume, dict(one.taken)) for one in (self._began, self._end)
        )

    def carry(self, carried: Any) -> None:
        self._began, self._end = (WaterStored(*one) for one in carried)

    def apertures(self, state: State) -> Floats:
        return self._opened(state).aperture

    def forget(self) -> None:
        super().forget()
        self._open = self._found = None

    def follow(self, change: Change) -> "JointStorage":
        """Return the water on the new model, with the heads of nodes that it shares."""
        from scipy.spatial import KDTree

        new = type(self).from_setup(change.setup)
        near, nearest = KDTree(self.sites.places).query(new.sites.places)
        known = near <= 1e-9 * (1 + np.abs(self.sites.places).max())
        old = self._end
        head = np.where(known, old.head[nearest], new._began.head)
        volume = new._volume(change.state)
        new._began = new._end = WaterStored(old.time, head, volume, old.taken)
        return new

    def _at(self, state: State, time: float) -> WaterStored:
        """Return the water at a time with the apertures of a state; cached."""
        known = self._found
        if known is None or known[0] is not state or known[1] is not self._began:
            known = None
        if known is None or known[2].time != time:
            known = self._found = state, self._began, self._solved(state, time)
        return known[2]

    def _solved(self, state: State, time: float) -> WaterStored:
        began = self._began
        step = step_between(began.time, time)
        matrix, volume = self._matrix(state, step), self._volume(state)
        free = self._free(time)
        head = began.head.copy()
        nodes, given = self.given(time / self._second)
        head[nodes] = given
        load = self._store(state) * began.head - (volume - began.volume)
        load = load - matrix[:, ~free] @ head[~free]
        head[free] = np.linalg.solve(matrix[np.ix_(free, free)], load[free])
        # The residual at prescribed heads is their inflow.
        missing = matrix @ head - (self._store(state) * began.head - (volume - began.volume))
        taken = {
            one.name: began.taken.get(one.name, 0.0) + float(missing[one.nodes].sum())
            for one in self.prescribed
        }
        return WaterStored(time, head, volume, taken)

    def _free(self, time: float) -> Bools:
        found = np.ones(self.network.n, dtype=bool)
        found[self.given(time / self._second)[0]] = False
        return found

    def _matrix(self, state: State, step: float) -> Floats:
        """Return ``M + dt G`` (n, n), in m2."""
        joints = self._opened(state)
        return np.asarray(np.diag(joints.store) + step * joints.flow)

    def _store(self, state: State) -> Floats:
        """Storage (n,) by a unit of head (m2); positive at nodes of closed joints, too."""
        return self._opened(state).store

    def _volume(self, state: State) -> Floats:
        """Volume (n,) of the joints at their nodes (m3), weighted as pressures are."""
        return self._opened(state).volume

    def _opened(self, state: State) -> OpenJoints:
        """Return the joints of a state; cached."""
        if self._open is None or self._open.state is not state:
            self._open = self._opening(state)
        return self._open

    def _opening(self, state: State) -> OpenJoints:
        aperture, n = super().apertures(state), self.network.n
        one, other = aperture.T
        length = self.network.length * self._thickness / 6
        shares = np.stack([length * (2 * one + other), length * (one + 2 * other)], axis=1)
        volume = np.bincount(self.network.ends.ravel(), shares.ravel(), n).astype(float)
        store = self.weight / self._bulk * np.maximum(volume, 1e-9 * volume.max())
        a, b = self.network.ends.T
        flow, found = self.network.conductance(aperture) * self._thickness, np.zeros((n, n))
        for row, column, sign in ((a, a, 1.0), (b, b, 1.0), (a, b, -1.0), (b, a, -1.0)):
            np.add.at(found, (row, column), sign * flow)
        return OpenJoints(state, aperture, volume, np.asarray(store), found)

    def _coupling(self, state: State, wet: Bools) -> Floats:
        """Force (n_unknowns, k) of unit pressure at each wet node (m2)."""
        sites, n = self.sites, self.network.n
        piece = sites.interface.first.piece
        assert piece is not None
        unknowns, jump = sites.interface.rows(state)
        push = -sites.interface.area[:, None] * sites.interface.normal(state)
        along = np.einsum("mcl,mc->ml", jump, push)
        found = np.zeros((n, self.n_unknowns))
        for end, share in enumerate((1 - sites.share, sites.share)):  # both ends of a joint
            node = sites.nodes[piece, end]
            np.add.at(found, (node[:, None], unknowns), share[:, None] * along)
        return np.asarray(found[wet].T)

    @property
    def _thickness(self) -> float:
        sites = self.sites
        return float(sites.interface.area.sum() / sites.joints.length.sum())
