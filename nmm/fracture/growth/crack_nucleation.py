"""Nucleation of cracks by the rule of a scene: where the next one begins, and the event for it."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from integration.rules import PointRule
from nmm.assembly.state import State
from nmm.assembly.stress_points import PressureAt, StressAt
from nmm.effects.base import Setup
from nmm.effects.event import Event
from nmm.fracture.acting_stress import acting_stress
from nmm.fracture.growth.refusals import refuse_nucleation, short_nuclei
from nmm.fracture.growth.rule import ROUNDING
from nmm.fracture.growth.tips.intensities import tip_moduli
from nmm.fracture.toughness import Toughness
from nmm.materials.tensors import ISOTROPIC

if TYPE_CHECKING:
    from nmm.fracture.nucleation.nuclei import Nuclei, Nucleus
    from nmm.fracture.nucleation.rule import NucleationRule


class CrackNucleation:
    """Nucleation in the geometry of a setup; inactive where its scene has no rule for it."""

    def __init__(self, setup: Setup, toughness: Toughness) -> None:
        self._setup = setup
        self._rule, self._nuclei = _places(setup, toughness)
        self._known: tuple[Floats, Nucleus | None] | None = None
        self._stresses: Sequence[StressAt] = ()
        self._pores: Sequence[PressureAt] = ()

    def refuse(self) -> None:
        """Raise what `refuse_nucleation` raises."""
        if self._nuclei is not None:
            refuse_nucleation(self._setup, self._nuclei)

    @property
    def about(self) -> str:
        """How cracks nucleate, in words."""
        if self._rule is None:
            return ""
        strength = f"{self._rule.strength:g} Pa"
        if self._rule.crack_length is None:
            return f"; cracks begin where the mean stress is {strength} and energy suffices"
        return (
            f"; cracks of {self._rule.crack_length:g} m begin where the mean stress over "
            f"{self._rule.length:g} m is {strength}"
        )

    @property
    def caution(self) -> str:
        """A warning about nuclei that are too short, in words; empty where there is none."""
        return "" if self._rule is None else short_nuclei(self._setup, self._rule)

    def receive_stresses(self, stresses: Sequence[StressAt]) -> None:
        """See `Effect.receive_stresses`."""
        self._stresses = stresses

    def receive_pore_pressures(self, pressures: Sequence[PressureAt]) -> None:
        """See `Effect.receive_pore_pressures`."""
        self._pores = pressures

    def next(self, state: State) -> "Nucleus | None":
        """Return the place that is nearest to nucleation; cached for the last state."""
        if self._nuclei is None:
            return None
        if self._known is None or self._known[0] is not state.deformation:
            self._known = state.deformation, self._nuclei.nearest(partial(self._opening, state))
        return self._known[1]

    def unopened_strength_ratio(self, state: State) -> float:
        """Largest stress over strength where no line for a nucleus fits into a body; else 0."""
        if self._nuclei is None or self.next(state) is not None:
            return 0.0
        return self._nuclei.largest(partial(self._opening, state))

    def _opening(self, state: State, rule: PointRule) -> Floats:
        """Return the stresses (Q, 3) that open cracks, effective or total by the rule (Pa).

        The tensile strength is reached by the total stress plus the whole pore pressure, whatever
        Biot's coefficient is (Jaeger, Cook and Zimmerman 2007, section 6.4).
        """
        assert self._rule is not None
        found = acting_stress(self._setup.model, state, self._stresses, rule)
        if self._rule.effective:
            for pressure in self._pores:  # of effects
                found = found + ISOTROPIC * pressure(rule.owner, rule.points, state.time)[:, None]
        return found

    def event(self, state: State, continuous: bool) -> Event | None:
        """Return the event of a new crack where the criterion is met; else None."""
        nucleus = self.next(state)
        if nucleus is None or nucleus.share < 1 - ROUNDING:
            return None
        assert self._nuclei is not None
        geometry, (x, y) = self._setup.geometry, nucleus.point + self._setup.origin
        number, line = len(geometry.cracks), self._nuclei.line_of(nucleus)
        laid = replace(geometry, cracks=(*geometry.cracks, line), nuclei=(*geometry.nuclei, number))
        return Event(laid, f"a crack began at [{x:.6g}, {y:.6g}]", continuous=continuous)

    def history(self, state: State) -> Mapping[str, float]:
        """Return the largest ratio to the strength and its place (m), for the history."""
        nucleus = self.next(state)
        if nucleus is None:
            return {}
        x, y = nucleus.point + self._setup.origin
        return {"nucleation:share": nucleus.share, "nucleation:x": x, "nucleation:y": y}

    def forget(self) -> None:
        """Drop what is cached for the last state."""
        self._known = None


def _places(setup: Setup, toughness: Toughness) -> "tuple[NucleationRule | None, Nuclei | None]":
    """Return the rule of a scene, and the places where cracks may nucleate; None without."""
    table = setup.scene.fracture
    if table is None or table.nucleation is None:
        return None, None
    from nmm.fracture.nucleation.nuclei import Nuclei
    from nmm.fracture.nucleation.rule import NucleationRule

    model, geometry = setup.model, setup.geometry
    _, stiff = tip_moduli(model, np.arange(len(model.manifold.elements)))
    rule = NucleationRule.of(table.nucleation, toughness, stiff)
    return rule, Nuclei.of(model, geometry, rule) if len(
        geometry.nuclei
    ) < rule.max_number else None
