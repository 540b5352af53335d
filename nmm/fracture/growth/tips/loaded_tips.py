"""Loaded tips: those whose intensity factor exceeds the error of the interaction integral."""

from collections.abc import Sequence

import numpy as np

from integration.arrays import Floats, Ints
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.assembly.stress_points import StressAt

# K of a crack along the load, which is zero, over sigma sqrt(pi r) with the mean stress and the
# radius of the domain: computed values are 1e-6 to 3e-5 with four to ten cells over half the crack.
ERROR = 1e-4


def loaded_tips(
    model: Model,
    state: State,
    added: Sequence[StressAt],
    tip: Ints,
    equivalent: Floats,
    radii: Floats,
) -> Ints:
    """Return the rows of the tips (k,) whose ``equivalent`` K (k,) is not merely numerical error.

    Parameters
    ----------
    added
        Stresses that do not follow from the strain.
    tip
        (k,) numbers in ``model.cut.tips``.
    equivalent
        (k,) equivalent stress intensity factors (Pa m^1/2).
    radii
        (k,) radii of the domains (m).
    """
    centre = model.cut.elements.centroids
    stress = model.stress(state)
    for one in added:  # of effects
        stress = stress + one(np.arange(len(centre)), centre, state.time)
    square = (stress[:, :2] ** 2).sum(axis=1) + 2 * stress[:, 2] ** 2
    known = [
        _in_domain(model, centre, square, *pair)
        for pair in zip(tip.tolist(), radii.tolist(), strict=True)  # a handful
    ]
    return np.flatnonzero(equivalent > ERROR * np.reshape(known, len(tip)))


def _in_domain(model: Model, centre: Floats, square: Floats, tip: int, radius: float) -> float:
    """K (Pa m^1/2) of a crack of half length ``radius`` (m) under the mean stress about a tip."""
    near = np.hypot(*(centre - model.cut.tips.point[tip]).T) <= radius
    mean = np.average(square[near], weights=model.element_area[near]) if near.any() else 0.0
    return float(np.sqrt(mean * np.pi * radius))
