"""An accepted state as it is handed over: as a view for those who read it, as a frame to store."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from integration.arrays import Floats, columns
from nmm.assembly.kept import kept_of_object
from nmm.assembly.state import State
from nmm.effects.view import View
from nmm.model.planning.across import stress_across
from nmm.model.planning.pressures import patch_pressures
from nmm.quantity import Quantity
from nmm.results.frame import Frame
from nmm.stepping.reports.declared import DeclaredOutputs
from nmm.stepping.reports.zero import ZeroDisplacement
from nmm.stepping.step.stepper import Stepper

if TYPE_CHECKING:
    from nmm.contact.points.contact_points import ContactPoints


def viewed(stepper: Stepper, state: State, contacts: "ContactPoints | None") -> View:
    """Return a state with what can be read from it; stress is computed when it is requested."""
    stresses = _Stresses(stepper)
    return View(stepper.model, state, contacts, stresses.whole, stresses.across)


@dataclass(frozen=True)
class _Stresses:
    """Mean stresses of the elements."""

    stepper: Stepper

    @kept_of_object
    def of_strain(self, state: State) -> Floats:
        """Return those (E, 3) by their strain, in body axes (Pa)."""
        model = self.stepper.model
        return model.stress(state, patch_pressures(self.stepper.plan, model, state))

    def whole(self, state: State) -> Floats:
        """Return Cauchy stresses (E, 3) in global axes, with what effects add (Pa)."""
        stress, added = self.of_strain(state), self.stepper.plan.added_stress(state)
        if added is not None:
            stress = stress + added
        return _turned(stress, state.frames.angle[self.stepper.model.manifold.element_body])

    def across(self, state: State) -> Floats | None:
        """Return those across the plane (E,) (Pa); None in plane stress."""
        stepper = self.stepper
        return stress_across(stepper.plan, stepper.model, state, self.of_strain(state))


def framed(
    stepper: Stepper,
    view: View,
    declared: DeclaredOutputs,
    zero: ZeroDisplacement,
    index: int,
    stage: str,
) -> Frame:
    """Return the frame of a state; ``declared`` are its quantities besides."""
    state = view.state
    place = stepper.place(state)
    start = stepper.reference if zero.state is None else stepper.place(zero.state)
    return Frame(
        index=index,
        time=state.time,
        load_factor=state.load_factor,
        stage=stage,
        points=place,
        displacement=place - start,
        velocity=stepper.velocity(state),
        stress=view.stress,
        **_contact_arrays(stepper, view),
        fields=_across_field(view) | declared.fields(stepper.plan, view),
    )


def _across_field(view: View) -> dict[str, Quantity]:
    """Return the stress across the plane as a quantity of a frame; none in plane stress."""
    across = view.stress_across
    return {} if across is None else {"stress_zz": Quantity("elements", across, "Pa")}


def _turned(stress: Floats, angle: Floats) -> Floats:
    """Return stresses (E, 3) of bodies turned by ``angle`` (E,) in global axes: Mohr's circle."""
    mean, half = (stress[:, 0] + stress[:, 1]) / 2, (stress[:, 0] - stress[:, 1]) / 2
    c, s = np.cos(2 * angle), np.sin(2 * angle)
    off = half * c - stress[:, 2] * s
    return columns(mean + off, mean - off, half * s + stress[:, 2] * c)


def _contact_arrays(stepper: Stepper, view: View) -> dict[str, Any]:
    """Return the contact arrays of a frame, which are empty without contacts."""
    contacts, contact = view.contacts, stepper.plan.contact
    if contacts is None or contact is None:
        empty, pairs = np.zeros(0), np.zeros((0, 2))
        return {
            "contact_position": pairs,
            "contact_normal": pairs,
            "contact_length": empty,
            "contact_force": pairs,
            "contact_gap": empty,
            "contact_state": np.zeros(0, dtype=np.int64),
        }
    return {
        "contact_position": contact.partners.position(contacts, view.state),
        "contact_normal": contacts.normal,
        "contact_length": contacts.length,
        "contact_force": columns(contacts.normal_force, contacts.shear_force),
        "contact_gap": contacts.distance,
        "contact_state": contacts.state,
    }
