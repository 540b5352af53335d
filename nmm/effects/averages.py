"""Nitsche's method on interfaces: the traction is an average of both sides, weighted by stiffness.

    a(u, v) + int {t(u)}.[v] + {t(v)}.[u] + gamma [u].[v],    {t} = k_1 t_1 + k_2 t_2

with the normal from the second to the first side, jumps first less second. With ``r_i`` the largest
ratio of ``int t_i^2`` to the energy of what ``t_i`` is taken from, ``k_1 = r_2 / (r_1 + r_2)`` and
``gamma = 4 r_1 r_2 / (r_1 + r_2)`` make the form positive (Annavarapu, Hautefeuille and Dolbow
2012; Griebel and Schweitzer 2003 for the ratio). The harmonic mean is below four times the softer
side's ratio whatever the other's, and a side whose ratio is bad has little weight.
"""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_array, csr_array, diags_array

from integration.arrays import Bools, Floats, Ints
from nmm.assembly.model import Model
from nmm.assembly.motion import State
from nmm.effects.donors import donors, traction_bound, traction_rows
from nmm.effects.rows import sparse_rows
from nmm.effects.ties import Pairs, Tie

# Twice the least penalty with which the form is positive.
SAFETY = 4.0


@dataclass(frozen=True)
class Flux:
    """Weighted traction of one side at the points.

    Attributes
    ----------
    body
        (m,) whose axes the rows are in.
    unknowns, values
        (m, L) and (m, 2, L).
    """

    body: Ints
    unknowns: Ints
    values: Floats

    def rows(self, state: State, n: int) -> csr_array:
        """Rows (2m, n) in global axes, component minor."""
        turned = np.einsum("mij,mjl->mil", state.frames.rotation[self.body], self.values)
        return sparse_rows(self.unknowns, turned, n)

    def take(self, index: Bools) -> "Flux":
        """Return some of the points."""
        return Flux(self.body[index], self.unknowns[index], self.values[index])


@dataclass(frozen=True)
class Averages(Tie):
    """Nitsche's terms at points of interfaces.

    Attributes
    ----------
    pairs
        Where.
    sides
        Tractions of both sides with their weights.
    penalty
        (m,) Pa/m.
    """

    pairs: Pairs
    sides: tuple[Flux, Flux]
    penalty: Floats

    @property
    def about(self) -> str:
        """See `Tie.about`."""
        return f"Nitsche's method at {len(self.penalty)} points"

    def matrix(self, state: State, n: int) -> csc_array:
        """See `Tie.matrix`."""
        rows, flux = self.pairs.rows(state, n), self._flux(state, n)
        cross = csc_array(rows.T @ (self._weights() @ flux))
        square = rows.T @ (self._weights(self.penalty) @ rows)
        return csc_array(cross + cross.T + square)

    def force(self, state: State, n: int) -> Floats:
        """See `Tie.force`."""
        rows, flux = self.pairs.rows(state, n), self._flux(state, n)
        jump = self.pairs.jump(state).ravel()
        pull = self._weights() @ (flux @ state.deformation) + self._weights(self.penalty) @ jump
        return np.asarray(-(rows.T @ pull) - flux.T @ (self._weights() @ jump))

    def energy(self, state: State) -> float:
        """See `Tie.energy`; below zero by what the average traction stores in the jump."""
        n, jump = len(state.deformation), self.pairs.jump(state).ravel()
        average = self._flux(state, n) @ state.deformation
        return float(jump @ (self._weights() @ average + self._weights(self.penalty) @ jump / 2))

    def _flux(self, state: State, n: int) -> csr_array:
        one, two = self.sides
        return csr_array(one.rows(state, n) + two.rows(state, n))

    def _weights(self, factor: Floats | float = 1.0) -> csr_array:
        return csr_array(diags_array(np.repeat(factor * self.pairs.weight, 2)))


def averages(
    model: Model, pairs: Pairs, elements: tuple[Ints, Ints], gamma: float | None = None
) -> tuple[Averages, Bools]:
    """Return Nitsche's terms, and at which points (m,) there is stress on neither side.

    Parameters
    ----------
    elements
        (m,) and (m,) elements of the first and the second side.
    gamma
        Penalty as a multiple of the bound ``r_1 r_2 / (r_1 + r_2)``; 4 when not given.
    """
    found, bounds = [], []
    for side, own in zip((pairs.first, pairs.second), elements, strict=True):
        donor = donors(model, own)
        place = model.manifold.body_centroid[side.body] + side.arm
        unknowns, rows = traction_rows(model, donor, place, pairs.normal)
        bounds.append(traction_bound(model, donor, rows, pairs.weight))
        found.append(Flux(side.body, unknowns, rows))
    # Functions without strain are as a material that nothing strains.
    rigid = [bound == 0 for bound in bounds]
    ease = [np.where(r, 0.0, 1 / np.where(r, 1.0, b)) for r, b in zip(rigid, bounds, strict=True)]
    total = ease[0] + ease[1]
    held = total > 0
    share = np.where(held, total, 1.0)
    penalty = np.where(held, (SAFETY if gamma is None else gamma) / share, 0.0)
    weighted = tuple(
        Flux(flux.body, flux.unknowns, (own / share)[:, None, None] * flux.values)
        for flux, own in zip(found, ease, strict=True)
    )
    return Averages(pairs, (weighted[0], weighted[1]), penalty), ~held
