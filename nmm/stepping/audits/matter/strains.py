"""Whether strains are as small as the equations take them."""

import numpy as np

from nmm.materials.principal_stresses import PrincipalStresses
from nmm.stepping.audits.base import AuditFinding, EndedRun, Findings, percent
from nmm.stepping.step.anchors import block_name

STRETCHES = (
    'the equations take strains as small: use [rotation] update = "finite", or look for what '
    "stretches where the structure would come apart: bonds without strength, loads that are too "
    "large"
)


def strains(run: EndedRun) -> Findings:
    """Audit the largest mean strain of an element in the plane, at the end of a run with contact.

    Without contact all is linear in the load, whose size is anyone's.
    """
    stepper = run.stepper
    if stepper.kinematics.finite or stepper.plan.contact is None:
        return
    model, names = stepper.model, stepper.discretisation.setup.region_name
    found = PrincipalStresses.of(model.mean_strain(run.state.deformation) * [1.0, 1.0, 0.5])
    each = np.maximum(np.abs(found.larger), np.abs(found.smaller))
    at = int(each.argmax())
    x, y = model.manifold.elements.centroids[at]
    block = block_name(model, model.manifold.element_body[at], names)
    where = f"block {block} is strained by {percent(each[at])} about ({x:.4g}, {y:.4g}) m"
    yield AuditFinding("large_strain", float(each[at]), where, STRETCHES)
