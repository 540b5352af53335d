"""A cached stiffness matrix of members, renewed when its inputs change by more than a share."""

from collections.abc import Callable

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.assembly.state import State
from nmm.effects.base import Setup
from nmm.effects.members.links import LinesOfAction, Links

# Relative change of its inputs up to which the matrix of an earlier step serves where members turn:
# Newton's method within the step accounts for the difference.
LIKE = 1e-3


class KeptMatrix:
    """A matrix of links between the blocks of a model, with the inputs that it was made of."""

    def __init__(self, setup: Setup) -> None:
        self._made: tuple[tuple[Floats, ...], csc_array] | None = None
        self._rounding = float(np.finfo(float).eps * setup.model.modulus.max())
        self._moves = setup.scene.inertia is not None

    def parts(
        self, links: Links, state: State, lines: LinesOfAction, force: Floats, tangent: Floats
    ) -> tuple[Floats, ...]:
        """Return the inputs of the matrix of forces (m,) (N) with tangents (m,) (N/m).

        Each array ends with the size that its changes are compared with: 1 rad for rotations. In
        statics the geometric stiffness may be all that holds a block beside friction, so that it is
        compared with the rounding of the stiffness of blocks; in dynamics blocks have mass, and it
        is compared with the axial stiffness.
        """
        turns = np.append(state.frames.angle[links.bodies], 1.0)
        least = tangent.max(initial=self._rounding) if self._moves else self._rounding
        return turns, lines.along, tangent, np.append(force * lines.across, least)

    def of(
        self, made_of: tuple[Floats, ...], like: float, make: Callable[[], csc_array]
    ) -> csc_array:
        """Return the matrix; made anew if an input has changed by more than the share ``like``."""
        if self._made is None or not _alike(self._made[0], made_of, like):
            self._made = made_of, make()
        return self._made[1]

    def forget(self) -> None:
        """Drop the matrix."""
        self._made = None


def _alike(some: tuple[Floats, ...], others: tuple[Floats, ...], share: float) -> bool:
    """Whether arrays differ by no more than a share of their largest entries."""
    return all(
        np.abs(one - other).max(initial=0.0) <= share * np.abs(one).max(initial=0.0)
        for one, other in zip(some, others, strict=True)
    )
