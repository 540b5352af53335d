"""The control that a scene names, where steps along a path can be solved."""

from typing import TYPE_CHECKING

from nmm.contact.controls.base import CONTROLS, Control
from nmm.contact.enforcement.base import make_enforcement
from nmm.errors import FormulationError

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.scene.tables.loading.control import ControlTable
    from nmm.stepping.step.stepper import Stepper


def control_of(table: "ControlTable", stepper: "Stepper", formulation: "Formulation") -> Control:
    """Return the control that a scene names.

    Raises
    ------
    FormulationError
        Where steps along a path cannot be solved.
    """
    faults = hindrances(stepper, formulation)
    if faults:
        raise FormulationError(*(f"loading.control: {what}: {why}" for what, why in faults))
    return CONTROLS.load(table.type).of(table)


def hindrances(stepper: "Stepper", formulation: "Formulation") -> list[tuple[str, str]]:
    """Return what hinders steps along a path, and what to do.

    Contact without springs, conditions held by multipliers, matter and effects that are not linear,
    blocks laid anew.
    """
    plan, faults = stepper.plan, []
    if plan.contact is None:
        faults.append(("a scene without contact", "expected [contact]"))
    if stepper.model.matter is not None:
        faults.append((stepper.model.bent, "expected elastic materials of small strain"))
    if plan.bent:
        faults.append(("effects whose forces are not linear", "expected linear ones"))
    if make_enforcement(formulation.contact.enforcement, dict(formulation.contact.options)).exact:
        what = f'[contact] enforcement: "{formulation.contact.enforcement}"'
        faults.append((what, 'expected springs: use enforcement = "penalty"'))
    if any(getattr(effect, "multipliers", 0) for effect in plan.effects.values()):
        faults.append(("conditions held by multipliers", "use another [supports] or [glue] method"))
    if formulation.rotation.update == "linear":
        faults.append(('[rotation] update: "linear"', 'use update = "exact"'))
    return faults
