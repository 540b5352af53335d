"""Nitsche's method on interfaces: the traction is an average of both sides, weighted by stiffness.

    a(u, v) + int {t(u)}.[v] + {t(v)}.[u] + gamma [u].[v],    {t} = k_1 t_1 + k_2 t_2

with the normal from the second to the first side, jumps first less second. With ``r_i`` the largest
ratio of ``int t_i^2`` to the energy of what ``t_i`` is taken from, the integral over all edges it
serves, ``k_1 = r_2 / (r_1 + r_2)`` and ``gamma >= r_1 r_2 / (r_1 + r_2)`` make the form positive
(Annavarapu, Hautefeuille and Dolbow 2012; Griebel and Schweitzer 2003 for the ratio). A side whose
ratio is bad has little weight.

The ratio is a modulus ``m_i`` times a reach ``g_i`` in 1/m. The penalty is four times the bound
with the larger reach on both sides, ``gamma = 4 g m_1 m_2 / (m_1 + m_2)``: below four times the
softer side's, whatever the other's modulus. With the reach of either side a thin side would hardly
count, and what is glued to it would give way by a quarter of its own strain where nothing pulls.

Pressures of nearly incompressible sides have terms of their own (`nmm.constraints.volume_lift`).
"""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_array, csr_array, diags_array

