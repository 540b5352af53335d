"""A limit point that statics has come near to: the least stiffness, which the load takes away.

At a limit point of a path the square of the least eigenvalue of the tangent falls linearly with
the load. So one state near it, and how the tangent changes as the load goes on, tell where it
vanishes: ``f_c = f - l / (2 dl/df)``. Eigenvalues are those of the tangent against the elastic
stiffness, supports in both; functions that depend on one another have the eigenvalue 1.
"""

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.sparse import csc_array, diags_array

from nmm.assembly.state import State
from nmm.solvers.spectrum import lowest

if TYPE_CHECKING:
    from nmm.stepping.step.stepper import Stepper

# Part of the load step without equilibrium over which the change of the tangent is measured.
MEASURED_OVER = 1e-2
# How far beyond that step the stiffness may vanish, in such steps.
BEYOND = 2.0
# A tangent is symmetric up to this share of its largest entry; others have no least eigenvalue.
SYMMETRIC = 1e-8
# Part of the elastic diagonal added to both matrices, for functions that neither resists.
SHIFT = 1e-12


def vanishing_stiffness(stepper: "Stepper", state: State, factor: float) -> str | None:
    """Say where the stiffness of bodies that bend vanishes, if a load without equilibrium is near.

    Parameters
    ----------
    stepper
        Of a structure; one with contact, or whose matter flows, has no answer.
    state
        The last equilibrium.
    factor
        The load factor at which none was found.
    """
    matter, plan = stepper.model.matter, stepper.plan
    if matter is None or matter.flows or plan.contact is not None:
        return None
    elastic = plan.matrix(state, stepper.model.stiffness)
    shift = csc_array(diags_array(SHIFT * elastic.diagonal()))
    stiffness = _tangent(stepper, state, shift)
    size = np.abs(stiffness.data).max(initial=0.0)
    if np.abs((stiffness - stiffness.T).data).max(initial=0.0) > SYMMETRIC * size:
        return None
    least, mode = lowest(stiffness, csc_array(elastic + shift))
    from scipy.sparse.linalg import splu

    step = factor - state.load_factor
    way = splu(stiffness).solve(MEASURED_OVER * step * stepper.plan.unit_load(state))
    moved = _tangent(stepper, replace(state, deformation=state.deformation + way), shift)
    change = float(mode @ (moved @ mode)) - least
    limit = (
        state.load_factor - least * MEASURED_OVER * step / (2 * change) if change < 0 else np.inf
    )
    if not (least > 0 and limit <= factor + BEYOND * step):
        return None
    return (
        f"a limit point is near: the least stiffness, {least:.1e} of the elastic one, falls with "
        f"the load and vanishes at load factor {limit:.6g}"
    )


def _tangent(stepper: "Stepper", state: State, shift: csc_array) -> csc_array:
    tangent = stepper.plan.matrix(state, stepper.model.tangent(state))
    return csc_array(tangent + shift)
