"""The control that a scene names, where steps along a path can be solved."""

from typing import TYPE_CHECKING

from nmm.contact.enforcement.base import make_enforcement
from nmm.controls.base import CONTROLS, Control
from nmm.errors import FormulationError
from nmm.stepping.control.trials import Trials

if TYPE_CHECKING:
    from nmm.formulation import Formulation
    from nmm.scene.tables.loading.control import ControlTable
    from nmm.stepping.step.stepper import Stepper


ELASTIC = 'use law = "elastic" and small strain, or let the load grow without [loading.control]'


def control_of(table: "ControlTable") -> Control:
    """Return the control that a scene names."""
    return CONTROLS.load(table.type).of(table)


def check_path(table: "ControlTable", stepper: "Stepper", formulation: "Formulation") -> None:
    """Check that a path can be followed from the start of a scene.

    Raises
    ------
    FormulationError
        Where steps along a path cannot be solved, or it would have no beginning.
    """
    faults = hindrances(stepper, formulation)
    if control_of(table).from_limit and not faults and not Trials(stepper, {}).may_give_way():
        what = f'type: "{table.type}": no bond breaks, or begins to soften, at a limit of its own'
        faults.append((what, 'use "displacement" or "opening", or no normal_stiffness of bonds'))
    if faults:
        raise FormulationError(*(f"[loading.control] {what}: {why}" for what, why in faults))


def hindrances(stepper: "Stepper", formulation: "Formulation") -> list[tuple[str, str]]:
    """Return what hinders steps along a path, and what to do.

    Contact without springs, conditions held by multipliers, matter and effects that are not linear,
    blocks laid anew.
    """
    plan, faults = stepper.plan, []
    if plan.contact is None:
        faults.append(("a scene without contact", "expected [contact]"))
    if stepper.model.matter is not None:
        faults.append((stepper.model.bent, ELASTIC))
    if lost := [name for name, effect in plan.bent.items() if not effect.on_paths]:
        which = f"forces of {', '.join(lost)} that are not linear"
        faults.append((which, "leave them out, or let the load grow without [loading.control]"))
    if make_enforcement(formulation.contact.enforcement, dict(formulation.contact.options)).exact:
        what = f'[contact] enforcement: "{formulation.contact.enforcement}"'
        faults.append((what, 'expected springs: use enforcement = "penalty"'))
    if any(getattr(effect, "multipliers", 0) for effect in plan.effects.values()):
        faults.append(("conditions held by multipliers", "use another [supports] or [glue] method"))
    if formulation.rotation.update == "linear":
        faults.append(('[rotation] update: "linear"', 'use update = "exact"'))
    return faults
