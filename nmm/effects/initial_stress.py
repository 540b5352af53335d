"""Stress in blocks at the start of a run, constant in each, turning with the material."""

from typing import Self

import numpy as np

from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.assembly.motion import State
from nmm.effects.base import Effect, Instant, Setup


class InitialStress(Effect):
    """Internal force ``- int B^T sigma0``; ``stress`` (E, 3) in body axes (Pa)."""

    name = "initial stress"

    def __init__(self, model: Model, stress: Floats) -> None:
        self.stress = stress
        self._force = -model.stress_load(stress)

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from ``[[initial_stresses]]``; later tables overwrite earlier ones."""
        region = setup.model.manifold.element_region
        stress = np.zeros((len(region), 3))
        for item in setup.scene.initial_stresses:  # a handful of tables
            regions = setup.regions(item.block)
            stress[slice(None) if regions is None else regions[region]] = item.stress
        return cls(setup.model, stress)

    def relaid(self, model: Model) -> Effect:
        """See `Effect.relaid`."""
        return InitialStress(model, self.stress)

    def force(self, state: State, end: Instant) -> Floats:
        """Return the constant internal force."""
        return self._force
