"""The effect: consolidation, with flow and strain coupled both ways (Biot 1941).

The fluid content of a unit volume grows by ``S dh + b d(e)``, where ``e`` is the volumetric strain.
With the force ``C`` of unit pressures on the blocks, whose transpose gives the pore volume that
their motion ``d`` opens, the balance of a step from ``h0`` to ``h1`` is

    (M + dt K) h1 = M h0 + dt f - C^T d,

and the force ``w C h1`` acts on the blocks. Where tractions hold edges, as Nitsche's terms do, the
pressure is a part of the traction, and what the edge is left open by is strain: ``C`` has both
(`nmm.assembly.tractions.held_edges`). It is linear in ``d``: its part without motion is a
force of the step, and the rest the matrix ``w C (M + dt K)^-1 C^T``, which is the undrained
stiffness in the limit of short steps. So heads and motion are found together, and steps of any
length are stable.
"""

from collections.abc import Hashable, Sequence
from typing import TYPE_CHECKING, Self

import numpy as np
from scipy.sparse import csc_array, csr_array

from integration.arrays import Floats
from nmm.assembly.kept import kept_of_object
from nmm.assembly.state import State
from nmm.diffusion.course import FieldAt
from nmm.diffusion.problem import step_between
from nmm.effects.base import Instant, Setup
from nmm.errors import Fault, SceneError
from nmm.water.full_matrix import full_matrix, refuse_full
from nmm.water.pore_water import PoreWater

if TYPE_CHECKING:
    from nmm.assembly.tractions.held_edges import HeldEdge
    from nmm.effects.change import Change
    from nmm.effects.hooks.exchange import HeldEdgesAt


class Consolidation(PoreWater):
    """Hydraulic head in pores of a deforming material."""

    name = "consolidation"
    _step = 0.0
    _stiff: tuple[Hashable, csc_array] | None = None
    _edges: "Sequence[HeldEdgesAt]" = ()
    _from: State | None = None  # where the step begins; corrections of it go on elsewhere

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from ``[seepage]`` with ``coupled = true``."""
        _refuse_uncoupled(setup)
        found = super().from_setup(setup)
        found.join(setup.start)
        return found

    def join(self, start: State) -> None:
        """Count the pore volume that strain opens from a state on."""
        self.course.count_room_from(self._room(start, Instant.of(start)))

    @property
    def about(self) -> str:
        return f"with strain, {self.space.n} unknowns"

    @property
    def steady(self) -> bool:
        """See `Effect.steady`: the pressure at the end of a step depends on its duration."""
        return False

    def force(self, state: State, end: Instant) -> Floats:
        """Return the force (n,) of the pressure at the end of a step without motion."""
        began = self._begun(state, end)
        time = end.time * self._second
        if time == began.time:
            return self.stress.force(self.acting(end.time))  # type: ignore[union-attr]
        self._step = step_between(began.time, time)
        # Tractions that hold edges are told of this pressure, too.
        self.course.make_room(time, self._room(state, end))
        return self.stress.force(self.acting(end.time))  # type: ignore[union-attr]

    def matrix(self, state: State) -> csc_array:
        """Return minus the derivative of the pressure's force by the motion (n, n)."""
        edges = self._held(state, Instant.of(state))
        key = self._step, tuple(one.key for one in edges)
        if self._stiff is None or self._stiff[0] != key:
            self._stiff = key, self._stiffness(edges)
        return self._stiff[1]

    def accepted(self, state: State) -> None:
        """See `Effect.accepted`: solve for the head with the strain of the accepted state."""
        if self._from is not None:
            self.join(self._from)
        self.course.make_room(state.time * self._second, self._room(state, Instant.of(state)))

    def forget(self) -> None:
        super().forget()
        self._stiff = None

    def follow(self, change: "Change") -> "Consolidation":
        """Return the field on the new model, which counts the pore volume from here on."""
        new = super().follow(change)
        assert isinstance(new, Consolidation)
        new.join(change.state)
        return new

    def receive_held_edges(self, edges: "Sequence[HeldEdgesAt]") -> None:
        """See `Effect.receive_held_edges`: their jumps make room for water."""
        self._edges = edges

    def _held(self, state: State, end: Instant) -> "list[HeldEdge]":
        return [one for held in self._edges for one in held(state, end)]

    def _stiffness(self, edges: "Sequence[HeldEdge]") -> csc_array:
        """Return the matrix for the duration of the present step."""
        assert self.stress is not None
        problem, units = self.course.problem, self.stress.units
        coupling = self.stress.coupling
        for one in edges:  # a handful
            coupling = csr_array(coupling + one.coupling(units))
        if not problem.free.any():
            return csc_array((coupling.shape[0], coupling.shape[0]))
        used = np.flatnonzero(np.diff(coupling.indptr))
        some = csc_array(coupling[used])
        full = self._weight * (some @ problem.relief(self._step, csc_array(some.T)))
        return full_matrix((full + full.T) / 2, used, coupling.shape[0])

    def _begun(self, state: State, end: Instant) -> FieldAt:
        """Return the field at the start of the step to ``end``."""
        if end.time > state.time:
            self.course.begin(state.time * self._second)
            if self._from is None or self._from.time != state.time:
                self._from = state
            self.join(self._from)  # without the edges of bonds that have broken since
        began = self.course.began
        assert began is not None
        return began

    def _room(self, state: State, end: Instant) -> Floats:
        """Pore volume (n,) opened by strain, weighted by the functions of the field (m3).

        What held edges leave open belongs to it, with the ground where it is at ``end``.
        """
        assert self.stress is not None
        room, units = self._opened(state.deformation), self.stress.units
        return sum((one.work(units) for one in self._held(state, end)), start=room)

    @kept_of_object
    def _opened(self, deformation: Floats) -> Floats:
        """Pore volume (n,) that a deformation opens, without held edges (m3)."""
        assert self.stress is not None
        return np.asarray(self.stress.room @ deformation)


def _refuse_uncoupled(setup: Setup) -> None:
    """Refuse what the coupled solution does not support.

    Raises
    ------
    SceneError
        Steps of the field differ from those of the run; there are too many unknowns for a full
        matrix.
    """
    place = setup.scene.source.place("seepage", "coupled")
    asked = setup.formulation.diffusion
    if asked is not None and (asked.theta != 1 or asked.step is not None):
        expected = "steps of the field that are those of the run, with theta = 1"
        raise SceneError(Fault(place, "[diffusion] theta or step", expected, "remove [diffusion]"))
    refuse_full(setup, place, "take larger cells")
