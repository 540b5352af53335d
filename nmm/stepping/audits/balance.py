"""Whether all bodies together are in balance at the end of a path: by forces, not by equations."""

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.effects.base import Instant
from nmm.solvers.unchecked import magnitudes
from nmm.stepping.audits.base import AuditFinding, EndedRun, Findings, percent


def balance(run: EndedRun) -> Findings:
    """Audit the sum of loads and reactions where a path ends; contact comes in pairs.

    It is set beside the sizes of the forces at all unknowns, not beside a sum: loads that pull a
    body apart have none, and reactions to nothing are rounding. Multipliers that hold
    supports are in no force, so that such runs are not audited.
    """
    loading, plan, state = run.scene.loading, run.stepper.plan, run.state
    if loading is None or loading.control is None:
        return
    now, model = Instant.of(state), run.stepper.model
    if plan.border(state, now) is not None:
        return
    modes, turn = model.manifold.rigid_modes, state.frames.rotation
    sizes = magnitudes(modes)
    total, largest = np.zeros(2), 0.0
    for (_, effect), force in zip(plan.named("force"), plan.forces(state, now), strict=True):
        total += np.einsum("bij,bj->i", turn, _of_bodies(modes, force))
        if effect.external:
            largest = max(largest, float(np.hypot(*_of_bodies(sizes, np.abs(force)).sum(0))))
    if not largest:
        return
    missed = float(np.hypot(*total)) / largest
    yield AuditFinding(
        "force_balance",
        missed,
        f"loads and reactions at the end of the path differ by {percent(missed)} of the largest",
        "the last step of the path is no equilibrium: take smaller steps of [loading.control]",
    )


def _of_bodies(modes: csc_array, force: Floats) -> Floats:
    """Return the force (B, 2) of unknowns on each body."""
    forces: Floats = (modes.T @ force).reshape(-1, 3)[:, :2]
    return forces
