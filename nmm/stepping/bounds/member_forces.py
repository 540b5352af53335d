"""Forces of members as unknowns of the static theorem, within their limits.

A cable is one force along its chord, ``0 <= T <= limit``; bond along a bar limits the difference of
the forces on both sides of a point. Near a place chords may turn a little: a taut one then carries
``abs(V) <= TURN T`` across it, and one that is still slack hangs in a direction that is not known.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Self

import numpy as np
from scipy.sparse import block_diag, csr_array, diags_array, hstack, vstack

from integration.arrays import Floats
from nmm.effects.given.resistance import Resistance

# Chords of members turn by less than this near a place (rad).
TURN = 0.1


@dataclass(frozen=True)
class MemberForces:
    """Unknown forces (q,) (N) with what limits them, ``limiting @ forces <= limits``.

    Attributes
    ----------
    acting
        (n, q) from them to the forces on unknowns.
    lowest, highest
        (q,) bounds.
    limiting, limits
        (r, q) and (r,).
    """

    acting: csr_array
    lowest: Floats
    highest: Floats
    limiting: csr_array
    limits: Floats

    @classmethod
    def of(cls, found: Iterable[Resistance], unknowns: int, reach: float | None) -> Self:
        """Return the forces of members on ``unknowns``; none may turn where ``reach`` is None.

        What is slack by more than ``reach`` (m) may pull in any direction.
        """
        parts = [_as_drawn(one) if reach is None else _turning(one, reach) for one in found]
        if not parts:
            none, nothing = np.zeros(0), csr_array((0, 0))
            return cls(csr_array((unknowns, 0)), none, none, nothing, none)
        acting, lowest, highest, limiting, limits = zip(*parts, strict=True)
        low, high, most = (np.concatenate(one) for one in (lowest, highest, limits))
        together = csr_array(block_diag(limiting))
        return cls(csr_array(hstack(acting)), low, high, together, most)


Part = tuple[csr_array, Floats, Floats, csr_array, Floats]


def _as_drawn(one: Resistance) -> Part:
    """Return what limits axial forces (m,)."""
    both = csr_array(vstack([one.bond, -one.bond]))
    acting = csr_array(-one.along.T)
    return acting, one.lowest, one.highest, both, np.tile(one.strength, 2)


def _turning(one: Resistance, reach: float) -> Part:
    """Return what limits axial forces (m,), and forces (m,) across chords that may turn."""
    acting, lowest, highest, limiting, limits = _as_drawn(one)
    hangs = one.slack > reach
    most = np.where(one.one_sided | hangs, np.inf, TURN * np.abs(one.force))
    # Of a cable the force across is a share of the one along, which is sought with it.
    tied = np.flatnonzero(one.one_sided & ~hangs)
    sign = np.where(one.highest > 0, -TURN, TURN)
    share, unit = (csr_array(diags_array(part))[tied] for part in (sign, np.ones(len(sign))))
    chords = csr_array(vstack([hstack([share, unit]), hstack([share, -unit])]))
    own = csr_array(hstack([limiting, csr_array(limiting.shape)]))
    return (
        csr_array(hstack([acting, -one.across.T])),
        np.concatenate([lowest, -most]),
        np.concatenate([highest, most]),
        csr_array(vstack([own, chords])),
        np.concatenate([limits, np.zeros(2 * len(tied))]),
    )
