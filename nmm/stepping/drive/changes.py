"""How a run continues on a changed discretisation, after a stage or an event in mid-run.

Blocks and cracks have another geometry, the state is carried over to it, effects follow, the
recorder goes on with the new model and the sink is told the new elements. An event is requested by
an effect (`nmm.effects.base.Effect.event`) after an accepted step; a scene without such effects
pays one look at an empty list.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from covers.change.parentage import same_elements
from integration.arrays import Floats
from nmm.assembly.state import State
from nmm.frozen import with_parts
from nmm.results.frame import Topology
from nmm.stepping.reports.monitors import monitors
from nmm.stepping.reports.recorder import Recorder

if TYPE_CHECKING:
    from nmm.contact.points.contact_points import ContactPoints
    from nmm.effects.base import Setup
    from nmm.effects.change import Change
    from nmm.effects.event import Event

Asked = tuple[tuple[str, "Event"], ...]
"""Events by the names of the effects that ask for them."""


@dataclass(frozen=True)
class AcceptedState:
    """An accepted state with its contacts, what has happened in it, in words, and the changes."""

    state: State
    contacts: "ContactPoints | None"
    what: str = ""
    changes: "tuple[Change, ...]" = ()


def asked(recorder: Recorder, at: AcceptedState) -> Asked:
    """Return the events that effects ask for, by their names; nothing is changed."""
    plan = recorder.stepper.plan
    if not plan.askers:
        return ()
    view = recorder.view(at.state, at.contacts)
    with recorder.stepper.clock.phase("events"):
        found = [(name, plan.event(name, view)) for name in plan.askers]
    return tuple((name, event) for name, event in found if event is not None)


def with_events(recorder: Recorder, at: AcceptedState, events: Asked, stage: str) -> AcceptedState:
    """Change what was asked for, one event after the other; return what stands then."""
    stepper = recorder.stepper
    said: list[str] = []
    changes: list[Change] = []
    for name, event in events:  # a handful of effects
        # What one has changed another has not seen.
        now = stepper.plan.event(name, recorder.view(at.state, at.contacts)) if said else event
        if now is None:
            continue
        change = stepper.reshape(now.geometry, at.state, now.continuous)
        follow(recorder, change, name)
        contact = stepper.plan.contact
        at = AcceptedState(change.state, None if contact is None else contact.standing)
        said.append(now.what)
        changes.append(change)
    if not said:
        return at
    what = ", ".join(said)
    recorder.happened(at.state, stage, at.contacts, f"at {at.state.time:.6g}: {what}")
    return AcceptedState(at.state, at.contacts, what, tuple(changes))


def follow(
    recorder: Recorder,
    change: "Change",
    cause: str = "",
    reset: bool = False,
    unheld: Floats | None = None,
) -> None:
    """Record the new model from now on: monitors, elements, and what it did to the energies.

    ``cause`` is the effect that asked for it, none of a stage; ``reset`` lets displacements count
    from here; ``unheld`` (n,) is what it leaves out of balance (N), where that is known.
    """
    recorder.zero = recorder.zero.followed(change, reset)
    recorder.monitors = monitors(change.setup, all_there=False, zero=recorder.zero.state)
    stepper, totals = recorder.stepper, recorder.totals
    ledger = totals.ledger.changed(stepper.plan, stepper.model, change.state, cause, unheld)
    recorder.totals = with_parts(totals, ledger=ledger, since=change.state)
    if not same_elements(change.old.manifold, change.new.manifold):
        recorder.sink.begin(topology(change.setup))


def topology(setup: "Setup") -> Topology:
    """Return the elements of a model as frames need them."""
    manifold = setup.model.manifold
    return Topology(
        elements=manifold.elements,
        element_region=manifold.element_region,
        region_material=np.asarray(setup.region_material, dtype=np.int64),
        material_names=tuple(setup.scene.materials),
        region_names=setup.region_name,
    )


def difference(change: "Change") -> str:
    """Say what changed: blocks and unknowns."""
    old, new = (set(m.manifold.element_region.tolist()) for m in (change.old, change.new))
    said = [f"{len(old - new)} blocks removed"] if old - new else []
    said += [f"{len(new - old)} blocks added"] if new - old else []
    before, after = change.old.manifold.n_unknowns, change.new.manifold.n_unknowns
    return ", ".join([*said, f"{after} unknowns after {before}"])
