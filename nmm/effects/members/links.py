"""Links between two ends: elongation, line of action and stiffness in finite motion.

The force of a step acts along the line between the midpoints of the motion of both ends, so that
pairs of forces conserve linear and angular momentum. Divided by the mean of both lengths, the mean
of an elastic force does the work that is stored (Simo and Tarnow 1992).
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np
from scipy.sparse import csc_array, csr_array, diags_array

from integration.arrays import Floats, Ints
from integration.plane_vectors import counterclockwise, cross
from nmm.assembly.kept import kept_of_place
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.effects.members.ends import MemberEnds
from nmm.solvers.unchecked import product


@dataclass(frozen=True)
class LinesOfAction:
    """Lines of action of links.

    Attributes
    ----------
    along
        (m, 2) unit vectors from first to second ends, by which forces are multiplied.
    across
        (m,) rotation of ``along`` for a motion across it (1/m); 0 where it is fixed.
    """

    along: Floats
    across: Floats

    @property
    def normal(self) -> Floats:
        """(m, 2) unit vectors across them."""
        return counterclockwise(self.along)


@dataclass(frozen=True)
class Links:
    """Links between pairs of ends.

    Attributes
    ----------
    first, second
        The m ends.
    direction
        (m, 2) unit vectors from first to second ends in the reference configuration.
    small
        Whether displacements are small: lines of action are fixed, and motion across does not
        stretch.
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
        """(m, 2) from first to second ends in the reference configuration (m)."""
        return np.asarray(self.second.position - self.first.position)

    @cached_property
    def length(self) -> Floats:
        """(m,) reference lengths (m)."""
        return np.asarray(np.hypot(*self.vector.T))

    @cached_property
    def drawn(self) -> LinesOfAction:
        """Lines of action in the reference configuration."""
        return LinesOfAction(self.direction, np.zeros(len(self)))

    @cached_property
    def bodies(self) -> Ints:
        """Numbers of the bodies that they are connected to."""
        return np.unique(
            np.concatenate([end.points.body[end.on_block > 0] for end in (self.first, self.second)])
        )

    @property
    def grounded(self) -> bool:
        """Whether any end is on the ground."""
        return bool((self.first.on_block * self.second.on_block == 0).any())

    @kept_of_place
    def way(self, state: State) -> Floats:
        """Return the displacement of second ends relative to first ones (m, 2) (m)."""
        return self.second.way(state) - self.first.way(state)

    def place(self, state: State) -> Floats:
        """Return the present places of both ends (m, 2, 2) (m)."""
        ends = (self.first, self.second)
        return np.stack([end.position + end.way(state) for end in ends], axis=1)

    def stretch(self, state: State) -> Floats:
        """Return the elongation (m,) (m), without cancellation."""
        way = self.way(state)
        if self.small:
            return np.asarray((way * self.direction).sum(axis=1))
        now = np.hypot(*(self.vector + way).T)
        return np.asarray((way * (2 * self.vector + way)).sum(axis=1) / (now + self.length))

    def lines(self, state: State) -> LinesOfAction:
        """Return the lines of action in a state."""
        if self.small:
            return self.drawn
        now = self.vector + self.way(state)
        length = np.hypot(*now.T)
        return LinesOfAction(now / length[:, None], 1 / length)

    def mean_lines(self, before: State, after: State) -> LinesOfAction:
        """Return the lines of action through a step."""
        if self.small:
            return self.drawn
        start, end = (self.vector + self.way(one) for one in (before, after))
        sums = np.hypot(*start.T) + np.hypot(*end.T)
        return LinesOfAction((start + end) / sums[:, None], 1 / sums)

    def rows(self, state: State, directions: Floats) -> csr_array:
        """(m, n) from the unknowns of a step to the relative motion along directions (m, 2)."""
        unknowns, values = self._apart(state, directions)
        ends = np.arange(len(values) + 1) * values.shape[1]
        shape = (len(values), len(state.deformation))
        return csr_array((values.ravel(), unknowns.ravel(), ends), shape=shape)

    def _apart(self, state: State, directions: Floats) -> tuple[Ints, Floats]:
        """Unknowns and rows (m, L) of the relative motion along directions (m, 2)."""
        parts = [(self.second, directions), (self.first, -directions)]
        values = np.concatenate([end.along(state.frames, way) for end, way in parts], axis=1)
        return self._unknowns, values

    @cached_property
    def _unknowns(self) -> Ints:
        ends = (self.second, self.first)
        return np.concatenate([end.points.rows.unknowns for end in ends], axis=1)

    def pull(self, state: State, lines: LinesOfAction, force: Floats) -> Floats:
        """Force (n,) on the unknowns of axial forces (m,) (N)."""
        n = len(state.deformation)
        if not force.any():
            return np.zeros(n)
        unknowns, values = self._apart(state, lines.along)
        pushed = (-force[:, None] * values).ravel()
        return np.asarray(np.bincount(unknowns.ravel(), pushed, minlength=n))

    def stiffness(
        self, state: State, lines: LinesOfAction, tangent: csr_array, force: Floats
    ) -> csc_array:
        """Stiffness (n, n): of a tangent (m, m), and the geometric one of forces (m,)."""
        n, turning = len(state.deformation), force * lines.across
        found = csc_array((n, n))
        if tangent.data.any():
            along = self.rows(state, lines.along)
            found = csc_array(along.T @ tangent @ along)
        if turning.any():
            across = self.rows(state, lines.normal)
            found = csc_array(found + across.T @ diags_array(turning) @ across)
        return found

    def moment_correction(
        self, model: Model, before: State, after: State, lines: LinesOfAction, force: Floats
    ) -> Floats:
        """Moments, as forces (n,), by which arms at the middle of a step differ from its start."""
        if self.small or not force.any():
            return np.zeros(len(before.deformation))
        moment = np.zeros((model.manifold.n_bodies, 3))
        pulls = force[:, None] * lines.along
        for end, pull in ((self.first, pulls), (self.second, -pulls)):
            arm = end.arm(before, after)
            turning = cross(arm, pull)
            moment[:, 2] += np.bincount(end.points.body, turning, minlength=len(moment))
        return product(model.rigid_spread, moment.ravel())
