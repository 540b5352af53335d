"""Where points of bodies stand, compiled: what `MaterialPoints.place` says in whole arrays."""

import numpy as np

from integration.arrays import Floats, Ints
from nmm.compiled import compiled


@compiled
def places(
    body: Ints,
    arm: Floats,
    unknowns: Ints,
    values: Floats,
    centre: Floats,
    rotation: Floats,
    tilt: Floats,
    deformation: Floats,
) -> Floats:
    """Places (m, 2) of points of the material (m).

    Parameters
    ----------
    body, arm, unknowns, values
        Those of `MaterialPoints`, with its rows.
    centre, rotation, tilt
        (B, 2), (B, 2, 2) and (B,) or, where bodies are not tilted, (0,): see `Frames`.
    deformation
        (n,).
    """
    found = np.empty((len(body), 2))
    for k in range(len(body)):
        b = body[k]
        x = arm[k, 0] + _product(values[k, 0], unknowns[k], deformation)
        y = arm[k, 1] + _product(values[k, 1], unknowns[k], deformation)
        if len(tilt) > 0:
            x, y = x - tilt[b] * arm[k, 1], y + tilt[b] * arm[k, 0]
        turn = rotation[b]
        found[k, 0] = centre[b, 0] + (turn[0, 0] * x + turn[0, 1] * y)
        found[k, 1] = centre[b, 1] + (turn[1, 0] * x + turn[1, 1] * y)
    return found


@compiled
def _product(row: Floats, unknowns: Ints, deformation: Floats) -> float:
    """Row times the unknowns that it names, by two sums in turn: so numpy adds short rows up."""
    even, odd = 0.0, 0.0
    for i in range(0, len(row) - 1, 2):
        even += row[i] * deformation[unknowns[i]]
        odd += row[i + 1] * deformation[unknowns[i + 1]]
    if len(row) % 2 == 1:
        even += row[len(row) - 1] * deformation[unknowns[len(row) - 1]]
    return even + odd
