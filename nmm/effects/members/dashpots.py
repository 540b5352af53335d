"""The effect: dashpots between points of blocks, or a point and the ground."""

from typing import Self

import numpy as np
from scipy.sparse import csc_array, csr_array, diags_array

from integration.arrays import Floats
from nmm.assembly.applied_forces import AppliedForces, joined
from nmm.assembly.kept import forget_kept, kept_of_object
from nmm.assembly.state import State
from nmm.effects.base import Effect, Setup, Span, StepForce
from nmm.effects.members.ends import ends_of
from nmm.effects.members.kept_matrix import LIKE, KeptMatrix
from nmm.effects.members.links import Links
from nmm.quantity import MemberSegments

NOTHING = np.zeros(1)


class PointDashpots(Effect):
    """All ``[[dashpots]]`` of a scene: axial forces ``c`` times the elongation rate of the step.

    Zero in statics.
    """

    name = "dashpots"

    def __init__(
        self, setup: Setup, names: tuple[str, ...], links: Links, viscosity: Floats
    ) -> None:
        self.names, self.links, self.viscosity = names, links, viscosity
        self.external = links.grounded
        self._model = setup.model
        self._kept = KeptMatrix(setup)

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from the ``[[dashpots]]``."""
        dashpots = setup.scene.dashpots
        links = Links.of(*ends_of(setup, "dashpots", dashpots), setup.small)
        viscosity = np.array([one.viscosity for one in dashpots])
        return cls(setup, tuple(one.name for one in dashpots), links, viscosity)

    def step_force(self, before: State, after: State, span: Span) -> StepForce:
        n = len(before.deformation)
        if span.step is None:
            none = np.zeros(len(self.links))
            return StepForce(np.zeros(n), lambda: csc_array((n, n)), self._remembered(none))
        force = self._mean(before, after)
        lines = self.links.mean_lines(before, after)
        pull = self.links.pull(before, lines, force)
        pull += self.links.moment_correction(self._model, before, after, lines, force)
        tangent = self.viscosity / span.step

        def made() -> csc_array:
            whole = csr_array(diags_array(tangent))
            return self.links.stiffness(before, lines, whole, force)

        def stiffness() -> csc_array:
            made_of = self._kept.parts(self.links, before, lines, force, tangent)
            return self._kept.of(made_of, 0.0 if self.links.small else LIKE, made)

        return StepForce(pull, stiffness, self._remembered(force))

    def loss(self, before: State, after: State) -> float:
        return float(self._mean(before, after) @ self._elongation(before, after))

    def work_correction(self, before: State, after: State, increment: Floats, span: Span) -> float:
        """Work (J) that its tangent takes, of which nothing is stored: all of it is its `loss`."""
        return self.loss(before, after) / span.weight

    def applied_forces(self, state: State) -> AppliedForces:
        """See `Effect.applied_forces`: those of the step that ended at the state."""
        pull = self._last(state)[:, None] * self.links.lines(state).along
        return joined([self.links.first.pushed(pull), self.links.second.pushed(-pull)])

    def forget(self) -> None:
        forget_kept(self)
        self._kept.forget()

    def history(self, state: State) -> dict[str, float]:
        """Return the force of each in the last step (N)."""
        pairs = zip(self.names, self._last(state), strict=True)
        return {f"{name}:force": float(force) for name, force in pairs}

    def segments(self, state: State) -> MemberSegments:
        owner, slip = np.arange(len(self.names)), np.zeros(len(self.names))
        return MemberSegments(self.links.place(state), owner, self.names, self._last(state), slip)

    def _last(self, state: State) -> Floats:
        """Force (m,) of the step that ended at a state (N)."""
        return np.array([float(state.memory.get(name, NOTHING)[0]) for name in self.names])

    def _remembered(self, force: Floats) -> dict[str, Floats]:
        return {name: force[at : at + 1] for at, name in enumerate(self.names)}

    def _elongation(self, before: State, after: State) -> Floats:
        return self._stretch(after) - self._stretch(before)

    @kept_of_object
    def _stretch(self, state: State) -> Floats:
        return self.links.stretch(state)

    def _mean(self, before: State, after: State) -> Floats:
        """Force (m,) of a step (N); zero if it has no duration."""
        step = after.time - before.time
        rate = self._elongation(before, after) / step if step > 0 else np.zeros(len(self.links))
        return np.asarray(self.viscosity * rate)
