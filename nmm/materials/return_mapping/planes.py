"""Return of stresses to planes of a yield surface whose strengths fall together.

In principal stresses, or in size of the deviator and mean stress, yield surfaces of soil and rock
are planes, and elasticity is one matrix. Where a set of them acts, the returned stress is a fixed
matrix of the trial's and another of the strengths (de Souza Neto, Peric and Owen 2008, chapter 8).
Which set does is found by trying all that can: no plane may be exceeded and none may flow backwards
(the conditions of Karush, Kuhn and Tucker, Koiter 1953).

All strengths ``L`` fall with one share ``D`` from 0 to 1, ``L - D dL``, and ``D`` grows with the
flow ``g`` along planes by ``dL . g h / 2 G``. Beyond what the last strengths take, flow to
``D = 1`` in a cell of size ``h`` then takes ``integral of (1 - D) dL . dg = G / h``, along
whichever planes it goes: a band as wide as a cell takes ``G`` for its area (crack band; Bazant and
Oh 1983). Planes of friction that falls turn as well: `nmm.materials.return_mapping.turning_planes`.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Protocol, Self

import numpy as np

from integration.arrays import Bools, Floats, Ints

# Share of the stresses by which rounding leaves a point beyond the yield surface: it is elastic.
BEYOND = 1e-10
Normals = tuple[Floats, Floats]
"""Normals (p, d) of planes of yield, and the ways (p, d) along which they flow."""


@dataclass(frozen=True)
class StrengthLoss:
    """How far strengths have fallen.

    Attributes
    ----------
    done
        (m,) share D of the fall that is done.
    speed
        (m,) ``h / 2 G`` (1/Pa); 0 where nothing softens.
    """

    done: Floats
    speed: Floats

    @classmethod
    def none(cls, points: int) -> Self:
        """Return that of points that do not soften."""
        return cls(np.zeros(points), np.zeros(points))

    def at(self, points: Bools | Ints) -> Self:
        """Return that of some points."""
        return replace(self, done=self.done[points], speed=self.speed[points])


class ActingPlanes(Protocol):
    """Planes that act together, standing or turning."""

    @property
    def eased(self) -> float:
        """``dL . g`` (Pa) for strengths that fall by all of ``dL`` at one trial."""

    def returned(self, trial: Floats, weakening: StrengthLoss) -> tuple[Floats, Floats, Floats]:
        """Return stress (m, d), flow (m, p) and share of the fall (m,) where these planes act."""

    def tangent(self, trial: Floats, weakening: StrengthLoss, after: Floats) -> Floats:
        """Return the derivative (m, d, d), or (d, d) of all, of that stress by the trial's."""


@dataclass(frozen=True)
class Planes:
    """Planes that act together and stand.

    Attributes
    ----------
    keeps, back
        (d, d) and (d, p): the returned stress is ``keeps @ trial + back @ strength``.
    multiplier, inverse
        (p, d) and (p, p): the flow is ``multiplier @ trial - inverse @ strength``.
    strength, falls
        (p,) at first, and by how much it falls (Pa).
    """

    keeps: Floats
    back: Floats
    multiplier: Floats
    inverse: Floats
    strength: Floats
    falls: Floats

    @classmethod
    def of(cls, elastic: Floats, normals: Normals, strength: Floats, falls: Floats) -> Self:
        """Return planes of ``normals`` (p, d) each: of yield, and along which they flow."""
        normal, way = normals
        flow = elastic @ way.T
        inverse = np.asarray(np.linalg.inv(normal @ flow), dtype=float)
        back = flow @ inverse
        keeps = np.eye(len(elastic)) - back @ normal
        return cls(keeps, back, inverse @ normal, inverse, strength, falls)

    @cached_property
    def eased(self) -> float:
        """See `ActingPlanes.eased`."""
        return float(self.falls @ self.inverse @ self.falls)

    def returned(self, trial: Floats, weakening: StrengthLoss) -> tuple[Floats, Floats, Floats]:
        """See `ActingPlanes.returned`."""
        done = weakening.done
        if self.eased == 0:  # perfectly plastic
            flow = trial @ self.multiplier.T - self.inverse @ self.strength
            return trial @ self.keeps.T + self.back @ self.strength, flow, done
        flow = trial @ self.multiplier.T - self._strength(done) @ self.inverse.T
        after = np.minimum(done + flow @ self.falls * self._speed(weakening), 1.0)
        flow = flow + np.outer(after - done, self.inverse @ self.falls)
        return trial @ self.keeps.T + self._strength(after) @ self.back.T, flow, after

    def tangent(self, trial: Floats, weakening: StrengthLoss, after: Floats) -> Floats:
        """See `ActingPlanes.tangent`."""
        if self.eased == 0:
            return self.keeps
        speed = np.where(after < 1, self._speed(weakening), 0.0)
        falling = np.outer(self.back @ self.falls, self.falls @ self.multiplier)
        return np.asarray(self.keeps - speed[:, None, None] * falling)

    def _strength(self, done: Floats) -> Floats:
        return np.asarray(self.strength - np.outer(done, self.falls))

    def _speed(self, weakening: StrengthLoss) -> Floats:
        """By how much ``D`` grows with ``dL . g`` at the strengths of the start (m,), in 1/Pa."""
        return np.asarray(weakening.speed / (1 - weakening.speed * self.eased))


