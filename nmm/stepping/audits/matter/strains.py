"""Whether strains are as small as the equations take them."""

import numpy as np

from nmm.materials.principal_stresses import PrincipalStresses
from nmm.stepping.audits.base import AuditFinding, EndedRun, Findings, percent
from nmm.stepping.step.anchors import block_name

FINITE = 'the equations take strains as small: use [rotation] update = "finite"'
STRETCHES = (
    f"{FINITE}, or look for what stretches where the structure would come apart: bonds without "
    "strength, loads that are too large"
)
# By which bodies turn (rad) before an error of their moment of inertia shows in where they are.
TURNED = 0.1


def strains(run: EndedRun) -> Findings:
    """Audit the largest mean strain of an element in the plane, at the end of a run.

    Where bodies may touch, and in time of bodies that turned, whose moment of inertia is linear in
    their strain. All else is linear in the load, whose size is anyone's.
    """
    stepper, state = run.stepper, run.state
    model, names = stepper.model, stepper.discretisation.setup.region_name
    touch = stepper.plan.contact is not None
    turned = run.dynamic and stepper.kinematics.turns and np.abs(state.frames.angle) > TURNED
    counted = np.broadcast_to(touch | turned, model.manifold.n_bodies)
    if stepper.kinematics.finite or not counted.any():
        return
    found = PrincipalStresses.of(model.mean_strain(state.deformation) * [1.0, 1.0, 0.5])
    each = np.maximum(np.abs(found.larger), np.abs(found.smaller))
    each *= counted[model.manifold.element_body]
    at = int(each.argmax())
    x, y = model.manifold.elements.centroids[at]
    block = block_name(model, model.manifold.element_body[at], names)
    where = f"block {block} is strained by {percent(each[at])} about ({x:.4g}, {y:.4g}) m"
    remedy = STRETCHES if touch else f"{FINITE}, under which what spins has the inertia it has"
    yield AuditFinding("large_strain", float(each[at]), where, remedy)
