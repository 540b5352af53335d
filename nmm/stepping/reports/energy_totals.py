"""The energies of a run in total: what is stored, was done and taken, and what is missing."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from integration.arrays import Floats
from nmm.effects.base import Instant
from nmm.stepping.reports.accounts import EnergyRise, EnergySources


@dataclass(frozen=True)
class EnergyTotals:
    """Totals over accepted steps (J).

    Attributes
    ----------
    work, friction_loss, material_loss
        Work of loads, weight and driven supports; what friction, dashpots and breaking bonds took;
        and what material points did, which flow or suffer damage.
    friction_first, friction_gift
        What friction and breaking bonds took in the first step; and what they gave in the steps in
        which they took less than nothing.
    material_gift
        What material points gave in the steps in which they took less than nothing: stresses that
        turn about within a step do work on what flows at its end.
    damping_loss
        What dampers took, by effect.
    effect_loss
        What effects took for good, by name.
    integration_loss, contact_loss
        What time integration took, but for contact; and what springs of contact lost beyond
        friction: both are part of what is missing in the balance, and negative where energy came.
    energies
        Stored now, by name.
    stored_first
        Energy at the start, before any contact.
    throughput
        Largest work, stored or lost energy so far.
    steps
        Number of accepted steps.
    in_step, in_run
        Largest rise of stored energy and losses less work, in one step and over the run.
    given
        What the integrator gave in the steps in which it gave some.
    change_energy
        What changes of what is solved have added to the stored energies, the energy shed in the
        first step of statics after one included: with all that is new acting at once, more work is
        done than a slow change needs.
    changed_by
        The same by the effect that asked for the changes; "" is a stage, or rest that was sought.
    settling
        Whether that step is the next one.
    unheld
        (n,) what the last change left out of balance (N), which nothing holds while that step is
        solved; None where that is not known.
    rested
        Instant under whose loads and displacements loose blocks were last brought to rest, until
        the next step is solved; None: it begins under those of its start.
    cause
        What asked for the last change.
    lowest, last
        Where energy from nowhere was least, and after the last step.
    """

    work: float = 0.0
    friction_loss: float = 0.0
    friction_first: float = 0.0
    friction_gift: float = 0.0
    material_loss: float = 0.0
    material_gift: float = 0.0
    damping_loss: Mapping[str, float] = field(default_factory=dict)
    effect_loss: Mapping[str, float] = field(default_factory=dict)
    integration_loss: float = 0.0
    contact_loss: float = 0.0
    energies: Mapping[str, float] = field(default_factory=dict)
    stored_first: float = 0.0
    throughput: float = 0.0
    steps: int = 0
    in_step: EnergyRise = field(default_factory=EnergyRise)
    in_run: EnergyRise = field(default_factory=EnergyRise)
    given: float = 0.0
    change_energy: float = 0.0
    changed_by: Mapping[str, float] = field(default_factory=dict)
    settling: bool = False
    unheld: Floats | None = None
    rested: Instant | None = None
    cause: str = ""
    lowest: EnergySources = field(default_factory=EnergySources)
    last: EnergySources = field(default_factory=EnergySources)

    @property
    def in_store(self) -> float:
        """Energy (J) stored now."""
        return sum(self.energies.values())

    @property
    def row(self) -> Mapping[str, float]:
        """What the history says of a step."""
        damping = {f"damping_loss:{name}": loss for name, loss in self.damping_loss.items()}
        lost = {f"loss:{name}": loss for name, loss in self.effect_loss.items()}
        return {**self.energies, "external_work": self.work, **damping, **lost}

    @property
    def balance(self) -> float:
        """Return (work - gain of stored energy - lost) over the largest of them in the run.

        Lost is what friction, softening, damping and flowing material took.
        """
        return -self.made / self.throughput if self.throughput else 0.0

    def freed(self, effect: str) -> float:
        """Energy (J) that work and stores say went where ``effect`` changed what is solved."""
        apart = sum(added for cause, added in self.changed_by.items() if cause != effect)
        gained = self.in_store - self.stored_first - apart
        others = self.dissipated - self.effect_loss.get(effect, 0.0)
        return self.work - gained - others - self.integration_loss - self.contact_loss

    @property
    def made(self) -> float:
        """Energy (J) that came from nowhere."""
        return self._made(self.in_store, self.dissipated)

    def _made(self, total: float, lost: float) -> float:
        """Return the same of what is stored in total and lost (J)."""
        return total - self.stored_first - self.change_energy + lost - self.work

    @property
    def dissipated(self) -> float:
        """Energy (J) that friction, damping, breaking and flowing material took."""
        by_effects = (*self.damping_loss.values(), *self.effect_loss.values())
        return self.friction_loss + self.material_loss + sum(by_effects)
