"""What a scene and a formulation must not be together, and what a run of both could not tell."""

from collections.abc import Iterator, Sequence
from dataclasses import fields
from math import inf
from typing import TYPE_CHECKING

from nmm import capacity
from nmm.errors import Fault, FormulationError, SceneError
from nmm.results.quantity_names import ENERGY, parted
from nmm.results.summary import Summary
from nmm.scene.faults import suggestion

if TYPE_CHECKING:
    from nmm.assembly.moving.kinematics import Kinematics
    from nmm.formulation import Formulation
    from nmm.scene.model import Scene

COLUMNS = (
    *("time", "load_factor", "step", "passes", "residual", "external_work"),
    "integration_loss",
    *("kinetic_energy", "strain_energy", "contact_energy", "support_energy"),
)
# Steps that a scene must ask for: as many take a quarter of an hour of the smallest one.
MANY_STEPS = 1e6
CONTACT_COLUMNS = ("penetration", "friction_loss", "contact_loss", "broken")


def check_together(scene: "Scene", formulation: "Formulation") -> None:
    """Refuse steps that the duration does not hold and references that no run can be compared with.

    Raises
    ------
    NmmError
        All faults of this kind, one line each.
    """
    faults = [*_steps(scene, formulation), *_chosen(scene, formulation), *_references(scene)]
    if faults:
        raise SceneError(*faults)
    _refuse_many_steps(scene, formulation)


def _refuse_many_steps(scene: "Scene", formulation: "Formulation") -> None:
    """Refuse steps whose history no memory holds, and ones past counting that nobody chose."""
    table = formulation.integrator
    step, spans = table.fixed_step, [one.duration for one in scene.stages] or [scene.duration]
    if step is None or not scene.in_time:
        return
    chosen = "step" in table.model_fields_set
    at = formulation.source.place("integrator", "step")
    place = at if chosen else scene.source.place("stages" if scene.stages else "duration")
    time = sum(span for span in spans if span is not None)
    steps, remedy = time / step, "take longer steps"
    if steps > MANY_STEPS and not chosen:
        value = f"{steps:.3g} steps of {step:g} s, the default"
        remedy = f'write [formulation.integrator] step = "{time / 1000:.3g} s", or what resolves it'
        raise FormulationError(Fault(place, value, "a step that is chosen", remedy))
    capacity.refuse(place, f"{steps:.3g} steps", steps * capacity.STEP, remedy)


def check_kinematics(formulation: "Formulation", kinematics: "Kinematics") -> None:
    """Refuse an integrator of finite strain for bodies that know none.

    Raises
    ------
    FormulationError
        With the line of its type.
    """
    from nmm.integrators.base import make_integrator

    table = formulation.integrator
    if kinematics.finite or not make_integrator(table).conserves:
        return
    place = formulation.source.place("integrator", "type")
    value = f'"{table.type}" with axes that turn with the bodies, or stay'
    expected = "finite strain, whose energy the stress of a step can keep"
    remedy = 'add update = "finite" to [rotation], or use type = "newmark"'
    raise FormulationError(Fault(place, value, expected, remedy))


def known_quantities(scene: "Scene") -> list[str]:
    """Return the names of the numbers that a run of a scene gives: of its summary and history."""
    numbers = [item.name for item in fields(Summary) if _is_number(str(item.type))]
    columns = [f"monitor:{item.name}:u{axis}" for item in scene.monitors for axis in "xy"]
    columns += [f"reaction:{item.name}:{axis}" for item in scene.supports for axis in "xy"]
    columns += [f"water pressures:{item.name}:{a}" for item in scene.water_pressures for a in "xy"]
    if scene.seepage is not None:
        name = "consolidation" if scene.seepage.coupled else "seepage"
        columns += [f"{name}:{what}" for what in ("lowest", "highest", "stored")]
        columns += [f"{name}:taken:{item.name}" for item in (*scene.heads, *scene.inflows)]
    if scene.joint_flow is not None:
        stores = scene.joint_flow.transient
        name, of_head = ("transient joint flow", "taken") if stores else ("joint flow", "inflow")
        columns += [f"{name}:pressure", f"{name}:aperture"]
        columns += [f"{name}:{of_head}:{item.name}" for item in scene.joint_heads]
    if scene.heat is not None:
        columns += ["heat:lowest", "heat:highest", "heat:stored"]
        acting = (scene.temperatures, scene.heat_fluxes, scene.heat_sources, scene.convections)
        columns += [f"heat:taken:{item.name}" for items in acting for item in items]
    columns += [
        f"viscous boundaries:{item.name}:u{axis}"
        for item in scene.viscous_boundaries
        for axis in "xy"
    ]
    columns += [f"damping_loss:{name}" for name in _damping(scene)]
    if scene.contact is not None:
        from nmm.contact.problem.contact_state import ContactState

        columns += [*CONTACT_COLUMNS, *(state.name.lower() for state in ContactState)]
    return [*numbers, *COLUMNS, *columns]


