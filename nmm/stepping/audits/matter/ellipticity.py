"""Matter that flows in more than one way: where equilibrium loses its ellipticity."""

import math

import numpy as np

from nmm.assembly.laws_at_points import STRESS, SWELLING
from nmm.assembly.matter import Matter
from nmm.materials.acoustic_tensor import Determinants
from nmm.stepping.audits.base import AuditFinding, EndedRun, Findings
from nmm.stepping.audits.table import THRESHOLDS

# Tangents nearer to the elastic one, as a share of it, are of points that do not flow.
ALIKE = 1e-9


def ellipticity(run: EndedRun) -> Findings:
    """Audit the acoustic tensors of the tangents of the last step, at points that flowed in it.

    Laws that soften are left out: a row of cells takes the energy of their bands.
    """
    matter, before, after = run.stepper.model.matter, run.recorder.before, run.state
    if not isinstance(matter, Matter) or before is None:
        return
    if len(matter.law) != len(before.history[STRESS]):  # what is solved has changed since
        return
    history = dict(before.history)
    if SWELLING in after.history:
        history[SWELLING] = after.history[SWELLING]
    length = after.time - before.time if run.dynamic or run.scene.duration is not None else 0.0
    tangent = matter.update(after.deformation, history, length).tangent
    softens = np.array([law.sized for law in matter.laws])[matter.law]
    off = np.abs(tangent - matter.elastic).max(axis=(1, 2))
    flows = np.flatnonzero(~softens & (off > ALIKE * np.abs(matter.elastic).max(axis=(1, 2))))
    if not len(flows):
        return
    lowest, angle = Determinants.of(tangent[flows]).least()
    lowest = lowest / Determinants.of(matter.elastic[flows]).terms[:, 0]
    at = int(lowest.argmin())
    lost = int((lowest < -THRESHOLDS["ellipticity"].warns).sum())
    rule, manifold = matter.points.rule, run.stepper.model.manifold
    x, y = rule.points[flows[at]]
    turned = after.frames.angle[manifold.element_body[rule.owner[flows[at]]]]
    band = math.degrees(angle[at] + turned + math.pi / 2) % 180
    yield AuditFinding(
        "ellipticity",
        max(-float(lowest[at]), 0.0),
        f"{lost} of the {len(flows)} material points that flow can strain in bands, most readily "
        f"at ({x:.6g}, {y:.6g}) along {band:.0f} degrees from x: equilibrium is not elliptic "
        "there, other equilibria with bands exist, and which one is found, with the load beyond "
        "it, depends on the mesh",
        "compare meshes; the equations are well-posed with a dilation_angle equal to the friction "
        "angle, and bands take an energy that no mesh changes with softening_energy",
    )
