"""Hooks by which effects give stresses, pressures and forces to one another."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from integration.arrays import Floats, Ints
from nmm.assembly.applied_forces import AppliedForces, AppliedForcesIn
from nmm.assembly.state import State
from nmm.assembly.stress_points import PressureAt, StressAt
from nmm.effects.given.steps import Instant

if TYPE_CHECKING:
    from collections.abc import Callable

    from nmm.assembly.tractions.held_edges import HeldEdge

    HeldEdgesAt = Callable[[State, Instant], list[HeldEdge]]


class ExchangeHooks:
    """What an effect adds to the stress and to the forces, and what it receives of others."""

    def mean_stress(self, state: State) -> Floats:
        """Mean stress (E, 3) of the elements in body axes (Pa), to add to the elastic stress."""
        raise NotImplementedError

    def mean_stress_across(self, state: State) -> Floats:
        """Mean stress across the plane (E,) that comes with `mean_stress` (Pa).

        By default that of elastic matter at that stress. Asked for in plane strain alone.
        """
        raise NotImplementedError

    def stress_across_at(self, elements: Ints, points: Floats, time: float) -> Floats:
        """Stress across the plane (m,) that comes with `stress_at` (Pa)."""
        raise NotImplementedError

    def stress_at(self, elements: Ints, points: Floats, time: float) -> Floats:
        """The same stress (m, 3) at reference points (m, 2) of elements (m,), at a time (s)."""
        raise NotImplementedError

    def receive_stresses(self, stresses: Sequence[StressAt]) -> None:
        """Receive the `stress_at` of the other effects, as tractions at edges need them."""
        raise NotImplementedError

    def received_stress_energy(self, state: State) -> float:
        """The part (J) of its energy that belongs to the received stresses."""
        raise NotImplementedError

    def held_edges(self, state: State, end: Instant) -> "list[HeldEdge]":
        """Return the edges whose jumps the tractions of received stresses work on.

        With the ground where it is at the instant ``end``.
        """
        raise NotImplementedError

    def receive_held_edges(self, edges: "Sequence[HeldEdgesAt]") -> None:
        """Receive the `held_edges` of the other effects, whose jumps are strain of the material."""
        raise NotImplementedError

    def swelling(self, state: State, end: Instant) -> Floats | None:
        """Stress-free isotropic strain (Q,) of material points at the end of a step; None for none.

        Nonlinear laws are evaluated with it; for other elements the effect has a `force`.
        """
        raise NotImplementedError

    def pore_pressure_at(self, elements: Ints, points: Floats, time: float) -> Floats:
        """Pore pressure (m,) at reference points (m, 2) of elements (m,), at a time (s) (Pa)."""
        raise NotImplementedError

    def receive_pore_pressures(self, pressures: Sequence[PressureAt]) -> None:
        """Receive the `pore_pressure_at` of the other effects, which strengths depend on."""
        raise NotImplementedError

    def applied_forces(self, state: State) -> AppliedForces:
        """Return its forces within bodies and on crack faces, weight excepted.

        Stress intensity factors depend on them; forces on the rest of the boundary are known by
        the stress there.
        """
        raise NotImplementedError

    def receive_forces(self, forces: Sequence[AppliedForcesIn]) -> None:
        """Receive the `applied_forces` of the other effects."""
        raise NotImplementedError

    def gap_volume(self, state: State, k: int) -> Floats:
        """Volumes (k,) open at held edges, for the k projected pressures of a model (m2)."""
        raise NotImplementedError
