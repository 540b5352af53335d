"""What is solved: a model and the effects on it, one version after the other."""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Self

from nmm.effects.base import Effect, Setup
from nmm.model.effects_table import with_table
from nmm.model.plan import Plan, compile_plan

if TYPE_CHECKING:
    from nmm.assembly.model import Model
    from nmm.effects.change import Change


@dataclass(frozen=True)
class Discretisation:
    """A model with the plan of effects on it.

    Attributes
    ----------
    setup
        What it is built from; the numbering of unknowns is that of the manifold of its model.
    plan
        Effects.
    version
        How many changes led to it.
    """

    setup: Setup
    plan: Plan
    version: int = 0

    @classmethod
    def of(cls, setup: Setup) -> Self:
        """Compile the effects that the scene names."""
        return cls(setup, compile_plan(setup))

    @property
    def model(self) -> "Model":
        """What is approximated and of what it is made."""
        return self.setup.model

    def joined(self, effect: Effect) -> "Discretisation":
        """Return the same with one effect more, for a motion that is no result."""
        return replace(self, plan=self.plan.joined(effect))

    def after(self, change: "Change") -> "Discretisation":
        """Return the next version: every effect follows the change."""
        plan = self.plan
        effects = {
            name: effect.follow(replace(change, setup=with_table(change.setup, name)))
            for name, effect in plan.effects.items()
        }
        return Discretisation(change.setup, replace(plan, effects=effects), self.version + 1)


@dataclass
class Current:
    """The discretisation of a run as it is now, shared by all that solve its steps."""

    discretisation: Discretisation

    @property
    def model(self) -> "Model":
        """Its model."""
        return self.discretisation.model

    @property
    def plan(self) -> Plan:
        """Its effects."""
        return self.discretisation.plan
