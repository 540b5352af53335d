"""Hands over accepted steps: a row of the history each, frames where they are due, and totals."""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from nmm.assembly.state import State
from nmm.effects.base import Instant
from nmm.effects.view import View
from nmm.frozen import with_parts
from nmm.results.sink import RESETS, Sink
from nmm.stepping.reports.contact_tally import tallied
from nmm.stepping.reports.declared import DeclaredOutputs
from nmm.stepping.reports.framing import framed, viewed
from nmm.stepping.reports.ledger import Ledger
from nmm.stepping.reports.lengths import StepLengths
from nmm.stepping.reports.monitors import Monitor, monitored
from nmm.stepping.reports.output import FrameChoice
from nmm.stepping.reports.totals import Totals
from nmm.stepping.reports.zero import ZeroDisplacement
from nmm.stepping.step.stepper import Stepper
from nmm.stepping.step.trial import Attempt

if TYPE_CHECKING:
    from nmm.contact.points.contact_points import ContactPoints
    from nmm.fracture.growth.growing import GrowingCracks


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
    zero
        What displacements count from.
    before
        Where the last step began; None before the first one.
    """

    stepper: Stepper
    sink: Sink
    monitors: list[Monitor]
    choice: FrameChoice = field(default_factory=lambda: FrameChoice(0.0, steps=1))
    declared: DeclaredOutputs = field(default_factory=DeclaredOutputs)
    totals: Totals = field(default_factory=Totals)
    staged: bool = False
    zero: ZeroDisplacement = field(default_factory=ZeroDisplacement)
    before: State | None = None

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
        return growth.energy_freed(self.ledger.freed(growth.name), self.ledger.in_store)

    def step(
        self,
        before: State,
        attempt: Attempt,
        contacts: "ContactPoints | None",
        stands: State | None = None,
        anew: bool = False,
    ) -> str:
        """Record an accepted step in the history; say its passes and the states of contacts.

        ``stands`` is its end where blocks are laid anew after each step. With ``anew`` it only
        finds the balance after a change of what is solved.
        """
        declared, after = self.declared, attempt.state
        with self.stepper.clock.phase("reports"):
            self._book(before, attempt, stands, anew)
            row = self._row(before, attempt, contacts)
            self.sink.row(row | declared.row(self.stepper.plan, lambda: self.view(after, contacts)))
        counted = [f"{count} {name}" for name, count in self.totals.counts.items() if count]
        noun = "pass" if attempt.passes == 1 else "passes"
        return f"{attempt.passes} {noun}, contacts: {', '.join(counted)}" if counted else ""

    def _book(self, before: State, attempt: Attempt, stands: State | None, anew: bool) -> None:
        """Count an accepted step and what it did to the energies."""
        plan, after, totals = self.stepper.plan, attempt.state, self.totals
        step = before, attempt, stands or after
        ledger = self.ledger.booked(plan, self.stepper.model, *step, anew=anew)
        if plan.fracture is not None:
            name = plan.fracture.name
            booked = ledger.in_store, ledger.freed(name)
            ledger = ledger.along(plan.fracture.arrived(after.load_factor, *booked), name)
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
        self.before = before

    def _row(
        self, before: State, attempt: Attempt, contacts: "ContactPoints | None"
    ) -> dict[str, float]:
        """Return the numbers of a booked step by their columns of the history."""
        plan, after, ledger = self.stepper.plan, attempt.state, self.ledger
        row = {
            "time": after.time,
            "load_factor": after.load_factor,
            "step": float(self.steps),
            "passes": float(attempt.passes),
            "residual": attempt.residual,
            **ledger.row,
        }
        if after.history:
            row["material_loss"] = ledger.material_loss
        if self.staged or plan.askers:
            row["change_energy"] = ledger.change_energy
        if attempt.booked is not None:
            row["integration_loss"] = ledger.integration_loss
        if contacts is not None:
            self.totals, overlap = tallied(self.totals, self.stepper, contacts, before, attempt)
            row |= {"penetration": overlap, "friction_loss": ledger.friction_loss}
            if attempt.booked is not None:
                row["contact_loss"] = ledger.contact_loss
            row |= {name: float(count) for name, count in self.totals.counts.items()}
        if plan.supports is not None:
            for name, force in plan.supports.reactions(after).items():
                row[f"reaction:{name}:x"], row[f"reaction:{name}:y"] = force
        if self.zero.resets:
            row[RESETS] = float(self.zero.resets)
        return row | monitored(self.monitors, after)

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
        """Return when (s) the next frame is requested; infinite where no time counts."""
        return self.choice.next(self.choice.periods(time))

    def brought_to(self, state: State, end: Instant) -> None:
        """Book a state to which loose blocks were brought under ``end`` besides the run's steps."""
        ledger, contact = self.ledger, self.stepper.plan.contact
        if not ledger.steps and contact is not None:
            contact.stands(state)
        if ledger.steps:
            ledger = ledger.changed(self.stepper.plan, self.stepper.model, state, rested=end)
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
        """Keep what an event changed; its state is a frame where events are requested."""
        changes = (*self.totals.changes, what)
        self.totals = with_parts(self.totals, changes=changes, stored=False)
        if "shape_changes" in self.choice.events:
            self.frame(state, stage, contacts)

    def frame(self, state: State, stage: str, contacts: "ContactPoints | None") -> None:
        """Hand over a frame."""
        frames = self.totals.frames
        with self.stepper.clock.phase("reports"):
            view = self.view(state, contacts)
            self.sink.frame(framed(self.stepper, view, self.declared, self.zero, frames, stage))
        self.totals = with_parts(self.totals, frames=frames + 1, stored=True)

    def last(self, state: State, stage: str, contacts: "ContactPoints | None") -> None:
        """Hand over the last state of a stretch, unless that was done."""
        if not self.totals.stored:
            self.frame(state, stage, contacts)

    def view(self, state: State, contacts: "ContactPoints | None") -> View:
        """Return an accepted state with what can be read from it."""
        return viewed(self.stepper, state, contacts)
