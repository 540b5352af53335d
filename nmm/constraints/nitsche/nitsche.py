"""Nitsche's method (1971): the traction of the solid holds the interface, consistent and symmetric.

    a(u, v) - int {t(u)}.[v] + {t(v)}.[u] - gamma [u].[v],    {t} = k_1 t_1 + k_2 t_2

with tractions on the first side and jumps first less second. Against the ground the only traction
is the body's own.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import ClassVar, Self

import numpy as np
from scipy.sparse import csc_array, csr_array

from covers.approximation.rows import row_matrix
from integration.arrays import Bools, Floats, Ints
from integration.contraction import contract
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.assembly.stress_points import StressAt
from nmm.assembly.tractions.donors import Flux, added_traction, in_global_axes
from nmm.assembly.tractions.held_edges import HeldEdge
from nmm.constraints.imposition import Imposition, Method
from nmm.constraints.interface import Interface, Triplets, joined, product, sparse_rows
from nmm.constraints.nitsche.finite_traction import FiniteTraction, finite_penalty
from nmm.constraints.nitsche.linear_matter import check_linear
from nmm.constraints.nitsche.nitsche_terms import against_ground, between_bodies
from nmm.constraints.nitsche.volume_lift import PressureLift


@dataclass(frozen=True)
class Nitsche(Imposition):
    """Nitsche's terms at points of interfaces.

    Attributes
    ----------
    penalty
        (m,) Pa/m; zero where neither side has stress.
    fluxes
        Tractions on the first side that either side gives, times its weight; none where matter
        of finite strain has them.
    ghost
        Matrix that ties cut elements to their neighbours; None without any.
    lift
        The part of pressures; None where neither side has any.
    edge
        Matter of finite strain beside a support, which has the traction; None of linear matter.
    """

    penalty: Floats
    fluxes: tuple[Flux, ...]
    ghost: csc_array | None = None
    lift: PressureLift | None = None
    edge: FiniteTraction | None = None

    words: ClassVar[str] = "Nitsche's method"
    reads: ClassVar[frozenset[str] | None] = frozenset({"gamma", "ghost"})
    needs_cells: ClassVar[bool] = True
    reads_stress: ClassVar[bool] = True

    @classmethod
    def of(cls, model: Model, interface: Interface, method: Method) -> Self:
        place, other = ("supports", "penalty") if interface.second is None else ("glue", "spring")
        if interface.second is not None or not model.finite:
            check_linear(model, f"[{place}] method", f'method = "{other}"')
        if interface.second is not None:
            return cls(interface, *between_bodies(model, interface, method))
        if not model.finite:
            return cls(interface, *against_ground(model, interface, method))
        edge = interface.first
        penalty = finite_penalty(model, edge, interface.area, method)
        return cls(interface, penalty, (), edge=FiniteTraction.of(model, edge))

    def with_lift(self, lift: PressureLift) -> Self:
        return replace(self, lift=lift)

    def matrix(self, state: State) -> Triplets:
        area, n = self.interface.area[:, None, None], len(state.deformation)
        unknowns, rows = self.interface.rows(state)
        flux = self._slopes(state)
        row, column, value = product((unknowns, -area * rows), flux)
        square = product((unknowns, rows), (unknowns, area * self.penalty[:, None, None] * rows))
        parts: list[Triplets] = [(row, column, value), (column, row, value), square]
        more = [] if self.ghost is None else [self.ghost]
        if self.lift is not None:
            more.append(self.lift.matrix(self._across(state, n)))
        for term in more:  # at most two
            entries = term.tocoo()
            places = entries.coords
            parts.append((np.asarray(places[0]), np.asarray(places[1]), entries.data))
        return joined(parts)

    def force(self, state: State, jump: Floats) -> Floats:
        unknowns, flux = self._slopes(state)
        back = contract("mcl,mc->ml", flux, self.interface.area[:, None] * jump)
        total = self.interface.spread(state, self._consistent(state, jump))
        total += np.bincount(unknowns.ravel(), back.ravel(), minlength=len(total))
        if self.ghost is not None:
            total -= self.ghost @ state.deformation
        if self.lift is not None:
            across, gap = self._across(state, len(total)), self._gap(state, jump)
            total += self.lift.force(across, state.deformation, gap)
        return total

    def point_forces(self, state: State, jump: Floats) -> Floats:
        total = self.interface.held * self._consistent(state, jump)
        if self.lift is not None:
            pressure = self.lift.pressure(state.deformation, self._gap(state, jump))
            total += self.interface.held * (pressure[:, None] * self.interface.normal(state))
        return np.asarray(total)

    def added(self, state: State, stresses: Sequence[StressAt], time: float) -> Floats:
        if self.edge is not None:
            return super().added(state, stresses, time)
        total = added_traction(self.fluxes, state.frames, stresses, time)
        return self.interface.area[:, None] * total

    def held_edge(self, state: State, jump: Floats) -> HeldEdge | None:
        if self.edge is not None:
            return None

        def rows() -> tuple[csr_array, csr_array]:
            both = sparse_rows(*self.interface.rows(state), len(state.deformation))
            return csr_array(both[0::2]), csr_array(both[1::2])

        return HeldEdge(self.fluxes, state.frames, self.interface.area, jump, rows)

    def energy(self, state: State, jump: Floats) -> float:
        """Minus tractions times jumps, half the penalty's and the ghost's; it may be negative."""
        q, area = state.deformation, self.interface.area[:, None]
        total = float(np.sum(jump * (area * self.penalty[:, None] * jump / 2)))
        total -= float(np.sum(area * jump * self._traction(state)))
        if self.ghost is not None:
            total += 0.5 * float(q @ (self.ghost @ q))
        if self.lift is not None:
            total += self.lift.energy(q, self._gap(state, jump))
        return total

    def gap_volume(self, state: State, jump: Floats, k: int) -> Floats:
        if self.lift is None:
            return np.zeros(k)
        return self.lift.gap_volume(self._gap(state, jump), k)

    @property
    def free(self) -> Bools:
        """See `Imposition.free`: where neither side has functions with strain."""
        return np.asarray(self.penalty == 0)

    @property
    def tied_unknowns(self) -> Ints:
        """See `Imposition.tied_unknowns`: those in the ghost terms."""
        if self.ghost is None:
            return np.empty(0, dtype=np.int64)
        return np.unique(self.ghost.nonzero()[0])

    @property
    def bends(self) -> bool:
        """See `Imposition.bends`: with the stress of finite strain."""
        return self.edge is not None

    def _slopes(self, state: State) -> tuple[Ints, Floats]:
        """Unknowns (m, L) and slopes (m, 2, L) of the average traction by them.

        How slopes change themselves counts in no matrix: times jumps that are held it is little.
        """
        if self.edge is not None:
            return self.edge.unknowns, self.edge.slopes(state.deformation)
        return in_global_axes(self.fluxes, state.frames)

    def _traction(self, state: State) -> Floats:
        """Average traction (m, 2) on the first side (Pa)."""
        if self.edge is not None:
            return self.edge.traction(state.deformation)
        unknowns, flux = in_global_axes(self.fluxes, state.frames)
        return contract("mcl,ml->mc", flux, state.deformation[unknowns])

    def _consistent(self, state: State, jump: Floats) -> Floats:
        """Forces (m, 2) in N of the average traction and the penalty on the first side."""
        pull = self._traction(state) - self.penalty[:, None] * jump
        return np.asarray(self.interface.area[:, None] * pull)

    def _gap(self, state: State, jump: Floats) -> Floats:
        """Jumps (m,) along the outward normal of the first side."""
        return np.asarray(np.sum(jump * self.interface.normal(state), axis=1))

    def _across(self, state: State, n: int) -> csr_array:
        """Rows (m, n) of the same."""
        unknowns, rows = self.interface.rows(state)
        along = contract("mcl,mc->ml", rows, self.interface.normal(state))
        return row_matrix(unknowns, along, n, merged=True)
