"""Intensity factors at the tips of fronts under everything that acts on the material about them."""

from collections.abc import Sequence
from functools import cached_property

import numpy as np

from integration.arrays import Floats, Ints
from nmm.assembly.applied_forces import AppliedForces, AppliedForcesIn, joined
from nmm.assembly.motion import State
from nmm.assembly.stress_points import StressAt
from nmm.effects.base import Setup
from nmm.fracture.growth.rule import GrowthRule
from nmm.fracture.growth.tips.intensities import Intensities, tip_moduli
from nmm.fracture.growth.tips.loaded_tips import loaded_tips
from nmm.fracture.intensity_rows import IntensityRows
from nmm.fracture.stress_intensity import check_domain
from nmm.fracture.surroundings import domain_radius


class MeasuredTips:
    """Computes the intensity factors at the tips of fronts; those of the last state are cached.

    Parameters
    ----------
    tips
        (f,) number of the tip of each front in the cut; -1 without a tip.
    radius
        Radius of the domains (m); None for four cells.

    Attributes
    ----------
    front, tip
        (k,) the fronts that have a tip, and their tips.
    stresses, forces
        Stresses and forces that other effects add.
    """

    def __init__(self, setup: Setup, rule: GrowthRule, tips: Ints, radius: float | None) -> None:
        self._model, self._rule, self._gravity = setup.model, rule, setup.scene.gravity
        self._size, self._asked = setup.formulation.cover.size, radius
        self.front = np.flatnonzero(tips >= 0)
        self.tip = tips[self.front]
        self.stresses: Sequence[StressAt] = ()
        self.forces: Sequence[AppliedForcesIn] = ()
        self.forget()

    def forget(self) -> None:
        """Drop the cached intensity factors."""
        self._known: tuple[Floats, Intensities] | None = None

    def in_state(self, state: State) -> Intensities:
        """Return the intensity factors in a state."""
        if self._known is None or self._known[0] is not state.deformation:
            self._known = state.deformation, self._found(state)
        return self._known[1]

    def loaded_tips(self, state: State) -> Intensities:
        """Return the intensity factors of the loaded tips alone."""
        found = self.in_state(state)
        given = self._model, state, self.stresses, found.tip, found.kink.equivalent
        return found.take(loaded_tips(*given, self._radius))

    def applied_forces(self, state: State) -> AppliedForces:
        """Return the forces of other effects on crack faces and within bodies."""
        return joined(force(state) for force in self.forces)

    def _found(self, state: State) -> Intensities:
        kappa, stiff = self._moduli
        pressure, pushes = self._model.pressure(state.deformation), self.applied_forces(state)
        at_tips = [self._at(rows, state, pressure, pushes) for rows in self._rows]
        opening, sliding = np.reshape(at_tips, (-1, 2)).T
        kink = self._rule.criterion.kink(opening, sliding, kappa)
        share = self._rule.toughness_ratios(kink, stiff)
        return Intensities(self.front, self.tip, opening, sliding, stiff, kink, share)

    @property
    def _radius(self) -> float:
        if self._asked is not None:
            return self._asked
        assert self._size is not None  # of meshes
        return 4 * self._size

    @property
    def _moduli(self) -> tuple[Floats, Floats]:
        return tip_moduli(self._model, self._model.cut.tips.element[self.tip])

    @cached_property
    def _rows(self) -> list[IntensityRows]:
        """The functionals that give the intensity factors of each tip."""
        found, cut = [], self._model.cut
        for one, kappa in zip(self.tip, self._moduli[0], strict=True):  # a handful of tips
            radius = domain_radius(cut, int(one), self._radius)
            check_domain(cut, int(one), radius)
            found.append(IntensityRows.of(self._model, int(one), radius, float(kappa)))
        return found

    def _at(
        self, rows: IntensityRows, state: State, pressure: Floats | None, pushes: AppliedForces
    ) -> Floats:
        """K_I and K_II (2,) of a tip in a state (Pa m^1/2)."""
        found = rows.intensities(state.deformation, pressure) + rows.of_applied_forces(
            pushes, state.frames
        )
        for stress in self.stresses:  # of effects
            found = found + rows.of_stress(stress, state.time)
        if self._gravity is not None:
            body, down = np.array([rows.body]), np.array([self._gravity.acceleration])
            found = found + rows.of_weight(rows.density * state.frames.to_body(body, down)[0])
        return found
