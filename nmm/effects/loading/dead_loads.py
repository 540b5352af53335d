"""Work of dead body forces, whose direction is fixed while bodies turn and deform."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from integration.arrays import Floats
from integration.contraction import summed
from integration.plane_vectors import QUARTER_TURN
from nmm.assembly.model import Model
from nmm.assembly.state import State

# Lever arms of a body's load below this share of its size are rounding.
EVEN = 1e-12


@dataclass(frozen=True)
class DeadLoad:
    """A body force of fixed direction.

    A point with the arm ``A`` from the body's centroid is at ``c + R (A + tilt x A + T q)``. The
    work is the sum of those on the motion of ``c``, of ``R A`` and of ``R T q``: where axes are
    fixed all motion is in ``q``, where they follow the body it is in ``c``, and ``R A`` contributes
    for bodies of nonuniform load.

    Attributes
    ----------
    model
        Manifold with its materials.
    density
        (E, 2) body force of each element in global axes (N/m3).
    """

    model: Model
    density: Floats

    def work(self, before: State, after: State, pushed: tuple[Floats, Floats]) -> float:
        """Return the work (J) between two states; ``pushed`` are the load vectors (n,) in both."""
        way = after.frames.centre - before.frames.centre
        found = float(summed(self._force * way, axis=None))
        if self._lever is not None:
            found += float(np.sum(self._lever * (turned(after) - turned(before))))
        return found + float(pushed[1] @ after.deformation - pushed[0] @ before.deformation)

    @property
    def has_moment(self) -> bool:
        """Whether it has a moment about the centroid of some body."""
        return self._lever is not None

    @cached_property
    def _force(self) -> Floats:
        """(B, 2) resultant of each body (N)."""
        return np.stack([self._of_bodies(self._of_elements[:, i]) for i in (0, 1)], axis=1)

    @cached_property
    def _lever(self) -> Floats | None:
        """(B, 2, 2) sum of force times arm of each body (N m); None where it is zero for all."""
        manifold = self.model.manifold
        arm = manifold.elements.centroids - manifold.body_centroid[manifold.element_body]
        found = np.zeros((manifold.n_bodies, 2, 2))
        for i, j in np.ndindex(2, 2):
            found[:, i, j] = self._of_bodies(self._of_elements[:, i] * arm[:, j])
        size = np.sqrt(manifold.body_area)
        even = np.abs(found).max(axis=(1, 2)) <= EVEN * size * np.abs(self._force).sum(axis=1)
        return None if even.all() else found

    @cached_property
    def _of_elements(self) -> Floats:
        volume = self.model.element_area * self.model.thickness
        return np.asarray(self.density * volume[:, None])

    def _of_bodies(self, values: Floats) -> Floats:
        manifold = self.model.manifold
        found = np.bincount(manifold.element_body, values, minlength=manifold.n_bodies)
        return np.asarray(found, dtype=float)


def turned(state: State) -> Floats:
    """(B, 2, 2) from arms in body axes to vectors from the centroid in global axes."""
    turn, tilt = state.frames.rotation, state.frames.tilt
    if tilt is None:
        return turn
    return np.asarray(turn @ (np.eye(2) + tilt[:, None, None] * QUARTER_TURN))
