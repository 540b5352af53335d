"""The residual at the start of a stage: what leaves no longer pushes what stays."""

from typing import TYPE_CHECKING

from integration.arrays import Floats
from nmm.assembly.matter import Matter
from nmm.effects.base import Instant
from nmm.model.planning.plan import Plan
from nmm.solvers.unchecked import product

if TYPE_CHECKING:
    from nmm.effects.change import Change


def out_of_balance(plan: Plan, change: "Change") -> Floats:
    """Return the force (n,) on the unknowns of a new model before anything has moved.

    Of all effects, of matter and of contacts as they were carried over; what conditions by
    multipliers would exert is part of it.
    """
    state, model = change.state, change.new
    found = plan.force(state, Instant(state.time, 0.0))
    matter = model.matter
    if isinstance(matter, Matter):
        found -= matter.internal(state.deformation, state.history)
    else:
        found -= product(model.stiffness, state.deformation)
    if plan.contact is not None:
        found -= plan.contact.push(state)
    return found
