"""The total stress in the material: elastic stress and the stresses that effects add to it."""

from collections.abc import Callable, Sequence

import numpy as np

from integration.arrays import Floats
from integration.rules import PointRule
from nmm.assembly.errors import stresses
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.assembly.stress_points import StressAt

StressField = Callable[[PointRule], Floats]
"""A function that returns stresses (Q, 3) in body axes at the points of a rule (Pa)."""


def acting_stress(model: Model, state: State, added: Sequence[StressAt], rule: PointRule) -> Floats:
    """Return the total stresses (Q, 3) in body axes at the points of a rule (Pa).

    ``added`` are the stresses that do not follow from the strain: initial stress, thermal stress,
    pore pressure.
    """
    found = stresses(model, state.deformation, rule)
    for one in added:  # of effects
        found = found + one(rule.owner, rule.points, state.time)
    return np.asarray(found)
