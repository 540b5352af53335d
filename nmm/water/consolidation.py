"""The effect: consolidation, with flow and strain coupled both ways (Biot 1941).

The fluid content of a unit volume grows by ``S dh + b d(e)``, where ``e`` is the volumetric strain.
With the force ``C`` of unit pressures on the blocks, whose transpose gives the pore volume that
their motion ``d`` opens, the balance of a step from ``h0`` to ``h1`` is

    (M + dt K) h1 = M h0 + dt f - C^T d,

and the force ``w C h1`` acts on the blocks. It is linear in ``d``: its part without motion is a
force of the step, and the rest the matrix ``w C (M + dt K)^-1 C^T``, which is the undrained
stiffness in the limit of short steps. So heads and motion are found together, and steps of any
length are stable.
"""

from collections.abc import Iterator
from typing import TYPE_CHECKING, Self

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Bools, Floats
from integration.contraction import some
from nmm.assembly.state import State
from nmm.diffusion.course import FieldAt
from nmm.diffusion.problem import step_between
from nmm.effects.base import Instant, Setup
from nmm.errors import Fault, SceneError
from nmm.frozen import with_parts
from nmm.geometry.tessellation.cover_types import piece_glue
from nmm.water.full_matrix import full_matrix, refuse_full
from nmm.water.pore_water import PoreWater

if TYPE_CHECKING:
    from nmm.effects.change import Change


class Consolidation(PoreWater):
    """Hydraulic head in pores of a deforming material."""

    name = "consolidation"
    _step = 0.0
    _stiff: tuple[float, csc_array] | None = None

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from ``[seepage]`` with ``coupled = true``."""
        _refuse_uncoupled(setup)
        found = super().from_setup(setup)
        found.join(setup.start)
        return found

    def join(self, start: State) -> None:
        """Count the pore volume that strain opens from a state on."""
        began = self.course.began
        assert began is not None
        self.course.go_on_from(with_parts(began, taken_in=self._room(start)))

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
            return self.stress.force(self._pressure(began.unknowns))  # type: ignore[union-attr]
        self._step = step_between(began.time, time)
        assert began.taken_in is not None
        room = self._room(state) - began.taken_in
        problem = self.course.problem
        head = problem.stepped(began.unknowns, began.time, time, 1.0, room)
        return self.stress.force(self._pressure(head))  # type: ignore[union-attr]

    def matrix(self, state: State) -> csc_array:
        """Return minus the derivative of the pressure's force by the motion (n, n)."""
        if self._stiff is None or self._stiff[0] != self._step:
            self._stiff = self._step, self._stiffness()
        return self._stiff[1]

    def accepted(self, state: State) -> None:
        """See `Effect.accepted`: solve for the head with the strain of the accepted state."""
        self.course.make_room(state.time * self._second, self._room(state))

    def forget(self) -> None:
        super().forget()
        self._stiff = None

    def follow(self, change: "Change") -> "Consolidation":
        """Return the field on the new model, which counts the pore volume from here on."""
        new = super().follow(change)
        assert isinstance(new, Consolidation)
        new.join(change.state)
        return new

    def _stiffness(self) -> csc_array:
        """Return the matrix for the duration of the present step."""
        assert self.stress is not None
        coupling, problem = self.stress.coupling, self.course.problem
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
        began = self.course.began
        assert began is not None
        return began

    def _room(self, state: State) -> Floats:
        """Pore volume (n,) opened by strain, weighted by the functions of the field (m3)."""
        assert self.stress is not None
        return np.asarray(self.stress.room @ state.deformation)

    def _pressure(self, head: Floats) -> Floats:
        return np.asarray(self._weight * (head - self._ground))


def _refuse_uncoupled(setup: Setup) -> None:
    """Refuse what the coupled solution does not support.

    Raises
    ------
    SceneError
        Steps of the field differ from those of the run; supports or glue are imposed by tractions;
        there are too many unknowns for a full matrix.
    """
    place = setup.scene.source.place("seepage", "coupled")
    asked = setup.formulation.diffusion
    if asked is not None and (asked.theta != 1 or asked.step is not None):
        expected = "steps of the field that are those of the run, with theta = 1"
        raise SceneError(Fault(place, "[diffusion] theta or step", expected, "remove [diffusion]"))
    for table, method, other in _by_tractions(setup):
        expected = f"{table} that need no traction, which the pressure is a part of"
        remedy = f"[{table}] {other} of the formulation"
        raise SceneError(Fault(place, f'{table} by "{method}"', expected, remedy))
    refuse_full(setup, place, "take larger cells")


def _by_tractions(setup: Setup) -> Iterator[tuple[str, str, str]]:
    """Yield tables whose method may take tractions of the blocks; the method; another to take."""
    manifold, asked = setup.model.manifold, setup.formulation
    mesh = len(manifold.element_body) != manifold.n_bodies
    method = asked.supports.method
    if mesh and method in ("auto", "nitsche") and setup.scene.supports:
        yield "supports", method, 'method = "penalty" or "lagrange"'
    method, tied = asked.glue.method, setup.scene.contact is None
    if tied and method in ("auto", "nitsche") and some(_glued(setup)):
        yield "glue", method, 'method = "spring" or "lagrange"'
    pieces = piece_glue(asked.cover)
    if pieces is not None and pieces.method == "nitsche":
        yield "cover.options", "nitsche", 'glue = "springs"'


def _glued(setup: Setup) -> Bools:
    """Return which edges (j,) that blocks share are glued."""
    from nmm.constraints.shared_edges import bonded_stiffness, shared_edges

    return bonded_stiffness(setup, shared_edges(setup.model))[2]
