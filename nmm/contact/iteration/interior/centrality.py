"""How far a step of the interior point may go, and how near its path it ends, in compiled loops."""

import numpy as np

from integration.arrays import Bools, Floats
from nmm.compiled import compiled

PointColumns = tuple[Floats, Floats, Floats, Floats, Floats]
"""Unknowns (n,), normal and shear forces (m,), slack and flow (3, m)."""


@compiled
def longest(active: Bools, at: PointColumns, step: PointColumns) -> float:
    """Largest part of a step, up to 1, that leaves active slack and flow positive."""
    found = 1.0
    for value, change in ((at[3], step[3]), (at[4], step[4])):
        for side in range(len(active)):
            for c in range(active.shape[1]):
                if active[side, c] and change[side, c] < 0.0:
                    found = min(found, -value[side, c] / change[side, c])
    return found


@compiled
def mean_product(active: Bools, at: PointColumns, step: PointColumns, length: float) -> float:
    """Mean product of active slack and flow (J) at a ``length`` along a step."""
    total, count = 0.0, 0
    for side in range(len(active)):
        for c in range(active.shape[1]):
            if active[side, c]:
                slack = at[3][side, c] + length * step[3][side, c]
                total += slack * (at[4][side, c] + length * step[4][side, c])
                count += 1
    return total / max(count, 1)


@compiled
def recentred(
    targets: Floats,
    at: PointColumns,
    step: PointColumns,
    length: float,
    centre: float,
    spread: float,
) -> Floats:
    """Targets (3, m) that bring products nearer those of the path which a step leaves far from it.

    Those within the factor ``spread`` of ``centre`` (J) stay; none changes by more than that.
    """
    found = np.empty(targets.shape)
    for side in range(len(targets)):
        for c in range(targets.shape[1]):
            slack = at[3][side, c] + length * step[3][side, c]
            off = slack * (at[4][side, c] + length * step[4][side, c])
            wanted = min(max(off, centre / spread), centre * spread) - off
            found[side, c] = targets[side, c] + max(wanted, -spread * centre)
    return found
