"""The effect: dead loads at points and along edges."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import numpy as np

from integration.arrays import Floats
from nmm.assembly.applied_forces import AppliedForces, joined
from nmm.assembly.model import Model
from nmm.assembly.places import Place
from nmm.assembly.state import State
from nmm.effects.acting_place import acting_place, traction_order
from nmm.effects.base import Effect, Instant, Setup
from nmm.effects.loading.load_factor import load_factor

if TYPE_CHECKING:
    from nmm.scene.tables.loading.loads import LoadTable as SceneLoad

LEAST_ORDER = 4
"""Least degree of the quadrature of tractions along an edge."""


@dataclass(frozen=True)
class Load:
    """One load on points of the material.

    Attributes
    ----------
    name
        Name in the scene.
    place
        The m points on which it acts.
    force
        (m, 2) force on each point at factor 1 (N).
    factor
        Load factor as a function of the instant.
    steady
        Whether it is constant in time.
    """

    name: str
    place: Place
    force: Floats
    factor: Callable[[Instant], float]
    steady: bool = True

    def resultant(self, end: Instant) -> Floats:
        """Resultant (2,) at an instant (N)."""
        return np.asarray(self.factor(end) * self.force.sum(axis=0))


class Loads(Effect):
    """All point and edge loads of a scene."""

    name = "loads"

    def __init__(self, loads: list[Load], model: Model) -> None:
        self.loads, self._model = loads, model

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from the ``[[loads]]`` with forces at points and tractions along edges."""
        dead = [one for one in setup.scene.loads if one.force or one.traction]
        found = [_load(setup, load) for load in dead if load.kind != "moving"]
        return cls(found, setup.model)

    def force(self, state: State, end: Instant) -> Floats:
        """Return the load vector (n,) in the axes of the bodies."""
        total = np.zeros(len(state.deformation))
        for load in self.loads:  # a handful of loads
            total += load.place.points.push(state, load.factor(end) * load.force)
        return total

    def applied_forces(self, state: State) -> AppliedForces:
        felt = [one for one in self.loads if AppliedForces.counts(self._model, one.place)]
        factors = (load.factor(Instant.of(state)) for load in felt)
        pairs = zip(felt, factors, strict=True)
        return joined(AppliedForces.on(self._model, one.place, f * one.force) for one, f in pairs)

    def work(self, before: State, after: State) -> float:
        """Work (J) of the mean of the loads at both ends of the step."""
        start, end = Instant.of(before), Instant.of(after)
        total = 0.0
        for load in self.loads:
            mean = (load.factor(start) + load.factor(end)) / 2
            total += mean * load.place.points.work(before, after, load.force)
        return total

    @property
    def dead(self) -> bool:
        return True

    @property
    def steady(self) -> bool:
        return all(load.steady for load in self.loads)

    def scaled_resultant(self, factor: float) -> float:
        """Magnitude of the change of the resultant from load factor 0 to ``factor`` (N)."""
        gain = np.zeros(2)
        for load in self.loads:
            gain += load.resultant(Instant(factor, factor))
            gain -= load.resultant(Instant(factor, 0.0))
        return float(np.hypot(*gain))


def _load(setup: Setup, load: "SceneLoad") -> Load:
    if load.kind == "point":
        order, total = LEAST_ORDER, np.array(load.force)
    else:
        # The work of a uniform traction has the degree of the displacements.
        order = traction_order(setup, max(LEAST_ORDER, setup.model.manifold.degree))
        total = np.array(load.traction) * setup.model.thickness
    place = acting_place(setup, "loads", load, order)
    force, factor = place.weight[:, None] * total, load_factor(setup, load)
    return Load(load.name, place, force, factor, load.history is None)
