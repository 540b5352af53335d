"""Pressures on patches beside edges that effects hold open: what lies between counts as volume."""

import numpy as np

from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.assembly.state import State
from nmm.model.planning.plan import Plan


def patch_pressures(plan: Plan, model: Model, state: State) -> Floats | None:
    """Return the pressures (k,) on patches of a model; None where volumes are not projected."""
    if not model.projected or model.pressures is None:
        return None
    return model.pressure(state.deformation, _gaps(plan, len(model.pressures), state))


def lifted_energy(plan: Plan, model: Model, state: State) -> float:
    """Return the energy (J) of pressures with what lies open at edges, less that without.

    It is stored in the material and part of the energy of what holds the edges.
    """
    if not model.projected or model.pressures is None:
        return 0.0
    known = model.pressures
    volume = known.divergence @ state.deformation
    whole = known.root @ volume
    left = known.root @ (volume - _gaps(plan, len(known), state))
    return model.thickness * float(left @ left - whole @ whole) / 2


def _gaps(plan: Plan, k: int, state: State) -> Floats:
    """Volumes (k,) between edges and where they are held."""
    gaps = [effect.gap_volume(state, k) for effect in plan.having("gap_volume")]
    return sum(gaps, start=np.zeros(k))
