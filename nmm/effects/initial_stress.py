"""Stress in blocks at the start of a run, constant in each, turning with the material."""

from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, Self

import numpy as np

from integration.arrays import Floats, Ints
from nmm.assembly.matter import Matter
from nmm.assembly.model import Model
from nmm.assembly.motion import State
from nmm.effects.base import Effect, Instant, Setup

if TYPE_CHECKING:
    from nmm.effects.change import Change


class InitialStress(Effect):
    """Internal force ``- int B^T sigma0``; ``stress`` (E, 3) in body axes (Pa).

    With the elasticity ``D`` it stores ``1/2 sigma0 : D^-1 sigma0`` before anything moves, and
    ``sigma0 : eps`` more under a strain, so that strain energy is that of the whole stress.
    """

    name = "initial stress"
    external = False
    placed = False
    stays = True

    def __init__(self, model: Model, stress: Floats) -> None:
        self.stress = stress
        self._force = -model.stress_load(stress)
        self._model = model

    @cached_property
    def _stored(self) -> float:
        """Energy (J) of the stress before anything moves."""
        model, stress = self._model, self.stress
        strain = np.linalg.solve(model.elasticity, stress[:, :, None])[:, :, 0]
        density = np.einsum("ei,ei->e", stress, strain) / 2
        return float(density @ (model.element_area * model.thickness))

    @property
    def with_axes(self) -> str:
        """See `Effect.with_axes`."""
        return "a stress at the start"

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from ``[[initial_stresses]]``; later tables overwrite earlier ones."""
        region = setup.model.manifold.element_region
        stress = np.zeros((len(region), 3))
        for item in setup.scene.initial_stresses:  # a handful of tables
            regions = setup.regions(item.block)
            stress[slice(None) if regions is None else regions[region]] = item.stress
        return cls(setup.model, stress)

    def follow(self, change: "Change") -> Effect:
        """Return the stress of each element from those that it comes from; else as declared."""
        declared = InitialStress.from_setup(change.setup).stress
        return InitialStress(change.new, change.parentage.elements.mean(self.stress, declared))

    def begin(self, state: State) -> State:
        """Return the start with material points that know of the stress."""
        matter = self._model.matter
        if matter is None:
            return state
        assert isinstance(matter, Matter)  # finite strain refuses the effect
        return replace(state, history=matter.prestressed(state.history, self.stress))

    def force(self, state: State, end: Instant) -> Floats:
        """Return the constant internal force."""
        return self._force

    def mean_stress(self, state: State) -> Floats:
        """See `Effect.mean_stress`."""
        return self.stress

    def stress_at(self, elements: Ints, points: Floats, time: float) -> Floats:
        """See `Effect.stress_at`."""
        return np.asarray(self.stress[elements])

    def energy(self, state: State) -> float:
        """Energy (J) that the stress adds to that of the strain, ``1/2 eps : D eps``."""
        return self._stored - float(self._force @ state.deformation)
