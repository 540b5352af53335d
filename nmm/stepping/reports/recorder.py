"""From states to what a run hands over: frames, history rows, and the totals of the summary."""

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from integration.arrays import Floats
from nmm.assembly.motion import MaterialPoints, State
from nmm.assembly.places import at_point
from nmm.effects.base import Setup
from nmm.errors import GeometryError
from nmm.results.frame import Frame
from nmm.results.sink import Sink
from nmm.stepping.reports.ledger import Ledger
from nmm.stepping.reports.output import Choice, Watch
from nmm.stepping.step.stepper import Stepper
from nmm.stepping.step.trial import Attempt

if TYPE_CHECKING:
    from nmm.contact.points.contact_points import ContactPoints


@dataclass(frozen=True)
class Monitor:
    """A point whose displacement is recorded."""

    name: str
    points: MaterialPoints
    start: Floats


def monitors(setup: Setup) -> list[Monitor]:
    """Return the monitors of a scene.

    Raises
    ------
    GeometryError
        When a monitor lies on no material.
    """
    found = []
    for item in setup.scene.monitors:  # a handful
        place = at_point(setup.model.manifold, np.array(item.point), setup.regions(item.block))
        if not len(place):
            raise GeometryError(
                f"monitor {item.name}: {item.point}: expected a point of the material: move it "
                "onto a block"
            )
        first = place.points.take(np.array([0]))
        start = first.place(setup.start.frames, setup.start.deformation)[0]
        found.append(Monitor(item.name, first, start))
    return found


