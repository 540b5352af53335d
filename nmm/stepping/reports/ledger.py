"""The energies of a run, booked step by step, and how far they are from balance."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from nmm.assembly.motion import State
from nmm.stepping.step.trial import Attempt

if TYPE_CHECKING:
    from nmm.assembly.model import Model
    from nmm.model.plan import Plan

# Effects whose springs count as supports: those of the scene, glue, and what holds sub-blocks.
HOLDING = ("supports", "seams", "artificial joints")


@dataclass(frozen=True)
class Rise:
    """How much energy came from nowhere (J), and in which step (its number and time, s).

    ``given`` of it (J) the integrator gave: waves of one that is not monotone come and go.
    """

    energy: float = 0.0
    step: int = 0
    time: float = 0.0
    given: float = 0.0


@dataclass
class Ledger:
    """Totals over accepted steps (J).

    In statics nothing acts before the first step: what acts at its start (weight, initial stress,
    loads and displacements of supports that are not scaled) grows from nothing in it, and so does
    its work.

    Attributes
    ----------
    work, friction_loss
        Work of loads, weight and driven supports; what friction, dashpots and breaking bonds took.
    integration_loss, contact_loss
        What time integration took, but for contact; and what springs of contact lost beyond
        friction: both are part of what is missing in the balance, and negative where energy came.
    energies
        Stored now, by name.
    stored_first
        Energy at the start, before any contact.
    throughput
        Largest work, stored or lost energy so far.
    in_step, in_run
        Largest rise of stored energy and losses less work, in one step and over the run.
    """

    work: float = 0.0
    friction_loss: float = 0.0
    integration_loss: float = 0.0
    contact_loss: float = 0.0
    energies: dict[str, float] = field(default_factory=dict)
    stored_first: float = 0.0
    throughput: float = 0.0
    steps: int = 0
    in_step: Rise = field(default_factory=Rise)
    in_run: Rise = field(default_factory=Rise)
    _given: float = 0.0
    _lowest: tuple[float, float] = (0.0, 0.0)
    _last: tuple[float, float] = (0.0, 0.0)

    def book(
        self, plan: "Plan", model: "Model", before: State, attempt: Attempt, stands: State
    ) -> None:
        """Book an accepted step; ``stands`` is its end as blocks are laid now."""
        first = not self.steps
        earlier = stored(plan, model, before) if first else self.energies
        if first:
            self.stored_first = sum(earlier.values()) - earlier["contact_energy"]
        self.steps += 1
        after = attempt.state
        grows = first and plan.inertia is None
        if grows and plan.supports is not None:
            self.stored_first -= plan.energy("supports", before)
            self.work += plan.supports.first_work(before, after)
        self.work += plan.work(before, after)
        if grows:
            self.work -= standing(plan, before, after)
        self.energies = stored(plan, model, stands)
        loss = 0.0 if attempt.solved is None else attempt.solved.loss
        self.friction_loss += loss
        if attempt.booked is not None:
            gain = {name: value - earlier[name] for name, value in self.energies.items()}
            lost = attempt.booked.integration_loss(gain["kinetic_energy"])
            self.integration_loss += lost
            self._given += max(-lost, 0.0)
            self.contact_loss += attempt.booked.contact_loss(gain["contact_energy"], loss)
        self._weigh(after)

    @property
    def row(self) -> Mapping[str, float]:
        """What the history says of a step."""
        return {**self.energies, "external_work": self.work}

    @property
    def balance(self) -> float:
        """Return (work - gain of stored energy - lost) over the largest of them in the run.

        Lost is what friction, softening and damping took.
        """
        return -self._made / self.throughput if self.throughput else 0.0

    @property
    def _made(self) -> float:
        return sum(self.energies.values()) - self.stored_first + self.friction_loss - self.work

    def _weigh(self, after: State) -> None:
        """Take the size of the energies, and how much came from nowhere."""
        total = sum(self.energies.values())
        self.throughput = max(
            self.throughput, abs(self.work), abs(total), abs(self.stored_first), self.friction_loss
        )
        made, given = self._made, self._given
        for name, (low, before) in (("in_step", self._last), ("in_run", self._lowest)):
            if made - low > getattr(self, name).energy:
                setattr(self, name, Rise(made - low, self.steps, after.time, given - before))
        self._last = made, given
        self._lowest = min(self._lowest, self._last)


def stored(plan: "Plan", model: "Model", state: State) -> dict[str, float]:
    """Return the energies (J) of a state by name."""
    q = state.deformation
    lifted = plan.lifted_energy(model, state)
    strain = float(q @ (model.stiffness @ q)) / 2 + lifted
    return {
        "kinetic_energy": plan.energy("inertia", state),
        "strain_energy": strain + plan.energy("initial stress", state),
        "contact_energy": plan.energy("contact", state),
        "support_energy": sum(plan.energy(name, state) for name in HOLDING) - lifted,
    }


def standing(plan: "Plan", before: State, after: State) -> float:
    """Half the work (J) of what acts at the start of statics, weight and initial stress included.

    It is what holds a start that is not in equilibrium and is withdrawn evenly in the first step.
    """
    held = replace(after, time=before.time, load_factor=before.load_factor)
    stress = plan.energy("initial stress", before) - plan.energy("initial stress", after)
    return (plan.work(before, held) + stress) / 2
