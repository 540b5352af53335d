"""The stress that acts in the material: that of the strain, and what effects add to it."""

from collections.abc import Callable, Sequence

import numpy as np

from integration.arrays import Floats
from integration.rules import PointRule
from nmm.assembly.errors import stresses
from nmm.assembly.model import Model
from nmm.assembly.motion import State
from nmm.assembly.stress_points import StressAt

StressOn = Callable[[PointRule], Floats]
"""Stresses (Q, 3) in body axes at the points of a rule (Pa)."""


def acting_stress(model: Model, state: State, added: Sequence[StressAt], rule: PointRule) -> Floats:
    """Return the stresses (Q, 3) in body axes at the points of a rule (Pa).

    ``added`` are those that are no strain's: from the start, of heat, of water in the pores.
    """
    found = stresses(model, state.deformation, rule)
    for one in added:  # of effects
        found = found + one(rule.owner, rule.points, state.time)
    return np.asarray(found)
