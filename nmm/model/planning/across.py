"""The stress across the plane, of the strain and of what effects add, in plane strain.

Plane measures leave it out: a yield stress ``f`` of von Mises would show as ``2 / sqrt(3) f``.
"""

import numpy as np

from integration.arrays import Floats, Ints
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.effects.base import defines
from nmm.model.planning.plan import Plan


def stress_across(plan: Plan, model: Model, state: State, stress: Floats) -> Floats | None:
    """Return the mean stress across (E,) of elements, None in plane stress (Pa).

    ``stress`` (E, 3) is that of the strain alone, in body axes.
    """
    if model.plane == "stress":
        return None
    found = model.stress_across(state, stress)
    for _, effect in plan.named("mean_stress"):
        if defines(effect, "mean_stress_across"):
            found = found + effect.mean_stress_across(state)
        else:
            found = found + np.einsum("ei,ei->e", model.across_share, effect.mean_stress(state))
    return found


def stress_across_at(
    plan: Plan, model: Model, state: State, elements: Ints, points: Floats, stress: Floats
) -> Floats:
    """Return the stress across (m,) at reference points (m, 2) of elements (m,) (Pa).

    ``stress`` (m, 3) is that of the strain alone, in body axes.
    """
    if model.plane == "stress":
        return np.zeros(len(elements))
    share = model.across_share[elements]
    found = np.einsum("mi,mi->m", share, stress)
    if model.matter is not None:
        near = model.matter.across_near(state.deformation, state.history, elements, points)
        found = np.where(np.isnan(near), found, near)
    for effect in plan.having("stress_at"):
        if defines(effect, "stress_across_at"):
            found = found + effect.stress_across_at(elements, points, state.time)
        else:
            more = effect.stress_at(elements, points, state.time)
            found = found + np.einsum("mi,mi->m", share, more)
    return np.asarray(found)
