"""Jumps of ties, kept while neither bodies nor ground are anywhere else."""

from collections.abc import Sequence

from integration.arrays import Floats
from nmm.assembly.kept import forget_kept, kept_of_place
from nmm.assembly.state import State
from nmm.constraints.imposition import Imposition
from nmm.effects.base import Instant

Motions = list[tuple[Floats, Floats]]
"""Those of the sides (m, 2) of each tie, apart from what driven ground carries; and this."""


class KeptJumps:
    """Jumps of the interfaces of ties.

    Attributes
    ----------
    ties
        The interfaces with their methods.
    still
        Whether the ground stands still as time goes on.
    """

    def __init__(self, ties: Sequence[Imposition]) -> None:
        self.ties, self.still = list(ties), False
        self._last: tuple[Motions, Instant, list[Floats]] | None = None

    def at(self, state: State, end: Instant) -> list[Floats]:
        """Return the jumps (m, 2) in a state from where the ground is at an instant (m)."""
        motions, last = self._moved(state), self._last
        if last is not None and last[0] is motions and self._alike(last[1], end):
            return last[2]
        pairs = zip(self.ties, motions, strict=True)
        jumps = [tie.interface.jump(motion, end) for tie, motion in pairs]
        self._last = motions, end, jumps
        return jumps

    def forget(self) -> None:
        """Drop what is kept for speed alone."""
        self._last = None
        forget_kept(self)

    def _alike(self, one: Instant, other: Instant) -> bool:
        """Whether the ground has the same place at two instants."""
        same = one.load_factor == other.load_factor
        return same and (self.still or one.time == other.time)

    @kept_of_place
    def _moved(self, state: State) -> Motions:
        return [tie.interface.motions(state) for tie in self.ties]
