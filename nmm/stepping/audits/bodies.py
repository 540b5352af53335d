"""Bodies: how deep they lie in each other, what they weigh, and how they move as a whole."""

from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.assembly.moving.momenta import momenta_about, own_momenta, rigid_masses
from nmm.assembly.state import State
from nmm.stepping.audits.base import AuditFinding, EndedRun, Findings, percent
from nmm.stepping.step.stepper import Stepper

if TYPE_CHECKING:
    from nmm.contact.model_contact import ModelContact

SPRINGS_GIVE = "raise [contact] normal_penalty, take smaller steps, or an exact enforcement"
HELD_IN_THE_MEAN = (
    "faces of meshes are held apart in the mean: take smaller cells, or "
    '[contact] points = "vertices"'
)
JOINTS_GIVE = (
    "a joint gives by the normal_stiffness of its interface: raise that where joints are no such "
    "seams"
)


def bodies(run: EndedRun) -> Findings:
    """Audit overlap, area and momentum."""
    model, totals = run.stepper.model, run.recorder.totals
    contact = run.stepper.plan.contact
    if contact is not None:
        yield AuditFinding(
            "penetration",
            totals.overlap,
            f"bodies overlap by up to {percent(totals.overlap)} of the smaller one: "
            f"{totals.deepest}",
            _held_apart(contact),
            mild=contact.laws.stiff,
        )
    if run.formulation.rotation.update == "linear":
        before = float(model.manifold.elements.with_points(run.stepper.reference).areas.sum())
        share = abs(float(model.manifold.elements.areas.sum()) / before - 1)
        yield AuditFinding(
            "mass",
            share,
            f"the area of the bodies changed by {percent(share)}: the linear update grows what "
            "turns",
            'use [rotation] update = "exact"',
        )
    forces = any(effect.external for effect in run.stepper.plan.effects.values())
    whole = run.formulation.integrator.kinetic_factor == 1
    if run.dynamic and not forces and whole and run.formulation.rotation.update != "linear":
        yield from _momentum(run)


def _held_apart(contact: "ModelContact") -> str:
    """Return what to do about bodies that overlap, by what holds them apart."""
    own = contact.laws.has_stiffness
    if own.all():
        return JOINTS_GIVE
    other = HELD_IN_THE_MEAN if contact.exact else SPRINGS_GIVE
    return f"{JOINTS_GIVE}; elsewhere {other}" if own.any() else other


def _momentum(run: EndedRun) -> Findings:
    (first, spun), (last, spins) = (_of_bodies(run.stepper, one) for one in (run.start, run.state))
    gravity = run.scene.gravity
    along = run.stepper.model.manifold.rigid_modes[:, ::3].sum(axis=1)
    mass = float(along @ (run.stepper.model.mass @ along))
    fall = np.zeros(2) if gravity is None else np.array(gravity.acceleration)
    impulse = mass * fall * (run.state.time - run.start.time)
    # A body that spins has no momentum to measure a change by, one that flies no spin.
    typical = np.maximum(*(_typical(run.stepper, state) for state in (run.start, run.state)))
    size = max(typical[0], *(np.hypot(*part.T).sum() for part in (first, last)))
    if size > 0:
        change = last.sum(axis=0) - first.sum(axis=0) - impulse
        share = float(np.hypot(*change)) / size
        yield AuditFinding(
            "momentum",
            share,
            f"momentum changed by ({change[0]:.3g}, {change[1]:.3g}) N s without a force",
            "take smaller steps and compare",
        )
    turns = max(typical[1], *(np.abs(part).sum() for part in (spun, spins)))
    if gravity is None and turns > 0 and run.formulation.rotation.update != "small":
        gained = float(spins.sum() - spun.sum())
        yield AuditFinding(
            "angular_momentum",
            abs(gained) / turns,
            f"angular momentum changed by {gained:.3g} N m s without a moment",
            "take smaller steps and compare",
        )


def _typical(stepper: Stepper, state: State) -> Floats:
    """Momentum (N s) and angular momentum (N m s) if all motion went one way, or were spin."""
    model = stepper.model
    inertia = rigid_masses(model).sum(axis=0)
    return np.asarray(np.sqrt(inertia[[0, 2]] * (state.velocity @ (model.mass @ state.velocity))))


def _of_bodies(stepper: Stepper, state: State) -> tuple[Floats, Floats]:
    """Momentum (B, 2) and angular momentum (B,) about the middle of the domain."""
    own = own_momenta(stepper.model, state, stepper.kinematics.finite)
    return momenta_about(state, own, stepper.reference.mean(axis=0))
