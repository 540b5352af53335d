"""Body forces of constant density in blocks."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Self

import numpy as np

from integration.arrays import Floats
from nmm.assembly.applied_forces import AppliedForces
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.effects.base import Effect, Instant, Setup
from nmm.effects.loading.dead_loads import DeadLoad
from nmm.effects.loading.load_factor import load_factor


@dataclass(frozen=True)
class BodyLoad:
    """One load: density (E, 2) at factor 1 (N/m3), factor, and whether it is steady."""

    density: Floats
    factor: Callable[[Instant], float]
    steady: bool = True


class BodyLoads(Effect):
    """All body loads of a scene: dead loads, whose direction is fixed while bodies turn."""

    name = "body loads"
    placed = False

    def __init__(self, model: Model, loads: list[BodyLoad]) -> None:
        self._model = model
        self._loads = loads

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from the ``[[loads]]`` of kind "body"."""
        region = setup.model.manifold.element_region
        found = []
        for load in setup.scene.loads:  # a handful of loads
            if load.density is not None:
                regions = setup.regions(load.block)
                inside = np.ones(len(region)) if regions is None else regions[region] * 1.0
                density = inside[:, None] * np.array(load.density)
                factor = load_factor(setup, load)
                found.append(BodyLoad(density, factor, load.history is None))
        return cls(setup.model, found)

    def force(self, state: State, end: Instant) -> Floats:
        """Return the load vector (n,) in the axes of the bodies."""
        return self._push(state, self._density(end))

    def work(self, before: State, after: State) -> float:
        """Work (J) of the mean of the loads at both ends of the step."""
        ends = (Instant.of(state) for state in (before, after))
        mean = np.asarray(sum(self._density(end) for end in ends) / 2)
        pushed = self._push(before, mean), self._push(after, mean)
        return DeadLoad(self._model, mean).work(before, after, pushed)

    def applied_forces(self, state: State) -> AppliedForces:
        density = self._density(Instant.of(state))
        return AppliedForces.of_densities(lambda elements, points: density[elements])

    @property
    def dead(self) -> bool:
        return True

    @property
    def steady(self) -> bool:
        return all(load.steady for load in self._loads)

    def _push(self, state: State, density: Floats) -> Floats:
        """Load vector (n,) of a density (E, 2) in global axes, in the axes of the bodies."""
        body = self._model.manifold.element_body
        return self._model.body_load(state.frames.to_body(body, density))

    def _density(self, end: Instant) -> Floats:
        return np.asarray(np.sum([load.factor(end) * load.density for load in self._loads], axis=0))
