"""Whether all numbers of a contact problem are ones that a solution can start from, compiled."""

import math
from typing import Any

import numpy.typing as npt

from integration.arrays import Floats
from nmm.compiled import compiled


@compiled
def sound(
    force: Floats,
    entries: tuple[Floats, Floats, Floats],
    starts: tuple[Floats, Floats],
    stiffness: tuple[Floats, Floats],
    limits: tuple[Floats, Floats, Floats],
    before: tuple[Floats, Floats],
    state: npt.NDArray[Any],
) -> bool:
    """Whether columns are equally long, and numbers finite and positive where they must be.

    Parameters
    ----------
    force, entries
        (n,) right-hand side, entries of the matrix and of both rows.
    starts, stiffness, limits, before, state
        Columns (m,): gap and slip; normal and shear stiffness; tension, cohesion and friction;
        forces and state of the step before.
    """
    m = len(starts[0])
    lengths = (
        *(len(starts[1]), len(stiffness[0]), len(stiffness[1]), len(state)),
        *(len(limits[0]), len(limits[1]), len(limits[2]), len(before[0]), len(before[1])),
    )
    for length in lengths:
        if length != m:
            return False
    if not (_finite(force) and _finite(starts[0]) and _finite(starts[1])):
        return False
    if not (_finite(entries[0]) and _finite(entries[1]) and _finite(entries[2])):
        return False
    for c in range(m):
        # What is no number is neither.
        if not (0.0 < stiffness[0][c] < math.inf and 0.0 < stiffness[1][c] < math.inf):
            return False
        if not (limits[0][c] >= 0.0 and limits[1][c] >= 0.0 and 0.0 <= limits[2][c] < math.inf):
            return False
    return True


@compiled
def _finite(numbers: Floats) -> bool:
    for number in numbers:  # noqa: SIM110, all() of a generator is not compiled
        if not math.isfinite(number):
            return False
    return True
