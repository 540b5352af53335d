"""Stress in blocks at the start of a run, constant in each, turning with the material."""

from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, Self

import numpy as np

from integration.arrays import Floats, Ints
from nmm.assembly.matter import Matter
from nmm.assembly.model import Model
from nmm.assembly.motion import State
from nmm.effects.base import Effect, Instant, Setup, Span, StepForce

if TYPE_CHECKING:
    from nmm.effects.change import Change
    from nmm.effects.turning_stress import TurningStress


class InitialStress(Effect):
    """Internal force ``- int B^T sigma0``; ``stress`` (E, 3) in body axes (Pa).

    With the elasticity ``D`` it stores ``1/2 sigma0 : D^-1 sigma0`` before anything moves, and
    ``sigma0 : eps`` more under a strain, so that strain energy is that of the whole stress.
    """

    name = "initial stress"
    external = False
    placed = False
    stays = True

    def __init__(
        self,
        model: Model,
        stress: Floats,
        turned: "TurningStress | None" = None,
        across: Floats | None = None,
    ) -> None:
        self.stress, self._turned, self._across = stress, turned, across
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
    def bends(self) -> bool:
        """See `Effect.bends`: it does in bodies that bend by any angle."""
        return self._turned is not None

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from ``[[initial_stresses]]``; later tables overwrite earlier ones."""
        region = setup.model.manifold.element_region
        stress, across = np.zeros((len(region), 3)), np.full(len(region), np.nan)
        for item in setup.scene.initial_stresses:  # a handful of tables
            regions = setup.regions(item.block)
            chosen = slice(None) if regions is None else regions[region]
            stress[chosen], across[chosen] = (
                item.stress,
                np.nan if item.across is None else item.across,
            )
        return cls(setup.model, stress, _turned(setup, stress), across)

    def follow(self, change: "Change") -> Effect:
        """Return the stress of each element from those that it comes from; else as declared."""
        declared = InitialStress.from_setup(change.setup).stress
        stress = change.parentage.elements.mean(self.stress, declared)
        return InitialStress(change.new, stress, _turned(change.setup, stress))

    def begin(self, state: State) -> State:
        """Return the start with material points that know of the stress."""
        matter = self._model.matter
        if not isinstance(matter, Matter):
            return state
        history = matter.prestressed(state.history, self.stress, self._across)
        return replace(state, history=history)

    def force(self, state: State, end: Instant) -> Floats:
        """Return the internal force, which is constant where bodies have axes that turn."""
        return self._force if self._turned is None else self._turned.force(state, end)

    def through(self, before: State, after: State, span: Span) -> StepForce:
        """See `Effect.through`."""
        assert self._turned is not None
        return self._turned.through(before, after, span)

    def mean_stress(self, state: State) -> Floats:
        """See `Effect.mean_stress`."""
        return self.stress if self._turned is None else self._turned.mean(state)

    def stress_at(self, elements: Ints, points: Floats, time: float) -> Floats:
        """See `Effect.stress_at`."""
        return np.asarray(self.stress[elements])

    def energy(self, state: State) -> float:
        """Energy (J) that the stress adds to that of the strain, ``1/2 eps : D eps``."""
        if self._turned is not None:
            return self._stored + self._turned.energy(state)
        return self._stored - float(self._force @ state.deformation)


def _turned(setup: Setup, stress: Floats) -> "TurningStress | None":
    """Return the stress (E, 3) at the points of bodies that bend by any angle; None of others."""
    if not setup.kinematics.finite:
        return None
    from nmm.assembly.finite_strain.finite_matter import FiniteMatter
    from nmm.assembly.finite_strain.given_stress import GivenStress
    from nmm.effects.turning_stress import TurningStress

    matter = setup.model.matter
    assert isinstance(matter, FiniteMatter)
    at_points = stress[matter.points.rule.owner]
    return TurningStress(GivenStress(matter), lambda time: at_points)
