"""Links between two ends each: how far they stretch, where they pull, with finite motion.

A force through a step acts along the line between the mean places of both ends, so that pairs of
forces keep linear and angular momentum; divided by the mean of both lengths, the mean of an
elastic force does the work that is stored (Simo and Tarnow 1992).
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
from scipy.sparse import csc_array, csr_array, diags_array

from integration.arrays import Floats, Ints
from nmm.assembly.model import Model
from nmm.assembly.motion import State
from nmm.effects.members.ends import MemberEnds


@dataclass(frozen=True)
class LinesOfAction:
    """Where links pull.

    Attributes
    ----------
    along
        (m, 2) what a force is multiplied by: the unit vectors from first to second ends.
    across
        (m,) by how much ``along`` turns over a motion across it (1/m); 0 where it stays.
    """

    along: Floats
    across: Floats

    @property
    def normal(self) -> Floats:
        """(m, 2) the same turned by a right angle."""
        return np.stack([-self.along[:, 1], self.along[:, 0]], axis=1)


@dataclass(frozen=True)
class Links:
    """Links.

    Attributes
    ----------
    first, second
        Their ends.
    direction
        (m, 2) unit vectors from first to second as drawn.
    small
        Whether they pull as drawn however their ends move, and a way across stretches none.
    """

    first: MemberEnds
    second: MemberEnds
    direction: Floats
    small: bool

    @classmethod
    def of(cls, first: MemberEnds, second: MemberEnds, small: bool) -> Self:
        """Return the links between ends (m)."""
        vector = second.position - first.position
        return cls(first, second, vector / np.hypot(*vector.T)[:, None], small)

    def __len__(self) -> int:
        return len(self.first)

    @cached_property
    def vector(self) -> Floats:
        """(m, 2) from first to second end as drawn (m)."""
        return np.asarray(self.second.position - self.first.position)

    @cached_property
    def length(self) -> Floats:
        """(m,) as drawn (m)."""
        return np.asarray(np.hypot(*self.vector.T))

    @cached_property
    def drawn(self) -> LinesOfAction:
        """LinesOfAction as drawn, which stay."""
        return LinesOfAction(self.direction, np.zeros(len(self)))

    @cached_property
    def bodies(self) -> Ints:
        """Bodies that they are tied to."""
        return np.unique(
            np.concatenate([end.points.body[end.held > 0] for end in (self.first, self.second)])
        )

    @property
    def grounded(self) -> bool:
        """Whether any end is on the ground."""
        return bool((self.first.held * self.second.held == 0).any())

    def way(self, state: State) -> Floats:
        """Return how far second ends have come from first ones (m, 2)."""
        return self.second.way(state) - self.first.way(state)

    def place(self, state: State) -> Floats:
        """Return where both ends are (m, 2, 2)."""
        ends = (self.first, self.second)
        return np.stack([end.position + end.way(state) for end in ends], axis=1)

    def stretch(self, state: State) -> Floats:
        """Return by how much they are longer than drawn (m,), to the rounding of the motion."""
        way = self.way(state)
        if self.small:
            return np.asarray((way * self.direction).sum(axis=1))
        now = np.hypot(*(self.vector + way).T)
        return np.asarray((way * (2 * self.vector + way)).sum(axis=1) / (now + self.length))

    def lines(self, state: State) -> LinesOfAction:
        """Return where they pull in a state."""
        if self.small:
            return self.drawn
        now = self.vector + self.way(state)
        length = np.hypot(*now.T)
        return LinesOfAction(now / length[:, None], 1 / length)

    def mean_lines(self, before: State, after: State) -> LinesOfAction:
        """Return where they pull through a step."""
        if self.small:
            return self.drawn
        start, end = (self.vector + self.way(one) for one in (before, after))
        sums = np.hypot(*start.T) + np.hypot(*end.T)
        return LinesOfAction((start + end) / sums[:, None], 1 / sums)

    def rows(self, state: State, directions: Floats) -> csr_array:
        """(m, n) from the unknowns of a step to the motion apart along directions (m, 2)."""
        unknowns, values = self._apart(state, directions)
        ends = np.arange(len(values) + 1) * values.shape[1]
        shape = (len(values), len(state.deformation))
        return csr_array((values.ravel(), unknowns.ravel(), ends), shape=shape)

    def _apart(self, state: State, directions: Floats) -> tuple[Ints, Floats]:
        """Unknowns and rows (m, L) of the motion apart along directions (m, 2)."""
        parts = [(self.second, directions), (self.first, -directions)]
        values = np.concatenate([end.along(state.frames, way) for end, way in parts], axis=1)
        return self._unknowns, values

    @cached_property
    def _unknowns(self) -> Ints:
        ends = (self.second, self.first)
        return np.concatenate([end.points.rows.unknowns for end in ends], axis=1)

    def pull(self, state: State, lines: LinesOfAction, force: Floats) -> Floats:
        """Force (n,) on the unknowns of axial forces (m,)."""
        n = len(state.deformation)
        if not force.any():
            return np.zeros(n)
        unknowns, values = self._apart(state, lines.along)
        pushed = (-force[:, None] * values).ravel()
        return np.asarray(np.bincount(unknowns.ravel(), pushed, minlength=n))

    def stiffness(
        self, state: State, lines: LinesOfAction, tangent: csr_array, force: Floats
    ) -> csc_array:
        """Matrix (n, n) of a tangent (m, m) along the lines and of forces (m,) that turn."""
        n, turning = len(state.deformation), force * lines.across
        found = csc_array((n, n))
        if tangent.data.any():
            along = self.rows(state, lines.along)
            found = csc_array(along.T @ tangent @ along)
        if turning.any():
            across = self.rows(state, lines.normal)
            found = csc_array(found + across.T @ diags_array(turning) @ across)
        return found

    def owed(
        self, model: Model, before: State, after: State, lines: LinesOfAction, force: Floats
    ) -> Floats:
        """Moments, as forces (n,), that rows at the start of a step lack of those half way."""
        if self.small or not force.any():
            return np.zeros(len(before.deformation))
        moment = np.zeros((model.manifold.n_bodies, 3))
        pulls = force[:, None] * lines.along
        for end, pull in ((self.first, pulls), (self.second, -pulls)):
            arm = end.arm(before, after)
            turning = arm[:, 0] * pull[:, 1] - arm[:, 1] * pull[:, 0]
            moment[:, 2] += np.bincount(end.points.body, turning, minlength=len(moment))
        return np.asarray(model.rigid_projection.T @ moment.ravel())
