"""The energies of a state by name, and the work of what stands at the start of statics."""

from dataclasses import replace
from typing import TYPE_CHECKING

from nmm.assembly.state import State
from nmm.model.planning.energies import STORES
from nmm.model.planning.pressures import lifted_energy

if TYPE_CHECKING:
    from nmm.assembly.model import Model
    from nmm.model.planning.plan import Plan
# Effects whose springs count as supports: those of the scene, glue, and what holds sub-blocks.
HOLDING = STORES["support_energy"]
# Effects whose energy is that of the solid, beyond that of its strain.
STRAINING = STORES["strain_energy"]


def stored(plan: "Plan", model: "Model", state: State) -> dict[str, float]:
    """Return the energies (J) of a state by name."""
    found, lifted = plan.energies(state), lifted_energy(plan, model, state)
    found["strain_energy"] += model.strain_energy(state) + lifted
    found["support_energy"] -= lifted
    return found


def untouched(plan: "Plan", model: "Model", state: State) -> dict[str, float]:
    """Return the energies (J) before any step: contact tells that of the last accepted one."""
    contact = 0.0 if plan.contact is None else plan.contact.stored_first
    return {**stored(plan, model, state), "contact_energy": contact}


def standing(plan: "Plan", before: State, after: State) -> float:
    """Half the work (J) of what acts at the start of statics, weight and initial stress included.

    It is what holds a start that is not in equilibrium and is withdrawn evenly in the first step.
    What swells in that step has grown from nothing.
    """
    moved = replace(after, time=before.time, load_factor=before.load_factor, history=before.history)
    stress = sum(plan.energy(name, before) - plan.energy(name, moved) for name in STRAINING)
    stress += plan.received_stress_energy(before) - plan.received_stress_energy(moved)
    return (plan.work(before, moved) + stress) / 2
