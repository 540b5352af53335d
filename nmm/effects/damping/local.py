"""Local non-viscous damping as a change of mass (Cundall 1987).

Cundall's force on a mass is ``-alpha |F| sgn(v)``, with the out-of-balance force ``F``. So
``m a = (1 - alpha s) F``, where ``s`` is the sign of ``F v``: a mass of ``m / (1 - alpha s)``.
Here the masses are those of elements, and of ``[[masses]]`` on a body. The sign is that of the
power of their inertia, which does not depend on the choice of unknowns, so that energy is
dissipated in each.
"""

from typing import Self

import numpy as np
from scipy.sparse import csc_array, diags_array

from integration.arrays import Floats
from nmm.assembly.elements import element_matrices
from nmm.assembly.elements.blocks import Part, assemble
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.effects.base import Effect, Setup


class LocalDamping(Effect):
    """Mass of elements that is larger while they accelerate and smaller while they decelerate.

    Every half cycle, at any frequency, multiplies the amplitude by
    ``sqrt((1 - alpha) / (1 + alpha))``, and the period grows. A body in free fall accelerates by
    ``1 - alpha`` of gravity.
    """

    name = "local damping"
    placed = False

    def __init__(self, model: Model, share: float) -> None:
        self._share, self._manifold = share, model.manifold
        element = element_matrices.lumped_mass if model.lumped else element_matrices.mass
        density = model.thickness * model.density
        self._masses = [
            element(group, group.shape, density[group.elements])
            for group in model.manifold.groups  # a handful of groups
        ]
        self._points, self._body = model.point_mass, model.manifold.unknown_body
        self._kept: tuple[Floats, csc_array] | None = None

    @classmethod
    def from_setup(cls, setup: Setup) -> Self:
        """Build from ``[damping]``."""
        assert setup.scene.damping is not None
        assert setup.scene.damping.local is not None
        return cls(setup.model, setup.scene.damping.local)

    @property
    def about(self) -> str:
        return f"{self._share:g} of what is out of balance, free fall included"

    def added_mass(self, state: State) -> csc_array:
        """Return the change of the mass (n, n) by the signs at the start of the step."""
        power = np.concatenate([self.power(state), self._power_of_points(state)])
        more = 1 / (1 - self._share * np.sign(power)) - 1
        if self._kept is None or not np.array_equal(self._kept[0], more):
            self._kept = more, self._matrix(more)
        return self._kept[1]

    def power(self, state: State) -> Floats:
        """Return the power (E,) of the inertia of each element (W)."""
        found = np.zeros(len(self._manifold.element_body))
        for group, masses in zip(self._manifold.groups, self._masses, strict=True):
            velocity, acceleration = (
                v[group.unknowns] for v in (state.velocity, state.acceleration)
            )
            found[group.elements] = np.einsum("nl,nlm,nm->n", velocity, masses, acceleration)
        return found

    def _power_of_points(self, state: State) -> Floats:
        """Return the power (B,) of the inertia of point masses on each body (W)."""
        if self._points is None:
            return np.zeros(0)
        given = state.velocity * (self._points @ state.acceleration)
        found = np.bincount(self._body, given, minlength=self._manifold.n_bodies)
        return np.asarray(found, dtype=float)

    def forget(self) -> None:
        self._kept = None

    def _matrix(self, factor: Floats) -> csc_array:
        found = self._of_elements(factor)
        if self._points is None:
            return found
        of_body = factor[len(self._manifold.element_body) :]
        return csc_array(found + diags_array(of_body[self._body]) @ self._points)

    def _of_elements(self, factor: Floats) -> csc_array:
        groups = zip(self._manifold.groups, self._masses, strict=True)
        parts = [
            Part(
                group.unknowns, factor[group.elements, None, None] * masses, np.arange(len(masses))
            )
            for group, masses in groups
        ]
        return assemble(parts, self._manifold.n_unknowns, self._manifold.cover_offset)
