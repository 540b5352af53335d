"""What cut springs are at given unknowns: gaps, forces, slips and states, in one compiled pass.

`nmm.contact.problem.coulomb` says the same in whole arrays and is what this is tested against.
"""

import numpy as np

from integration.arrays import Floats, Ints
from nmm.compiled import compiled
from nmm.contact.problem.residual_kernel import SpringColumns, projected
from nmm.contact.problem.row_products import products_along
from nmm.contact.problem.step_problem import BONDED, BROKEN, OPEN, SLIDE, STICK

_OPEN, _STICK, _SLIDE, _BONDED, _BROKEN = map(int, (OPEN, STICK, SLIDE, BONDED, BROKEN))


@compiled
def ended(
    increment: Floats, springs: SpringColumns, before: Ints
) -> tuple[Floats, Floats, Floats, Floats, Ints]:
    """Gap, elastic slip, normal force, shear force and state (m,) at unknowns (n,).

    ``before`` (m,) are the states at the start of the step.
    """
    tension, cohesion, friction = springs.tension, springs.cohesion, springs.friction
    stiffness, shift = springs.stiffness, springs.shift
    m = len(tension)
    gap, slip = np.empty(m), np.empty(m)
    products_along(springs.normal_rows, increment, gap)
    products_along(springs.tangent_rows, increment, slip)
    normal, shear = np.empty(m), np.empty(m)
    state = np.empty(m, dtype=np.int64)
    for c in range(m):
        gap[c], slip[c] = gap[c] + springs.gap[c], slip[c] + springs.slip[c]
        pull = stiffness[0, c] * gap[c] + shift[0, c]
        drag = stiffness[1, c] * slip[c] + shift[1, c]
        normal[c], shear[c] = projected(pull, drag, tension[c], cohesion[c], friction[c])
        slip[c] = (shear[c] - shift[1, c]) / stiffness[1, c]
        if pull > tension[c]:
            gone = before[c] == _BROKEN or tension[c] > 0.0
            state[c] = _BROKEN if gone else _OPEN
        elif shear[c] != drag:
            state[c] = _SLIDE
        else:
            state[c] = _BONDED if before[c] == _BONDED else _STICK
    return gap, slip, normal, shear, state
