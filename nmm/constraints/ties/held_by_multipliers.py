"""Ties that multipliers hold: their conditions in a step, and multipliers kept for reactions."""

from collections.abc import Iterator, Sequence

import numpy as np

from integration.arrays import Floats
from integration.sparse import csr_array, vstack
from nmm.assembly.state import State
from nmm.constraints.imposition import Imposition
from nmm.constraints.ties.kept_jumps import KeptJumps
from nmm.effects.base import Effect, Instant

# Multipliers (k,) of each space as found last and as the step began (Pa).
LastMultipliers = tuple[tuple[Floats | None, Floats | None], ...]


class HeldByMultipliers(Effect):
    """Base of effects of ties, some of which multipliers hold.

    Attributes
    ----------
    jumps
        Of the ties.

    Parameters
    ----------
    ties
        The interfaces with their methods.
    """

    def __init__(self, ties: Sequence[Imposition]) -> None:
        self.jumps = KeptJumps(ties)
        self._spaces = list({id(t.shared): t.shared for t in ties if t.shared}.values())

    @property
    def ties(self) -> list[Imposition]:
        """The interfaces with their methods."""
        return self.jumps.ties

    @property
    def multipliers(self) -> int:
        """Number of conditions that multipliers hold."""
        return sum(space.size for space in self._spaces)

    def border(self, state: State, end: Instant) -> tuple[csr_array, Floats] | None:
        """Conditions ``rows @ d = sides`` on the step's unknowns; None without multipliers."""
        if not self._spaces:
            return None
        found: dict[int, tuple[csr_array, Floats]] = {}
        for tie, jump in self._each(state, end):
            if tie.shared is not None:
                rows, sides = tie.conditions(state, jump)
                before = found.get(id(tie.shared))
                both = (rows, sides) if before is None else (before[0] + rows, before[1] + sides)
                found[id(tie.shared)] = both
        parts = found.values()
        return csr_array(vstack([rows for rows, _ in parts])), np.concatenate([s for _, s in parts])

    def keep(self, multipliers: Floats) -> Floats:
        """Remember the multipliers of the last solution, for reactions; return the others."""
        for space in self._spaces:
            space.values, multipliers = multipliers[: space.size], multipliers[space.size :]
        return multipliers

    def carried(self) -> LastMultipliers:
        """See `Effect.carried`: the last multipliers, and those before, of each space."""
        return tuple((shared.values, shared.before) for shared in self._spaces)

    def carry(self, carried: LastMultipliers) -> None:
        for shared, (values, before) in zip(self._spaces, carried, strict=True):
            shared.values, shared.before = values, before

    def _each(self, state: State, end: Instant) -> Iterator[tuple[Imposition, Floats]]:
        """Each tie with its jump (m, 2) from where the ground is at an instant."""
        return zip(self.ties, self.jumps.at(state, end), strict=True)
