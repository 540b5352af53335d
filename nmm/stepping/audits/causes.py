"""The part of a run that generated energy, and what to do about it."""

from nmm.stepping.audits.base import EndedRun
from nmm.stepping.reports.accounts import EnergyRise
from nmm.stepping.reports.energies import HOLDING

# Share of a rise that explains it.
EXPLAINS = 0.5

SOFTENS = (
    "it came from bonds that soften, each of which acts through a step as at its end and so takes "
    "less than its fracture energy: take smaller steps, in more of which it tears"
)
TOUCHES = "it came from contact: take smaller steps or another enforcement and compare"


def cause(run: EndedRun, rise: EnergyRise) -> str:
    """Return what to do about a rise, naming the part of the run that gave most of it, if any."""
    grown, most, contact = rise.grown, EXPLAINS * rise.energy, run.stepper.plan.contact
    if contact is not None and grown.contact >= max(most, grown.given):
        softens = grown.lost > 0 and contact.laws.remembering("damage").any()
        return SOFTENS if softens else f"{TOUCHES}{_what_keeps(run)}"
    if grown.given >= most:
        return (
            f'it came from the integrator "{run.formulation.integrator.type}": take smaller steps, '
            f"or one without gain{_what_keeps(run)}"
        )
    if run.stepper.kinematics.finite:
        return "take smaller steps and compare"
    if grown.supports >= most:
        return _of_supports(run)
    # Supports and loads act on the reference configuration: an exchange at any length of steps.
    return (
        "take smaller steps and compare; if they change nothing, bodies bend too far: "
        '[rotation] update = "finite"'
    )


def _of_supports(run: EndedRun) -> str:
    """Name the springs on turning bodies, whose points leave their arcs within a step."""
    named = [name for name in HOLDING if name in run.stepper.plan.effects]
    return (
        f"it is in the springs of {' and '.join(named)}, whose forces keep the direction of the "
        'start of a step while bodies turn: take smaller steps, or [rotation] update = "finite", '
        "which follows the rotation"
    )


def _what_keeps(run: EndedRun) -> str:
    """Name the settings that conserve energy for meshes that turn in contact."""
    stepper = run.stepper
    meshes, contact = stepper.model.manifold.shared_covers, stepper.plan.contact
    if not meshes or not stepper.kinematics.turns or contact is None:
        return ""
    springs = 'enforcement = "penalty" and ' if contact.exact else ""
    return (
        f', or {springs}type = "energy_momentum" with [rotation] update = "finite", which keeps it'
    )
