"""The forces that members can exert near a place, whatever stretches them: for limit analysis."""

from dataclasses import dataclass

from integration.arrays import Bools, Floats
from integration.sparse import csr_array


@dataclass(frozen=True)
class Resistance:
    """Axial forces ``f`` (m,) (N) of links within their limits, tension positive.

    They act on the n unknowns of a step by ``-along.T @ f``.

    Attributes
    ----------
    along, across
        (m, n) relative motion of the ends along the present lines of action and across them; the
        latter is zero where lines are fixed.
    lowest, highest
        (m,) limits of the forces (N), by yielding or as a cable carries no compression.
    force
        (m,) present forces (N).
    slack
        (m,) ways (m) to be gone before a link carries anything; 0 where it does.
    bond, strength
        (p, m) and (p,): bond along bars carries ``abs(bond @ f) <= strength`` (N).
    """

    along: csr_array
    across: csr_array
    lowest: Floats
    highest: Floats
    force: Floats
    slack: Floats
    bond: csr_array
    strength: Floats

    @property
    def one_sided(self) -> Bools:
        """(m,) whether links carry tension alone, or compression alone."""
        return (self.lowest >= 0) | (self.highest <= 0)
