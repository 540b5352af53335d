"""The equation that a step along a path satisfies beside balance."""

from dataclasses import dataclass

from integration.arrays import Floats
from nmm.errors import SolveError


@dataclass(frozen=True)
class PathEquation:
    """``row @ d + share * change = target`` of increment and change of the load factor.

    Attributes
    ----------
    load
        (n,) force of a load factor of one (N).
    row
        (n,) what is controlled, by unknown.
    share
        The same by load factor.
    target
        How far the step goes.
    """

    load: Floats
    row: Floats
    share: float
    target: float

    def change(self, along: Floats, still: Floats, so_far: float) -> float:
        """Return by how much the load factor changes further.

        ``along`` (n,) is what a load factor of one moves, ``still`` (n,) the increment without a
        further change, ``so_far`` the change of the step before.

        Raises
        ------
        SolveError
            Where the load moves nothing that is controlled.
        """
        moved = float(self.row @ along + self.share)
        if moved == 0:
            raise SolveError("the path has no next step: the load moves nothing that is controlled")
        return self.left(still, so_far) / moved

    def left(self, increment: Floats, change: float) -> float:
        """Return what an increment (n,) and a change of the load factor lack of the target."""
        return float(self.target - self.row @ increment - self.share * change)