@dataclass
class Recorder:
    """Writes to a sink and keeps the running totals of a run.

    Attributes
    ----------
    stepper, sink, monitors
        What is recorded, where to, and which points.
    ledger
        Energies.
    choice
        Which states are stored as frames.
    """

    stepper: Stepper
    sink: Sink
    monitors: list[Monitor]
    ledger: Ledger = field(default_factory=Ledger)
    passes: int = 0
    choice: Choice = field(default_factory=lambda: Choice(0.0, steps=1))
    watch: Watch = field(default_factory=Watch)
    frames: int = 0
    residual: float = 0.0
    penetration: float = 0.0
    stiffest: float = 0.0
    largest: dict[str, int] = field(default_factory=dict)
    counts: dict[str, int] = field(default_factory=dict)
    _stored: State | None = None
    _kept: Frame | None = None

    @property
    def steps(self) -> int:
        """Number of accepted steps."""
        return self.ledger.steps

    def step(
        self,
        before: State,
        attempt: Attempt,
        contacts: "ContactPoints | None",
        stands: State | None = None,
    ) -> str:
        """Record an accepted step in the history; say its passes and the states of contacts.

        ``stands`` is its end where blocks are laid anew after each step.
        """
        plan, after = self.stepper.plan, attempt.state
        self.ledger.book(plan, self.stepper.model, before, attempt, stands or after)
        self.stepper.budget.taken += 1
        self.passes += attempt.passes
        self.residual = max(self.residual, attempt.residual)
        row = {
            "time": after.time,
            "load_factor": after.load_factor,
            "step": float(self.steps),
            "passes": float(attempt.passes),
            "residual": attempt.residual,
            **self.ledger.row,
        }
        if attempt.booked is not None:
            row["integration_loss"] = self.ledger.integration_loss
        if contacts is not None:
            row |= self._contact_row(attempt, contacts)
        if plan.supports is not None:
            for name, force in plan.supports.reactions(after).items():
                row[f"reaction:{name}:x"], row[f"reaction:{name}:y"] = force
        for monitor in self.monitors:
            way = monitor.points.place(after.frames, after.deformation)[0] - monitor.start
            row[f"monitor:{monitor.name}:ux"], row[f"monitor:{monitor.name}:uy"] = way
        self.sink.row(row)
        held = [f"{count} {name}" for name, count in self.counts.items() if count]
        noun = "pass" if attempt.passes == 1 else "passes"
        return f"{attempt.passes} {noun}, contacts: {', '.join(held)}" if held else ""

    def takes(self, state: State) -> bool:
        """Return whether the state after the step just recorded is to be a frame; ask once."""
        return self.choice.takes(state.time, self.watch.happened(self.counts))

    def frame(self, state: State, stage: str, contacts: "ContactPoints | None") -> None:
        """Hand over a frame."""
        self._hand_over(self._made(state, stage, contacts))
        self._stored = state

    def offer(self, state: State, stage: str, contacts: "ContactPoints | None") -> None:
        """Hand over a frame if it is to be stored; else keep it, as it may prove the last."""
        made, self._kept = self._made(state, stage, contacts), None
        if self.takes(state):
            self._hand_over(made)
        else:
            self._kept = made

    def last(self, state: State, stage: str, contacts: "ContactPoints | None") -> None:
        """Hand over the last state of a stretch, unless that was done."""
        if self._stored is not state:
            self.frame(state, stage, contacts)

    def flush(self) -> None:
        """Hand over what was offered last, unless that was done."""
        if self._kept is not None:
            self._hand_over(self._kept)
            self._kept = None

    def _hand_over(self, frame: Frame) -> None:
        self.sink.frame(replace(frame, index=self.frames))
        self.frames += 1

    def _made(self, state: State, stage: str, contacts: "ContactPoints | None") -> Frame:
        stepper, manifold = self.stepper, self.stepper.model.manifold
        place = stepper.place(state)
        body = manifold.element_body[manifold.elements.polygon_of_point]
        velocity = stepper.vertices.rows.apply(state.velocity)
        return Frame(
            index=self.frames,
            time=state.time,
            load_factor=state.load_factor,
            stage=stage,
            points=place,
            displacement=place - stepper.reference,
            velocity=state.frames.to_global(body, velocity),
            stress=self.stress(state),
            **self._contact_arrays(state, contacts),
        )

    def stress(self, state: State) -> Floats:
        """Return the mean Cauchy stress (E, 3) of the elements in global axes (Pa)."""
        model, initial = self.stepper.model, self.stepper.plan.initial_stress
        pressure = self.stepper.plan.pressure(model, state)
        stress = model.mean_stress(state.deformation, pressure)
        if initial is not None:
            stress = stress + initial.stress
        return turned_stress(stress, state.frames.angle[model.manifold.element_body])

    def _contact_row(self, attempt: Attempt, contacts: "ContactPoints") -> dict[str, float]:
        from nmm.contact.problem.contact_state import ContactState

        contact = self.stepper.plan.contact
        assert contact is not None
        penetration = -float(contacts.gap.min(initial=0.0))
        self.stiffest = max(self.stiffest, contact.stiffest or 0.0)
        self.penetration = max(self.penetration, penetration)
        tally = np.bincount(contacts.state, minlength=len(ContactState)).tolist()
        counts = {s.name.lower(): tally[s] for s in ContactState}
        counts["broken"] = contact.broken_bonds
        self.counts = counts
        for name, count in counts.items():
            self.largest[name] = max(self.largest.get(name, 0), count)
        lost = {"friction_loss": self.ledger.friction_loss}
        if attempt.booked is not None:
            lost["contact_loss"] = self.ledger.contact_loss
        return {
            "penetration": penetration,
            **lost,
            **{name: float(count) for name, count in counts.items()},
        }

    def _contact_arrays(self, state: State, contacts: "ContactPoints | None") -> dict[str, Any]:
        contact = self.stepper.plan.contact
        if contacts is None or contact is None:
            return no_contacts()
        return {
            "contact_position": contact.position(contacts, state),
            "contact_normal": contacts.normal,
            "contact_length": contacts.length,
            "contact_force": np.stack([contacts.normal_force, contacts.shear_force], axis=1),
            "contact_gap": contacts.gap,
            "contact_state": contacts.state,
        }


def turned_stress(stress: Floats, angle: Floats) -> Floats:
    """Return stresses (E, 3) of bodies turned by ``angle`` (E,) in global axes: Mohr's circle."""
    mean, half = (stress[:, 0] + stress[:, 1]) / 2, (stress[:, 0] - stress[:, 1]) / 2
    c, s = np.cos(2 * angle), np.sin(2 * angle)
    off = half * c - stress[:, 2] * s
    return np.stack([mean + off, mean - off, half * s + stress[:, 2] * c], axis=1)


def no_contacts() -> dict[str, Any]:
    """Return the contact arrays of a frame without contacts."""
    empty, pairs = np.zeros(0), np.zeros((0, 2))
    return {
        "contact_position": pairs,
        "contact_normal": pairs,
        "contact_length": empty,
        "contact_force": pairs,
        "contact_gap": empty,
        "contact_state": np.zeros(0, dtype=np.int64),
    }
