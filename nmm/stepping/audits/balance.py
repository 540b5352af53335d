"""Whether forces balance where a static run ends: asked of places and forces, not of equations."""

import numpy as np
from scipy.sparse import csr_array

from integration.arrays import Floats
from nmm.assembly.moving.motion import coordinate_rounding
from nmm.effects.base import Instant
from nmm.solvers.accuracy.known import gross
from nmm.solvers.unchecked import magnitudes
from nmm.stepping.audits.base import AuditFinding, EndedRun, Findings, percent
from nmm.stepping.audits.table import THRESHOLDS
from nmm.stepping.drive.verdict import CONVERGED, FAILURE

# A body counts as if it bore at least this share of what the one that bears most does.
LIGHT = 1e-3
# What solutions leave out of balance, of the forces that moving all there is as it moved would ask.
UNSOLVED = 1e-7
# Why forces on a light body are not known, and what to do.
SMALLER = ", smaller than rounding of its place times the stiffness that holds it"
SOFTER = "hold it by multipliers, or by softer springs, where its forces matter"


def balance(run: EndedRun) -> Findings:
    """Audit force and moment on every body where statics ends, as it stands then.

    They are set beside the sizes of the forces at all unknowns, not beside a sum: loads that pull a
    body apart have none, and reactions to nothing are rounding. Where paths end bonds may have
    given way for the next step: there all bodies count together, as contact comes in pairs.
    Multipliers that hold supports are in no force, so that bodies that they hold are not audited.
    A run that was stopped within a step has the contacts of that step, not of the last state, one
    that moved on after its failure those of the motion, and one that ends where blocks have split
    has no balance since.
    """
    loading, plan, model = run.scene.loading, run.stepper.plan, run.stepper.model
    followed = loading is not None and loading.control is not None
    ended = followed or run.verdict.code in (CONVERGED, FAILURE)
    solved = run.state is not run.start  # what splits counts from its state after that
    moved = loading is not None and loading.motion_after_failure is not None
    if run.dynamic or moved or not (ended and solved):
        return
    left, size = _left(run, with_contact=not followed)
    border = plan.border(run.state, Instant.of(run.state))
    if border is not None:
        left[model.manifold.unknown_body[csr_array(border[0]).indices]] = 0.0
    if followed:
        if border is not None:
            return
        left, size = left[:, :2].sum(axis=0, keepdims=True), size.max(keepdims=True)
    matrix = plan.matrix(run.state, model.stiffness)
    coordinates = coordinate_rounding(model.manifold)
    rounded = gross(matrix, coordinates)
    torn = LIGHT * run.recorder.totals.borne  # contacts bore far more before
    if not size.max() > max(rounded, min(torn, UNSOLVED * gross(matrix, run.state.deformation))):
        return
    apart = np.sqrt(np.square(left).sum(axis=1))
    off = apart / np.maximum(size, LIGHT * size.max())
    unknown = np.zeros(len(off), dtype=bool)
    if not followed:
        terms = magnitudes(model.manifold.rigid_modes).T @ (magnitudes(matrix) @ coordinates)
        unknown = apart <= np.hypot(*terms.reshape(-1, 3)[:, :2].T)
    missed = np.where(unknown, 0.0, off)
    at = int(np.argmax(missed if missed.max() > THRESHOLDS["force_balance"].warns else off))
    x, y = run.state.frames.centre[at]
    where = "the bodies together" if followed else f"the body about ({x:.6g}, {y:.6g})"
    yield AuditFinding(
        "force_balance",
        float(off[at]),
        f"forces on {where} are out of balance by {percent(off[at])} of their size where the run "
        f"ends{SMALLER if unknown[at] else ''}",
        SOFTER if unknown[at] else "take smaller increments or steps of the load, and compare",
        mild=bool(unknown[at]),
    )


def _left(run: EndedRun, with_contact: bool) -> tuple[Floats, Floats]:
    """Return force, and moment over width, left on bodies (B, 3), and sizes (B,) of all forces (N).

    Of bodies that bend by any angle turns are no sum of unknowns: their moments do not count.
    """
    plan, state, model = run.stepper.plan, run.state, run.stepper.model
    modes, turn = model.manifold.rigid_modes, state.frames.rotation
    forces = list(plan.forces(state, Instant.of(state)))
    if with_contact and plan.contact is not None:
        forces.append(-plan.contact.push(state))
    nothing = np.zeros(len(state.deformation))
    left = (modes.T @ sum(forces, start=nothing)).reshape(-1, 3)
    size = (magnitudes(modes).T @ sum(map(np.abs, forces), start=nothing)).reshape(-1, 3)
    left[:, :2] = np.einsum("bij,bj->bi", turn, left[:, :2])
    left[:, 2] /= np.inf if run.stepper.kinematics.finite else np.sqrt(model.manifold.body_area)
    return left, np.asarray(np.hypot(size[:, 0], size[:, 1]))
