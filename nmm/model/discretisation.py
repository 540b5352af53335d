"""The discretisation that is solved: a model and the effects on it, in versions."""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Protocol, Self

import numpy as np

from covers.change.parentage import Parentage
from nmm.assembly.state import State, initial_state
from nmm.assembly.transfer.state import carried
from nmm.effects.base import Effect, Setup
from nmm.effects.change import Change
from nmm.model.planning.making import compile_plan, plan_after
from nmm.model.planning.plan import Plan
from nmm.model.staging.forgotten import without_members_gone

if TYPE_CHECKING:
    from nmm.assembly.model import Model


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

    def change(self, setup: Setup, state: State) -> Change:
        """Carry ``state`` to the model of ``setup``, which lies in the same reference place.

        Bodies without parents start as the scene declares them, with its initial velocities.
        """
        old, new = self.model, setup.model
        kin = Parentage(old.manifold, new.manifold)
        declared = replace(
            initial_state(new.manifold),
            time=state.time,
            load_factor=state.load_factor,
            history=new.history(),
        )
        if setup.scene.initial_velocities:
            from nmm.effects.initial.initial_velocity import InitialVelocity

            declared = InitialVelocity.from_setup(setup).begin(declared)
        memory = without_members_gone(state.memory, self.setup.scene, setup.scene)
        turning = setup.kinematics.turns
        after = replace(carried(old, new, kin, state, declared, turning), memory=memory)
        change = Change(self.setup, setup, kin, after, former=state)
        if np.array_equal(self.setup.region_material, setup.region_material):
            return change
        return self._with_other_materials(change, declared)

    def _with_other_materials(self, change: Change, declared: State) -> Change:
        """Return a change after which blocks of other materials keep their stress."""
        from nmm.effects.initial.changed_materials import ChangedMaterials, remembered

        effect = self.plan.effects[ChangedMaterials.name]
        assert isinstance(effect, ChangedMaterials)
        old, new, after = change.before, change.setup, change.state
        kept = effect.kept_by(old, new, change.former, after)
        return replace(change, state=remembered(new, old, kept, after, declared), kept=kept)

    def joined(self, effect: Effect) -> "Discretisation":
        """Return the same with one effect more, for a motion that is no result."""
        return replace(self, plan=self.plan.joined(effect))

    def after(self, change: Change) -> "Discretisation":
        """Return the next version: every effect follows the change."""
        return Discretisation(change.setup, plan_after(self.plan, change), self.version + 1)


class ModelWithEffects(Protocol):
    """A model and the effects on it."""

    @property
    def model(self) -> "Model":
        """What is approximated and of what it is made."""

    @property
    def plan(self) -> Plan:
        """The effects on it."""


class CurrentDiscretisation:
    """The discretisation of a run as it is now, shared by all that solve its steps.

    Attributes
    ----------
    discretisation, model, plan
        It, its model and its effects, for which a step asks dozens of times.
    """

    def __init__(self, discretisation: Discretisation) -> None:
        self.become(discretisation)

    def become(self, discretisation: Discretisation) -> None:
        """Solve another one from now on."""
        self.discretisation, self.plan = discretisation, discretisation.plan
        self.model: Model = discretisation.model
