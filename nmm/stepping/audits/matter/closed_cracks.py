"""Whether faces of cracks lie in each other where nothing but contact would hold them apart."""

import numpy as np

from nmm.fracture.growth.faces import CrackFaces
from nmm.stepping.audits.base import AuditFinding, EndedRun, Findings, percent

# Of the displacements, and of coordinates: faces that no function parts differ by less.
ROUNDED_DISPLACEMENT, ROUNDED_PLACE = 1e-9, 64 * float(np.finfo(float).eps)
NAME = "faces_overlap"
REMEDY = "add [contact], and an interface of the material with itself"


def closed_cracks(run: EndedRun) -> Findings:
    """Audit faces at the end of a run, and tips as they grew."""
    plan = run.stepper.plan
    if plan.contact is not None or not run.scene.cracks:
        return
    faces = CrackFaces.of(run.stepper.model)
    _, opening, sliding = faces.jumps(run.state)
    known = ROUNDED_DISPLACEMENT * np.abs(faces.left.rows.apply(run.state.deformation)).max(
        initial=0.0
    )
    known += ROUNDED_PLACE * np.abs(run.stepper.model.manifold.elements.points).max()
    deep, most = -opening.min(initial=0.0), np.hypot(opening, sliding).max(initial=0.0)
    if most > known:
        share = float(deep / most)
        where = f"faces of cracks lie in each other by up to {deep:.3g} m"
        yield AuditFinding(NAME, share, where, REMEDY)
    if plan.fracture is not None:
        shut = plan.fracture.shut
        where = f"a crack grew from a tip that was pressed shut: K_I was -{percent(shut)} of K"
        yield AuditFinding(NAME, shut, where, REMEDY)