from integration.arrays import Bools, Floats, Ints
from nmm.assembly.model import Model
from nmm.assembly.motion import State
from nmm.constraints.rows import sparse_rows
from nmm.constraints.ties import Tie, TiedPairs
from nmm.constraints.traction_donors import donors, traction_bound, traction_rows
from nmm.constraints.volume_lift import Lift, lift

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
    lifts
        The part of pressures, of each side that has any.
    """

    pairs: TiedPairs
    sides: tuple[Flux, Flux]
    penalty: Floats
    lifts: tuple[Lift, ...] = ()

    @property
    def about(self) -> str:
        """See `Tie.about`."""
        return f"Nitsche's method at {len(self.penalty)} points"

    def matrix(self, state: State, n: int) -> csc_array:
        """See `Tie.matrix`."""
        rows, flux = self.pairs.rows(state, n), self._flux(state, n)
        cross = csc_array(rows.T @ (self._weights() @ flux))
        square = rows.T @ (self._weights(self.penalty) @ rows)
        total = cross + cross.T + square
        if self.lifts:
            across = self._across(state, n)
            for part in self.lifts:  # at most two
                total = total + part.matrix(across)
        return csc_array(total)

    def force(self, state: State, n: int) -> Floats:
        """See `Tie.force`."""
        rows, flux = self.pairs.rows(state, n), self._flux(state, n)
        jump = self.pairs.jump(state).ravel()
        pull = self._weights() @ (flux @ state.deformation) + self._weights(self.penalty) @ jump
        total = np.asarray(-(rows.T @ pull) - flux.T @ (self._weights() @ jump))
        if self.lifts:
            across, gap = self._across(state, n), self._gap(state)
            for part in self.lifts:  # at most two
                total = total + part.force(across, state.deformation, gap)
        return total

    def energy(self, state: State) -> float:
        """See `Tie.energy`; below zero by what the average traction stores in the jump."""
        n, jump = len(state.deformation), self.pairs.jump(state).ravel()
        average = self._flux(state, n) @ state.deformation
        found = float(jump @ (self._weights() @ average + self._weights(self.penalty) @ jump / 2))
        gap = self._gap(state) if self.lifts else jump
        return found + sum(part.energy(state.deformation, gap) for part in self.lifts)

    def gap_volume(self, state: State, k: int) -> Floats:
        """See `Tie.gap_volume`."""
        gap, total = self._gap(state), np.zeros(k)
        for part in self.lifts:  # at most two
            total += part.gap_volume(gap, k)
        return total

    def _gap(self, state: State) -> Floats:
        """By how much (m,) the sides overlap, which is along the outward normal of either."""
        return -np.asarray(np.sum(self.pairs.jump(state) * self._normal(state), axis=1))

    def _across(self, state: State, n: int) -> csr_array:
        """Rows (m, n) of the same."""
        normal = self._normal(state)
        m = np.arange(len(normal))
        entries = -normal.ravel(), (np.repeat(m, 2), np.arange(2 * len(normal)))
        pick = csr_array(entries, shape=(len(normal), 2 * len(normal)))
        return csr_array(pick @ self.pairs.rows(state, n))

    def _normal(self, state: State) -> Floats:
        return state.frames.to_global(self.pairs.second.body, self.pairs.normal)

    def _flux(self, state: State, n: int) -> csr_array:
        one, two = self.sides
        return csr_array(one.rows(state, n) + two.rows(state, n))

    def _weights(self, factor: Floats | float = 1.0) -> csr_array:
        return csr_array(diags_array(np.repeat(factor * self.pairs.weight, 2)))


def averages(
    model: Model, pairs: TiedPairs, elements: tuple[Ints, Ints], gamma: float | None = None
) -> tuple[Averages, Bools]:
    """Return Nitsche's terms, and at which points (m,) there is stress on neither side.

    Parameters
    ----------
    elements
        (m,) and (m,) elements of the first and the second side.
    gamma
        Penalty as a multiple of the bound ``g m_1 m_2 / (m_1 + m_2)``; 4 when not given.
    """
    donor = [donors(model, own) for own in elements]
    found, places = [], []
    for side, own in zip((pairs.first, pairs.second), donor, strict=True):
        place = model.manifold.body_centroid[side.body] + side.arm
        places.append(place)
        found.append(Flux(side.body, *traction_rows(model, own, place, pairs.normal)))
    bounds = _bounds(model, donor, found, pairs.weight)
    # Functions without strain are as a material that nothing strains.
    ease = [_inverse(bound) for bound in bounds]
    total = ease[0] + ease[1]
    held = total > 0
    share = np.where(held, total, 1.0)
    weighted = tuple(
        Flux(flux.body, flux.unknowns, (own / share)[:, None, None] * flux.values)
        for flux, own in zip(found, ease, strict=True)
    )
    penalty = (SAFETY if gamma is None else gamma) * _least(model, donor, bounds)
    length = pairs.weight / model.thickness
    lifts = [
        lift(model, own, place, length * near / share)
        for own, place, near in zip(elements, places, ease, strict=True)
    ]
    known = tuple(one for one in lifts if one is not None)
    return Averages(pairs, (weighted[0], weighted[1]), penalty, known), ~held


def _bounds(
    model: Model, donor: list[Ints], found: list[Flux], weight: Floats
) -> tuple[Floats, Floats]:
    """Largest ratio (m,) of traction to energy of the donors on both sides.

    An element may be on the first side of one edge and on the second of another: its tractions on
    all of them draw on the same energy.
    """
    m, length = len(weight), max(flux.values.shape[2] for flux in found)
    values = np.zeros((2 * m, 2, length))
    for number, flux in enumerate(found):  # two sides
        values[number * m : (number + 1) * m, :, : flux.values.shape[2]] = flux.values
    both = traction_bound(model, np.concatenate(donor), values, np.tile(weight, 2))
    return both[:m], both[m:]


def _least(model: Model, donor: list[Ints], bounds: tuple[Floats, Floats]) -> Floats:
    """``g m_1 m_2 / (m_1 + m_2)`` (m,): the bound with the larger reach on both sides (Pa/m)."""
    modulus = model.drained[:, :2, :2].max(axis=(1, 2))
    reach = np.maximum(bounds[0] / modulus[donor[0]], bounds[1] / modulus[donor[1]])
    strained = [bound > 0 for bound in bounds]
    give = [np.where(s, 1 / modulus[d], 0.0) for s, d in zip(strained, donor, strict=True)]
    return np.asarray(reach * _inverse(give[0] + give[1]))


def _inverse(values: Floats) -> Floats:
    """One over each value; zero for zero."""
    return np.asarray(np.where(values > 0, 1 / np.where(values > 0, values, 1.0), 0.0))
