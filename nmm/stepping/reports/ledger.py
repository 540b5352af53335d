"""The energies of a run, booked step by step, and how far they are from balance."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from integration.arrays import Floats
from nmm.assembly.state import State
from nmm.effects.base import Instant
from nmm.frozen import with_parts
from nmm.stepping.reports.accounts import EnergyRise, EnergySources
from nmm.stepping.reports.energies import standing, stored, untouched
from nmm.stepping.reports.energy_totals import EnergyTotals
from nmm.stepping.step.trial import Attempt

if TYPE_CHECKING:
    from nmm.assembly.model import Model
    from nmm.model.planning.plan import Plan
    from nmm.stepping.step.booking import BookedWork


@dataclass(frozen=True)
class Ledger(EnergyTotals):
    """Totals over accepted steps that the next step, or a change of what is solved, adds to.

    In statics nothing acts before the first step: what acts at its start (weight, initial stress,
    loads and displacements of supports that are not scaled) grows from nothing in it, and so does
    its work.
    """

    def booked(
        self,
        plan: "Plan",
        model: "Model",
        before: State,
        attempt: Attempt,
        stands: State,
        anew: bool = False,
    ) -> "Ledger":
        """Return the totals with an accepted step; ``stands`` is its end as blocks are laid now.

        All that a step which only finds the balance ``anew`` makes or sheds is the change's.
        """
        after = attempt.state
        earlier = self.energies if self.steps else untouched(plan, model, before)
        loss = 0.0 if attempt.solved is None else attempt.solved.loss
        dissipated = model.dissipated(before, after)
        missed = plan.missed_losses(before, after) if attempt.booked is None else {}
        found = with_parts(
            self,
            work=self.worked(plan, before, attempt) + sum(missed.values()),
            friction_loss=self.friction_loss + loss,
            friction_first=self.friction_first if self.steps else loss,
            friction_gift=self.friction_gift + max(-loss, 0.0),
            material_loss=self.material_loss + dissipated,
            material_gift=self.material_gift + max(-dissipated, 0.0),
            effect_loss={
                name: self.effect_loss.get(name, 0.0) + lost + missed.get(name, 0.0)
                for name, lost in plan.losses(before, after).items()
            },
            energies=stored(plan, model, stands),
            stored_first=self._stored_first(plan, before, earlier),
            steps=self.steps + 1,
            settling=False,
            unheld=None,
            rested=None,
        )
        if self.settling and plan.inertia is None:
            made, shed = found.made - self.made, self._shed(attempt)
            found = found._changed_by(made if anew else shed + min(made - shed, 0.0), self.cause)
        if attempt.booked is not None:
            found = found._lost_in_time(attempt.booked, earlier, loss)
        return found.weighed(after.time, audited=attempt.booked is not None)

    def _shed(self, attempt: Attempt) -> float:
        """Return what a step adds (J) whose start is out of balance: nothing is there to hold it.

        Held by a force that fades evenly in the step, as loads change in it, it would add nothing:
        that force would do half of its work, ``-r d / 2``.
        """
        return 0.0 if self.unheld is None else -float(self.unheld @ attempt.increment) / 2

    def worked(self, plan: "Plan", before: State, attempt: Attempt) -> float:
        """Return the work (J) of all steps and of an accepted one.

        Along paths it counts what loads do between its ends. The step after a change begins out of
        balance, and has no mean load.
        """
        work, after = self.work, attempt.state
        grows, before = self._grows(plan), _under(self.rested, before)
        if grows:
            work += plan.first_work(before, after)
        work += plan.work(before, after)
        if grows:
            work -= standing(plan, before, after)
        if attempt.solved is not None and not self.settling:
            work += attempt.solved.between
        return work + (0.0 if attempt.booked is None else attempt.booked.late)

    def released(self, plan: "Plan", model: "Model", before: State, attempt: Attempt) -> float:
        """Return the energy (J) of a step that is neither stored nor taken, and was no motion."""
        after = attempt.state
        first = untouched(plan, model, before)
        had = sum(self.energies.values()) if self.steps else self._stored_first(plan, before, first)
        has = sum(stored(plan, model, after).values()) + sum(plan.losses(before, after).values())
        return self.worked(plan, before, attempt) - self.work - has + had

    def _stored_first(self, plan: "Plan", before: State, earlier: Mapping[str, float]) -> float:
        """Return the energy (J) at the start of all: ``earlier`` is that at the start of a step."""
        if self.steps:
            return self.stored_first
        found = sum(earlier.values())
        return found - plan.energy("supports", before) if self._grows(plan) else found

    def _grows(self, plan: "Plan") -> bool:
        """Whether the next step is the first one of statics, in which all grows from nothing."""
        return not self.steps and plan.inertia is None

    def along(self, more: float, cause: str) -> "Ledger":
        """Return the totals where changes free ``more`` (J) on the way of loads than along chords.

        Work does what is freed beyond the chord. ``cause`` is the effect that asked for them.
        """
        return replace(self, work=self.work + more)._changed_by(-more, cause)

    def changed(
        self,
        plan: "Plan",
        model: "Model",
        state: State,
        cause: str | None = None,
        unheld: Floats | None = None,
        rested: Instant | None = None,
    ) -> "Ledger":
        """Return the totals with a change of what is solved, on which ``state`` is now.

        ``cause`` is the effect that asked for it, "" a stage, None what did so last; ``unheld``
        (n,) is what it leaves out of balance (N); ``rested`` is the instant under which ``state``
        was brought to rest, whose driven supports stand where that has driven them.
        """
        energies = stored(plan, model, _under(rested, state))
        added = sum(energies.values()) - self.in_store
        cause = self.cause if cause is None else cause
        given = {"energies": energies, "settling": True, "unheld": unheld, "cause": cause}
        return with_parts(self, **given, rested=rested)._changed_by(added, cause)

    def _changed_by(self, added: float, cause: str) -> "Ledger":
        """Return the totals with energy (J) that changes added to what is stored."""
        by = {**self.changed_by, cause: self.changed_by.get(cause, 0.0) + added}
        return replace(self, change_energy=self.change_energy + added, changed_by=by)

    def _lost_in_time(
        self, step: "BookedWork", earlier: Mapping[str, float], loss: float
    ) -> "Ledger":
        """Return the totals with what a step in time lost that began with ``earlier`` energies."""
        gain = {name: value - earlier[name] for name, value in self.energies.items()}
        lost = step.integration_loss(gain["kinetic_energy"])
        damping = {
            name: self.damping_loss.get(name, 0.0) + more for name, more in step.damping.items()
        }
        return with_parts(
            self,
            damping_loss={**self.damping_loss, **damping},
            integration_loss=self.integration_loss + lost,
            given=self.given + max(-lost, 0.0),
            contact_loss=self.contact_loss + step.contact_loss(gain["contact_energy"], loss),
        )

    def weighed(self, time: float, audited: bool) -> "Ledger":
        """Return the totals with the size of the energies, and how much came from nowhere.

        Steps of statics are not ``audited``: what they make is no motion, and rises count from
        their end.
        """
        total, lost = self.in_store, self.dissipated
        largest = max(
            self.throughput, abs(self.work), abs(total), abs(self.stored_first), abs(lost)
        )
        supports = self.energies.get("support_energy", 0.0)
        made = self._made(total, lost)
        now = EnergySources(made, self.given, -self.contact_loss, self.friction_loss, supports)
        if not audited:
            return with_parts(self, throughput=largest, last=now, lowest=now)
        return with_parts(
            self,
            throughput=largest,
            in_step=self._largest(self.in_step, now, self.last, time),
            in_run=self._largest(self.in_run, now, self.lowest, time),
            last=now,
            lowest=now if made < self.lowest.made else self.lowest,
        )

    def _largest(
        self, known: EnergyRise, now: EnergySources, before: EnergySources, time: float
    ) -> EnergyRise:
        """Return the larger of a rise and the one to ``now`` since ``before``."""
        if now.made - before.made > known.energy:
            return EnergyRise(now.since(before), self.steps, time)
        return known


def _under(rested: Instant | None, state: State) -> State:
    """Return ``state`` under what acts when it ``rested``, which the load grows to anew."""
    if rested is None:
        return state
    return replace(state, time=rested.time, load_factor=rested.load_factor)
