"""How well the systems were solved, and what they were made of."""

import numpy as np

from nmm.assembly.material_points import vertex_points
from nmm.stepping.audits.base import AuditFinding, EndedRun, Findings
from nmm.stepping.drive.verdict import CONVERGED

# Residual from which on dependent functions are worth a word.
NOTICED = 1e-8


def equations(run: EndedRun) -> Findings:
    """Audit residual, condition, cuts and dependent functions."""
    residual, manifold = run.recorder.totals.residual, run.stepper.model.manifold
    yield AuditFinding(
        "residual",
        residual,
        f"a step was accepted {residual:.1e} of its load out of balance",
        "shorten the step, or ask [contact] options for a smaller tolerance",
    )
    if run.condition is not None:
        yield AuditFinding(
            "condition",
            run.condition,
            f"the last system has a condition number of {run.condition:.1e}: "
            f"some {max(16 - np.log10(run.condition), 0):.0f} digits of soft motions are left",
            "bring stiffnesses of materials, supports and contacts nearer to each other",
        )
    yield from _rounding(run)
    if not run.stepper.model.cut.element_whole.all():
        area = run.stepper.model.element_area
        at = int(np.argmin(area))
        x, y = manifold.elements.points[manifold.elements.polygon_of_point == at].mean(axis=0)
        yield AuditFinding(
            "smallest_cut",
            float(area.max() / area[at]),
            f"the element at ({x:.6g}, {y:.6g}) has {area[at] / area.max():.1e} of the area of the "
            "largest",
            "do not read stresses there; shift the net by [cover] origin, or turn it",
        )
    if manifold.dependent and residual > NOTICED:
        yield AuditFinding(
            "dependent_functions",
            manifold.dependent / manifold.n_unknowns,
            f"{manifold.dependent} of {manifold.n_unknowns} functions depend on the others, and "
            f"the residual is {residual:.1e}",
            "take functions of a lower degree or smaller cells",
        )


def _rounding(run: EndedRun) -> Findings:
    """Audit what rounding of the last solution may move, and where most, if it was accepted."""
    changes = run.stepper.rounding_changes()
    if not changes or run.verdict.code != CONVERGED:
        return
    elements = run.stepper.model.manifold.elements
    points = vertex_points(run.stepper.model.manifold)
    moved = np.abs(run.stepper.place(run.state) - elements.points).max()
    off = np.max([np.abs(points.rows.apply(change)).max(axis=1) for change in changes], axis=0)
    at = int(np.argmax(off))
    # What places cannot hold is no change of them: ground in balance moves by rounding alone.
    if not moved > 0 or off[at] <= np.spacing(np.abs(elements.points).max()):
        return
    x, y = elements.points[at]
    yield AuditFinding(
        "rounding",
        float(off[at] / moved),
        f"rounding may have changed displacements by some {off[at] / moved:.0e} of the largest, "
        f"most at ({x:.6g}, {y:.6g})",
        "do not rely on more digits there; bring stiffnesses nearer to each other, take smaller "
        "cells over small pieces, or functions of a lower degree",
    )
