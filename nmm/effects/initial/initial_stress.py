"""The effect: initial stress of blocks, which turns with the material."""

from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING, Self

import numpy as np

from integration.arrays import Floats, Ints
from nmm.assembly.matter import Matter
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.effects.base import Effect, Instant, Setup, Span, StepForce
from nmm.effects.initial.stress_at_start import StressAtStart

if TYPE_CHECKING:
    from nmm.effects.change import Change
    from nmm.effects.initial.turning_stress import TurningStress


class InitialStress(Effect):
    """Force ``- int B^T sigma0`` of the initial stress ``given`` in body axes.

    Its energy is ``1/2 sigma0 : D^-1 sigma0 + sigma0 : eps``, with the elasticity ``D`` and the
    strain ``eps``, so that the strain energy is that of the total stress.
    """

    name = "initial stress"
    external = False
    placed = False
    stays = True

    _turned: "TurningStress | None" = None

    def __init__(self, model: Model, given: StressAtStart, finite: bool = False) -> None:
        self.given, self._model = given, model
        self._force = -given.force(model)
        if finite:
            from nmm.effects.initial.turning_stress import TurningStress

            self._turned = TurningStress.of(model, self.stress_at, constant=True)

    @property
    def stress(self) -> Floats:
        """Mean stress (E, 3) of the elements in body axes (Pa)."""
        return self.given.mean[:, :3]

    @cached_property
    def _stored(self) -> float:
        """Energy (J) of the stress without strain."""
        return self.given.energy(self._model)

    @property
    def caution(self) -> str:
        """See `Effect.caution`: matter above the surface that its stress counts from."""
        height, pull = self.given.tension(self._model)
        if not height:
            return ""
        return (
            f"matter reaches {height:.3g} m above where the stress by depth is zero, and begins "
            f"there under a tension of up to {pull:.3g} Pa; name the blocks below by block, or "
            "raise surface"
        )

    @property
    def nonlinear(self) -> bool:
        """See `Effect.nonlinear`: true in finite strain."""
        return self._turned is not None

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from ``[[initial_stresses]]``; later tables overwrite earlier ones."""
        return cls(setup.model, StressAtStart.declared(setup), setup.kinematics.finite)

    def follow(self, change: "Change") -> Effect:
        """Return the stress of each element from its parents; as declared where it has none."""
        given = StressAtStart.declared(change.setup)
        if given.even and self.given.even:
            mean = given.mean.copy()
            mean[:, :3] = change.parentage.elements.mean(self.stress, mean[:, :3])
            given = replace(given, mean=mean)
        return InitialStress(change.new, given, change.setup.kinematics.finite)

    def begin(self, state: State) -> State:
        """Return the state with the stress in the history of material points."""
        matter = self._model.matter
        if not isinstance(matter, Matter):
            return state
        rule = matter.points.rule
        at_points = self.given.at(self._model, rule.owner, rule.points)
        history = matter.prestressed(state.history, at_points[:, :3], at_points[:, 3])
        return replace(state, history=history)

    def force(self, state: State, end: Instant) -> Floats:
        """Return the force (n,), which is constant in the axes of bodies."""
        return self._force if self._turned is None else self._turned.force(state, end)

    def step_force(self, before: State, after: State, span: Span) -> StepForce:
        assert self._turned is not None
        return self._turned.step_force(before, after, span)

    def mean_stress(self, state: State) -> Floats:
        return self.stress if self._turned is None else self._turned.mean(state)

    def stress_at(self, elements: Ints, points: Floats, time: float) -> Floats:
        return self.given.at(self._model, elements, points)[:, :3]

    def mean_stress_across(self, state: State) -> Floats:
        """See `Effect.mean_stress_across`; laws that are not linear know of it themselves."""
        found = self._across(self.given.mean, self._model.across_share)
        found = np.where(self._model.remembers, 0.0, found)
        if self._turned is None:
            return found
        return np.asarray(found / self._model.finite_matter.mean_volume(state.deformation))

    def stress_across_at(self, elements: Ints, points: Floats, time: float) -> Floats:
        given, share = self.given.at(self._model, elements, points), self._model.across_share
        found = self._across(given, share[elements])
        return np.where(self._model.remembers[elements], 0.0, found)

    @staticmethod
    def _across(given: Floats, share: Floats) -> Floats:
        """Stress across (m,) of stresses (m, 4); the elastic one where it is not given."""
        elastic = np.einsum("mi,mi->m", share, given[:, :3])
        return np.where(np.isnan(given[:, 3]), elastic, given[:, 3])

    def energy(self, state: State) -> float:
        """Energy (J) that the stress adds to the elastic one, ``1/2 eps : D eps``."""
        if self._turned is not None:
            return self._stored + self._turned.energy(state)
        return self._stored - float(self._force @ state.deformation)
