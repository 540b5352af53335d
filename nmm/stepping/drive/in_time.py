"""Progress of a run in time: its state, the time left, and its steps."""

from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING

from nmm.assembly.moving.motion import coordinate_rounding
from nmm.assembly.state import State
from nmm.frozen import with_parts

if TYPE_CHECKING:
    from nmm.contact.points.contact_points import ContactPoints
    from nmm.formulation import Formulation
    from nmm.stepping.adaptive.control import StepChoice, StepControl
    from nmm.stepping.step.stepper import Stepper

# Of a step, about what sums of many steps are off by: 20 000 steps are 20 000, not one more of
# 1e-12 s at the end.
ROUNDED_TIME = 1e-6


@dataclass(frozen=True)
class Schedule:
    """Times of a dynamic run.

    Attributes
    ----------
    duration, step
        s; the step that is tried first where errors choose.
    load_factor
        Factor on the scaled loads, constant in dynamics.
    stage
        Name of the frames' stage.
    events
        Whether effects may change what is solved.
    control
        What steps are chosen by; None where all are of one length.
    """

    duration: float
    step: float
    load_factor: float = 1.0
    stage: str = "dynamic"
    events: bool = True
    control: "StepControl | None" = None

    @classmethod
    def of(
        cls,
        stepper: "Stepper",
        formulation: "Formulation",
        duration: float,
        load_factor: float = 1.0,
        stage: str = "dynamic",
        events: bool = True,
    ) -> "Schedule":
        """Return the times of a run that a formulation approximates."""
        fixed, control = formulation.integrator.fixed_step, None
        if fixed is None:
            control = control_of(stepper, formulation, duration)
            fixed = control.first
        return cls(duration, fixed, load_factor, stage, events, control)


def control_of(stepper: "Stepper", formulation: "Formulation", duration: float) -> "StepControl":
    """Return the step control of a run; no step passes over a sample of a record."""
    from nmm.stepping.adaptive.control import StepControl

    table, plan = formulation.integrator, stepper.plan
    records = [one.resolves / 2 for one in plan.effects.values() if one.resolves is not None]
    manifold, contact = stepper.model.manifold, plan.contact
    blocks = contact is not None and len(manifold.element_body) == manifold.n_bodies
    rigid = blocks if table.error_of in (None, "auto") else table.error_of == "bodies"
    order, finest = stepper.integrator.order, min(records, default=inf)
    return with_parts(
        StepControl.of(table, order, duration, finest),
        rigid=rigid and stepper.kinematics.turns,
        impacts=contact is not None and not contact.exact,
        rounded=float(coordinate_rounding(manifold).max()),
    )


@dataclass(frozen=True)
class InTime:
    """Progress of a run in time.

    Attributes
    ----------
    state, contacts
        The last accepted state, and its contacts as left.
    begin
        Time at which the run began (s).
    step
        Length of the next step, before it is cut (s).
    cuts, why
        Number of steps that were cut so far, and when and why the last one was.
    chosen
        What the control of steps carries on; None where all are of one length.
    """

    state: State
    contacts: "ContactPoints | None"
    begin: float
    step: float
    cuts: int = 0
    why: str = ""
    chosen: "StepChoice | None" = None

    @classmethod
    def at_start(cls, state: State, schedule: Schedule) -> "InTime":
        """Return the start of a run from ``state``."""
        chosen = None if schedule.control is None else schedule.control.beginning
        return cls(state, None, state.time, schedule.step, chosen=chosen)

    def with_cut(self, why: str) -> "InTime":
        """Return it after a step that was cut."""
        return with_parts(self, cuts=self.cuts + 1, why=why)

    def rest(self, schedule: Schedule) -> float:
        """Return the time that is left (s); zero at the end."""
        rest = self.begin + schedule.duration - self.state.time
        return rest if rest > ROUNDED_TIME * schedule.step else 0.0
