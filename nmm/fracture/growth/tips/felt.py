"""Which tips feel the load: what they have is more than the error of its integral."""

from collections.abc import Sequence

import numpy as np

from integration.arrays import Floats, Ints
from nmm.assembly.model import Model
from nmm.assembly.motion import State
from nmm.assembly.stress_points import StressAt
from nmm.fracture.surroundings import domain_radius

# Intensities of cracks along the load, over the mean stress of the domain and the root of pi times
# its radius, are 1e-6 to 3e-5 with four to ten cells over half of the crack.
ERROR = 1e-4


def felt(
    model: Model,
    state: State,
    added: Sequence[StressAt],
    tip: Ints,
    equivalent: Floats,
    radius: float,
) -> Ints:
    """Return which of tips (k,) of ``model.cut.tips`` have an ``equivalent`` K (k,) of their own.

    ``added`` are stresses that are no strain's; ``radius`` is that of domains before others cut it.
    """
    centre = model.cut.elements.centroids
    stress = model.stress(state)
    for one in added:  # of effects
        stress = stress + one(np.arange(len(centre)), centre, state.time)
    square = (stress[:, :2] ** 2).sum(axis=1) + 2 * stress[:, 2] ** 2
    known = [
        _in_domain(model, centre, square, int(one), domain_radius(model.cut, int(one), radius))
        for one in tip  # a handful
    ]
    return np.flatnonzero(equivalent > ERROR * np.reshape(known, len(tip)))


def _in_domain(model: Model, centre: Floats, square: Floats, tip: int, radius: float) -> float:
    """K (Pa m^1/2) of a crack of half length ``radius`` under the mean stress about a tip."""
    near = np.hypot(*(centre - model.cut.tips.point[tip]).T) <= radius
    mean = np.average(square[near], weights=model.element_area[near]) if near.any() else 0.0
    return float(np.sqrt(mean * np.pi * radius))