def may_have_column(scene: "Scene", column: str, known: Sequence[str]) -> bool:
    """Whether a part that a scene names may give a column that is not among the ``known`` ones.

    Such are those of effects with none among these, and all where an output is of one's own.
    """
    from nmm.model.called_for import called_for

    if scene.output is not None and any(":" in one for one in scene.output.quantities):
        return True
    acting = {*scene.effects, *(name for name, wanted in called_for(scene).items() if wanted)}
    first, _, rest = column.partition(":")
    if first == "energy":
        return rest in acting
    return bool(rest) and first in acting and not any(one.startswith(f"{first}:") for one in known)


def _is_number(annotation: str) -> bool:
    return any(word in ("int", "float") for word in annotation.split(" | ")) or annotation in (
        "<class 'int'>",
        "<class 'float'>",
    )


def _damping(scene: "Scene") -> list[str]:
    """Names of the effects that a scene names whose losses are booked as those of dampers."""
    from nmm.effects.base import Effect
    from nmm.model.called_for import called_for
    from nmm.model.effects_table import EFFECTS

    named = [name for name, wanted in called_for(scene).items() if wanted]
    hooks = [(name, EFFECTS.load(name)) for name in named]
    return [
        name
        for name, kind in hooks
        if kind.damping is not Effect.damping or kind.added_mass is not Effect.added_mass
    ]


def _steps(scene: "Scene", formulation: "Formulation") -> Iterator[Fault]:
    step, duration = formulation.integrator.fixed_step, scene.duration
    if step is None or duration is None or not scene.in_time:
        return
    if step > (1 + 1e-9) * duration:
        place = formulation.source.place("integrator", "step")
        value = f"{step:g} s, longer than the duration of {duration:g} s"
        yield Fault(place, value, "a part of the duration", "take shorter steps")


def _chosen(scene: "Scene", formulation: "Formulation") -> Iterator[Fault]:
    """Yield what steps cannot be chosen by their error with."""
    from nmm.integrators.base import make_integrator

    table, place = formulation.integrator, formulation.source.place("integrator", "step")
    if table.fixed_step is not None:
        return
    explicit = make_integrator(table).limit < inf
    beside = {
        f'type = "{table.type}", whose steps are bounded by stability': explicit,
        "a kinetic_factor, which damps each step whatever its length": table.kinetic_factor < 1,
        '[rotation] update = "linear", whose steps cannot be undone': (
            formulation.rotation.update == "linear"
        ),
        "[[free_fields]], whose columns have steps of one length": bool(scene.free_fields),
    }
    for what, there in beside.items():
        if there:
            remedy = "give a step in s, or remove it"
            yield Fault(place, f'"auto" with {what}', "steps that may have any length", remedy)


def _references(scene: "Scene") -> Iterator[Fault]:
    known = [ENERGY, *known_quantities(scene)] if scene.references else []
    for index, item in enumerate(scene.references):
        name, sought = item.quantity, parted(item.quantity)[1]
        if sought not in known and not may_have_column(scene, sought, known):
            place = scene.source.place("reference", index, "quantity")
            expected = "a number of the summary or a column of the history, or max: or min: of one"
            yield Fault(place, f'"{name}"', expected, suggestion(name, known))
