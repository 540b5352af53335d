"""Whether all bodies together are in balance at the end of a path: by forces, not by equations."""

import numpy as np

from nmm.effects.base import Instant
from nmm.stepping.audits.base import AuditFinding, Ended, Findings, percent


def balance(run: Ended) -> Findings:
    """Audit the sum of loads and reactions where a path ends; contact comes in pairs.

    Multipliers that hold supports are in no force, so that such runs are not audited.
    """
    loading, plan, state = run.scene.loading, run.stepper.plan, run.state
    if loading is None or loading.control is None:
        return
    now, model = Instant.of(state), run.stepper.model
    if plan.border(state, now) is not None:
        return
    modes, turn = model.manifold.rigid_modes, state.frames.rotation
    sums = [
        np.einsum("bij,bj->i", turn, (modes.T @ force).reshape(-1, 3)[:, :2])
        for force in plan.forces(state, now)
    ]
    largest = max((float(np.hypot(*one)) for one in sums), default=0.0)
    if not largest:
        return
    missed = float(np.hypot(*np.sum(sums, axis=0))) / largest
    yield AuditFinding(
        "force_balance",
        missed,
        f"loads and reactions at the end of the path differ by {percent(missed)} of the largest",
        "the last step of the path is no equilibrium: take smaller steps of [loading.control]",
    )
