"""Intensity factors at the tips of fronts under everything that acts on the material about them."""

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np

from integration.arrays import Floats, Ints
from nmm.assembly.applied_forces import AppliedForces, AppliedForcesIn, joined
from nmm.assembly.state import State
from nmm.assembly.stress_points import StressAt
from nmm.effects.base import Setup
from nmm.fracture.growth.rule import GrowthRule
from nmm.fracture.growth.tips.coarse_domains import coarse_domains
from nmm.fracture.growth.tips.intensities import Intensities, tip_moduli
from nmm.fracture.growth.tips.loaded_tips import loaded_tips
from nmm.fracture.growth.tips.parallel_stress import kink_without_end_shear, parallel_stress
from nmm.fracture.intensity_rows import IntensityRows
from nmm.fracture.stress_intensity import check_domain
from nmm.fracture.surroundings import domain_radius

CELLS = 4.0
"""Radius of a domain in cells about its tip."""


class MeasuredTips:
    """Computes the intensity factors at the tips of fronts; those of the last state are cached.

    Parameters
    ----------
    tips
        (f,) number of the tip of each front in the cut; -1 without a tip.
    radius
        Radius of the domains (m); None for four of the cells that each tip lies in.

    Attributes
    ----------
    front, tip
        (k,) the fronts that have a tip, and their tips.
    stresses, forces
        Stresses and forces that other effects add.
    """

    def __init__(self, setup: Setup, rule: GrowthRule, tips: Ints, radius: float | None) -> None:
        self._model, self._rule, self._gravity = setup.model, rule, setup.scene.gravity
        self._asked, self._origin = radius, setup.origin
        self.front = np.flatnonzero(tips >= 0)
        self.tip = tips[self.front]
        self.stresses: Sequence[StressAt] = ()
        self.forces: Sequence[AppliedForcesIn] = ()
        self.forget()

    def forget(self) -> None:
        """Drop the cached intensity factors."""
        self._known: tuple[Floats, Intensities] | None = None

    @property
    def caution(self) -> str:
        """What is known to spoil intensities; empty where nothing is."""
        return coarse_domains(self._model.cut, self.tip, self._radii, self._origin)

    def in_state(self, state: State) -> Intensities:
        """Return the intensity factors in a state."""
        if self._known is None or self._known[0] is not state.deformation:
            self._known = state.deformation, self._found(state)
        return self._known[1]

    def loaded_tips(self, state: State) -> Intensities:
        """Return the intensity factors of the loaded tips alone."""
        found = self.in_state(state)
        given = self._model, state, self.stresses, found.tip, found.kink.equivalent
        return found.take(loaded_tips(*given, self._radii))

    def applied_forces(self, state: State) -> AppliedForces:
        """Return the forces of other effects on crack faces and within bodies."""
        return joined(force(state) for force in self.forces)

    def with_parallel_stress(self, found: Intensities, state: State) -> Intensities:
        """Return fronts with kinks corrected for the stress along the crack."""
        piece, kink = self._rule.increment, found.kink
        acting = self.applied_forces(state), self.stresses
        stress = parallel_stress(self._model, state, found.tip, piece / 2, *acting)
        angle = kink_without_end_shear(kink.angle, found.opening, found.sliding, stress, piece)
        return replace(found, kink=replace(kink, angle=angle))

    def _found(self, state: State) -> Intensities:
        kappa, stiff = self._moduli
        pressure, pushes = self._model.pressure(state.deformation), self.applied_forces(state)
        at_tips = [self._at(rows, state, pressure, pushes) for rows in self._rows]
        opening, sliding = np.reshape(at_tips, (-1, 2)).T
        kink = self._rule.criterion.kink(opening, sliding, kappa)
        share = self._rule.toughness_ratios(kink, stiff)
        return Intensities(self.front, self.tip, opening, sliding, stiff, kink, share)

    @cached_property
    def _radii(self) -> Floats:
        """Radius (k,) of the domain about each tip (m)."""
        cut, cells = self._model.cut, CELLS * self._model.cut.tip_cell_width[self.tip]
        wanted = cells if self._asked is None else np.full(len(self.tip), self._asked)
        pairs = zip(self.tip.tolist(), wanted.tolist(), strict=True)  # a handful of tips
        return np.array([domain_radius(cut, *pair) for pair in pairs])

    @property
    def _moduli(self) -> tuple[Floats, Floats]:
        return tip_moduli(self._model, self._model.cut.tips.element[self.tip])

    @cached_property
    def _rows(self) -> list[IntensityRows]:
        """The functionals that give the intensity factors of each tip."""
        found, cut = [], self._model.cut
        kappa = self._moduli[0].tolist()
        each = zip(self.tip.tolist(), self._radii.tolist(), kappa, strict=True)
        for tip, radius, constant in each:  # a handful of tips
            check_domain(cut, tip, radius)
            found.append(IntensityRows.of(self._model, tip, radius, constant))
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
