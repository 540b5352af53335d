"""The matrix of members, kept from step to step while what it is made of hardly changes."""

from collections.abc import Callable

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.assembly.motion import State
from nmm.effects.base import Setup
from nmm.effects.members.links import LinesOfAction, Links

# Where members turn the matrix of an earlier step serves while what it is made of is off by no more
# than this share of the largest: what it misses is solved for within the step.
LIKE = 1e-3


class KeptMatrix:
    """A matrix of links between the blocks of a model, and what it was made of."""

    def __init__(self, setup: Setup) -> None:
        self._made: tuple[tuple[Floats, ...], csc_array] | None = None
        self._rounding = float(np.finfo(float).eps * setup.model.modulus.max())
        self._moves = setup.scene.inertia is not None

    def parts(
        self, links: Links, state: State, lines: LinesOfAction, force: Floats, tangent: Floats
    ) -> tuple[Floats, ...]:
        """Return what makes the matrix of forces (m,) with tangents (m,) of their own.

        Small turns count beside one of 1 rad. Where friction alone holds a block that rests, forces
        that turn are all its stiffness: they count beside nothing but the rounding of that of the
        blocks. Blocks that move have their mass: there they count beside the stiffness along.
        """
        turns = np.append(state.frames.angle[links.bodies], 1.0)
        least = tangent.max(initial=self._rounding) if self._moves else self._rounding
        return turns, lines.along, tangent, np.append(force * lines.across, least)

    def of(
        self, made_of: tuple[Floats, ...], like: float, make: Callable[[], csc_array]
    ) -> csc_array:
        """Return the matrix; what ``make`` makes where it would differ by more than a share."""
        if self._made is None or not _alike(self._made[0], made_of, like):
            self._made = made_of, make()
        return self._made[1]

    def forget(self) -> None:
        """Keep nothing."""
        self._made = None


def _alike(some: tuple[Floats, ...], others: tuple[Floats, ...], share: float) -> bool:
    """Whether arrays differ by no more than a share of their largest numbers."""
    return all(
        np.abs(one - other).max(initial=0.0) <= share * np.abs(one).max(initial=0.0)
        for one, other in zip(some, others, strict=True)
    )