@dataclass(frozen=True)
class ReturnedStress:
    """Stress (m, 4: xx, yy, xy, zz), tangent (m, 3, 3), plastic strain (m, 4: xx, yy, 2 xy, zz).

    ``softened`` (m,) is the share of the fall of strengths that is done.
    """

    stress: Floats
    tangent: Floats
    plastic_strain: Floats
    softened: Floats

    def put(self, points: Bools | Ints, back: Self) -> None:
        """Put what points have returned to; its plastic strain is by how much theirs grows."""
        self.stress[points], self.tangent[points] = back.stress, back.tangent
        self.plastic_strain[points] += back.plastic_strain
        self.softened[points] = back.softened


def falling(strength: Floats, share: float) -> Floats:
    """Return by how much strengths (p,) fall in all that lose a share; infinite ones do not."""
    return np.asarray(share * np.where(np.isfinite(strength), strength, 0.0))


def largest_cell(sets: Sequence[ActingPlanes], energy: float) -> float:
    """Return the size (m) from which some set has no answer: it softens faster than it unloads."""
    eased = max(one.eased for one in sets)
    return 2 * energy / eased if eased > 0 else float("inf")


def return_to_planes(
    trial: Floats,
    sets: Sequence[ActingPlanes],
    weakening: StrengthLoss,
    beyond: Callable[[Floats, Floats], Floats],
    scale: tuple[float, Floats],
) -> tuple[Floats, Floats, Floats]:
    """Return stress (m, d), its derivative (m, d, d) by the trial's, and share of the fall (m,).

    Parameters
    ----------
    trial
        (m, d) stresses beyond the surface.
    beyond
        By how much (m,) stresses (m, d) exceed the surface at a share of the fall (m,), in Pa.
    scale
        Stiffness (Pa) that makes stresses of flow, and what (m,) rounding is a share of (Pa).
    """
    found, done = trial.copy(), weakening.done.copy()
    tangent = np.tile(np.eye(trial.shape[1]), (len(trial), 1, 1))
    least, (stiff, size) = np.full(len(trial), np.inf), scale
    at = np.arange(len(trial))
    for planes in sets:  # three to ten
        weak = weakening.at(at)
        stress, flow, after = planes.returned(trial[at], weak)
        wrong = np.maximum(beyond(stress, after), -stiff * flow.min(axis=1))
        better = wrong < least[at] - BEYOND * size[at]
        chosen = at[better]
        least[chosen], found[chosen], done[chosen] = wrong[better], stress[better], after[better]
        tangent[chosen] = planes.tangent(trial[chosen], weak.at(better), after[better])
        # Where nothing is exceeded and nothing flows backwards no other set is asked.
        at = at[least[at] > BEYOND * size[at]]
        if not len(at):
            break
    return found, tangent, done
