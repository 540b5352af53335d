"""From states to what a run hands over: frames, history rows, and the totals of the summary."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from integration.arrays import Floats
from nmm.assembly.motion import MaterialPoints, State
from nmm.assembly.places import at_point
from nmm.effects.base import Setup
from nmm.effects.view import View
from nmm.errors import GeometryError
from nmm.frozen import with_parts
from nmm.model.planning.pressures import patch_pressures
from nmm.results.frame import Frame
from nmm.results.sink import Sink
from nmm.stepping.reports.declared import Declared
from nmm.stepping.reports.ledger import Ledger
from nmm.stepping.reports.lengths import StepLengths
from nmm.stepping.reports.output import Choice, Watch
from nmm.stepping.step.anchors import block_name
from nmm.stepping.step.stepper import Stepper
from nmm.stepping.step.trial import Attempt

if TYPE_CHECKING:
    from nmm.contact.points.contact_points import ContactPoints
    from nmm.fracture.growth.growing import GrowingCracks


@dataclass(frozen=True)
class Monitor:
    """A point whose displacement is recorded."""

    name: str
    points: MaterialPoints
    start: Floats


def monitors(setup: Setup, all_there: bool = True) -> list[Monitor]:
    """Return the monitors of a scene; of a stage those that are on its blocks.

    Raises
    ------
    GeometryError
        When a monitor lies on no material.
    """
    found = []
    for item in setup.scene.monitors:  # a handful
        place = at_point(setup.model.manifold, np.array(item.point), setup.regions(item.block))
        if not len(place) and not all_there:
            continue
        if not len(place):
            raise GeometryError(
                f"monitor {item.name}: {item.point}: expected a point of the material: move it "
                "onto a block"
            )
        first = place.points.take(np.array([0]))
        start = first.place(setup.start.frames, setup.start.deformation)[0]
        found.append(Monitor(item.name, first, start))
    return found


@dataclass(frozen=True)
class Totals:
    """What a recorder knows of the run so far.

    Attributes
    ----------
    ledger
        Energies, and the number of accepted steps.
    passes, frames
        Linear systems solved, and frames stored.
    residual, penetration, stiffest
        Largest relative out-of-balance force, overlap (m) and stiffness of a contact (N/m).
    deepest
        Which bodies overlapped most, and when, in words; empty before any did.
    largest, counts
        Contact points in each state: most of all steps, and after the last.
    watch
        What tells the events of a step.
    taken, periods
        Steps of this stretch of the run, and periods between frames that have passed.
    stored
        Whether the last state was stored as a frame.
    changes
        What events have changed so far, in words.
    since
        The state that the last change of what is solved has left; None before any.
    lengths
        Of the steps, where their error chooses them; else None.
    """

    ledger: Ledger = field(default_factory=Ledger)
    passes: int = 0
    frames: int = 0
    residual: float = 0.0
    penetration: float = 0.0
    deepest: str = ""
    stiffest: float = 0.0
    largest: Mapping[str, int] = field(default_factory=dict)
    counts: Mapping[str, int] = field(default_factory=dict)
    watch: Watch = field(default_factory=Watch)
    taken: int = 0
    periods: int = 0
    stored: bool = True
    changes: tuple[str, ...] = ()
    since: State | None = None
    lengths: StepLengths | None = None


@dataclass
class Recorder:
    """Writes to a sink and keeps the running totals of a run.

    Attributes
    ----------
    stepper, sink, monitors
        What is recorded, where to, and which points.
    choice
        Which states are stored as frames.
    declared
        Further quantities that frames and history hold.
    totals
        Of the steps so far.
    staged
        Whether what is solved may change.
    """

    stepper: Stepper
    sink: Sink
    monitors: list[Monitor]
    choice: Choice = field(default_factory=lambda: Choice(0.0, steps=1))
    declared: Declared = field(default_factory=Declared)
    totals: Totals = field(default_factory=Totals)
    staged: bool = False

    @property
    def steps(self) -> int:
        """Number of accepted steps."""
        return self.totals.ledger.steps

    @property
    def ledger(self) -> Ledger:
        """Energies so far."""
        return self.totals.ledger

    def freed_by(self, growth: "GrowingCracks") -> float:
        """Energy (J) that growth of cracks freed so far."""
        return growth.freed_until_now(self.ledger.freed(growth.name), self.ledger.in_store)

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
        plan, after, totals = self.stepper.plan, attempt.state, self.totals
        ledger = self.ledger.booked(plan, self.stepper.model, before, attempt, stands or after)
        if plan.fracture is not None:
            ledger = ledger.along(plan.fracture.arrived(after.load_factor, ledger.in_store))
        self.totals = with_parts(
            totals,
            ledger=ledger,
            passes=totals.passes + attempt.passes,
            residual=max(totals.residual, attempt.residual),
            taken=totals.taken + 1,
            stored=False,
            lengths=totals.lengths and totals.lengths.seen(after.time - before.time),
        )
        self.stepper.budget.taken += 1
        row = {
            "time": after.time,
            "load_factor": after.load_factor,
            "step": float(self.steps),
            "passes": float(attempt.passes),
            "residual": attempt.residual,
            **self.ledger.row,
        }
        if after.history:
            row["material_loss"] = self.ledger.material_loss
        if self.staged or plan.askers:
            row["change_energy"] = self.ledger.change_energy
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
        self.sink.row(row | self.declared.row(plan, lambda: self.view(after, contacts)))
        held = [f"{count} {name}" for name, count in self.totals.counts.items() if count]
        noun = "pass" if attempt.passes == 1 else "passes"
        return f"{attempt.passes} {noun}, contacts: {', '.join(held)}" if held else ""

    def choosing(self) -> None:
        """Count from now on how long steps are."""
        if self.totals.lengths is None:
            self.totals = with_parts(self.totals, lengths=StepLengths())

    def tried(self, rejected: int = 0, unresolved: int = 0) -> None:
        """Count steps that erred too much: those undone, and those taken all the same."""
        lengths = self.totals.lengths or StepLengths()
        rejected, unresolved = rejected + lengths.rejected, unresolved + lengths.unresolved
        lengths = with_parts(lengths, rejected=rejected, unresolved=unresolved)
        self.totals = with_parts(self.totals, lengths=lengths)

    def next_frame(self, time: float) -> float:
        """Return when (s) the next frame is asked for; infinite where no time counts."""
        return self.choice.next(self.choice.periods(time))

    def brought_to(self, state: State) -> None:
        """Book a state to which loose blocks were brought besides the steps of the run."""
        ledger = self.ledger
        if ledger.steps:
            ledger = ledger.changed(self.stepper.plan, self.stepper.model, state)
            self.totals = with_parts(self.totals, ledger=ledger)

    def offer(self, state: State, stage: str, contacts: "ContactPoints | None") -> None:
        """Hand over the state after the step just recorded, if it is to be a frame; once."""
        totals, choice = self.totals, self.choice
        watch, happened = totals.watch, frozenset[str]()
        if choice.events:
            watch, happened = watch.seen(totals.counts)
        due = choice.takes(state.time, totals.taken, totals.periods, happened)
        periods = max(choice.periods(state.time), totals.periods)
        self.totals = with_parts(totals, watch=watch, periods=periods)
        if due:
            self.frame(state, stage, contacts)

    def happened(
        self, state: State, stage: str, contacts: "ContactPoints | None", what: str
    ) -> None:
        """Keep what an event changed; its state is a frame where events are asked for."""
        changes = (*self.totals.changes, what)
        self.totals = with_parts(self.totals, changes=changes, stored=False)
        if "shape_changes" in self.choice.events:
            self.frame(state, stage, contacts)

    def frame(self, state: State, stage: str, contacts: "ContactPoints | None") -> None:
        """Hand over a frame."""
        self.sink.frame(self._made(state, stage, contacts))
        self.totals = with_parts(self.totals, frames=self.totals.frames + 1, stored=True)

    def last(self, state: State, stage: str, contacts: "ContactPoints | None") -> None:
        """Hand over the last state of a stretch, unless that was done."""
        if not self.totals.stored:
            self.frame(state, stage, contacts)

    def _made(self, state: State, stage: str, contacts: "ContactPoints | None") -> Frame:
        stepper, manifold = self.stepper, self.stepper.model.manifold
        place = stepper.place(state)
        body = manifold.element_body[manifold.elements.polygon_of_point]
        velocity = stepper.vertices.rows.apply(state.velocity)
        return Frame(
            index=self.totals.frames,
            time=state.time,
            load_factor=state.load_factor,
            stage=stage,
            points=place,
            displacement=place - stepper.reference,
            velocity=state.frames.to_global(body, velocity),
            stress=(view := self.view(state, contacts)).stress,
            **self._contact_arrays(state, contacts),
            fields=self.declared.fields(stepper.plan, view),
        )

    def view(self, state: State, contacts: "ContactPoints | None") -> View:
        """Return an accepted state with what can be read from it."""
        return View(self.stepper.model, state, contacts, self.stress)

    def stress(self, state: State) -> Floats:
        """Return the mean Cauchy stress (E, 3) of the elements in global axes (Pa)."""
        model, added = self.stepper.model, self.stepper.plan.added_stress(state)
        pressure = patch_pressures(self.stepper.plan, model, state)
        stress = model.stress(state, pressure)
        if added is not None:
            stress = stress + added
        return turned_stress(stress, state.frames.angle[model.manifold.element_body])

    def _contact_row(self, attempt: Attempt, contacts: "ContactPoints") -> dict[str, float]:
        from nmm.contact.problem.contact_state import NAMES

        contact = self.stepper.plan.contact
        assert contact is not None
        penetration, totals = -float(contacts.gap.min(initial=0.0)), self.totals
        deepest = totals.deepest
        if penetration > totals.penetration:
            deepest = self._pair(contacts, int(contacts.gap.argmin()), attempt.state.time)
        tally = np.bincount(contacts.state, minlength=len(NAMES)).tolist()
        counts = dict(zip(NAMES, tally, strict=True))
        counts["broken"] = contact.broken_bonds
        self.totals = with_parts(
            totals,
            stiffest=max(totals.stiffest, contact.solver.stiffest or 0.0),
            penetration=max(totals.penetration, penetration),
            deepest=deepest,
            largest={name: max(totals.largest.get(name, 0), n) for name, n in counts.items()},
            counts=counts,
        )
        lost = {"friction_loss": self.ledger.friction_loss}
        if attempt.booked is not None:
            lost["contact_loss"] = self.ledger.contact_loss
        return {
            "penetration": penetration,
            **lost,
            **{name: float(count) for name, count in counts.items()},
        }

    def _pair(self, contacts: "ContactPoints", at: int, time: float) -> str:
        """Say between which blocks a contact point is, and when it was so."""
        made = self.stepper.discretisation
        owner = made.model.manifold.boundary.body
        bodies = owner[[contacts.edge_a[at], contacts.edge_b[at]]]
        pair = [block_name(made.model, body, made.setup.region_name) for body in bodies]
        when = f" at {time:.4g} s" if "inertia" in made.plan.effects else ""
        return " and ".join(pair) + when

    def _contact_arrays(self, state: State, contacts: "ContactPoints | None") -> dict[str, Any]:
        contact = self.stepper.plan.contact
        if contacts is None or contact is None:
            return no_contacts()
        return {
            "contact_position": contact.partners.position(contacts, state),
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
