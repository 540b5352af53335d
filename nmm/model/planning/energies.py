"""What the effects of a scene store, take for good and do, by columns of the history."""

from dataclasses import dataclass
from functools import cached_property, partial

from nmm.assembly.state import State
from nmm.effects.base import Effect
from nmm.model.effects_table import OWN
from nmm.model.planning.named import NamedEffects

STORES = {
    "kinetic_energy": ("inertia",),
    "strain_energy": ("initial stress", "heat"),
    "contact_energy": ("contact",),
    "support_energy": ("supports", "bonded interfaces", "artificial joints"),
}
"""Effects whose energy is counted with that of bodies, contacts or supports, by columns of the
history; others have columns to themselves."""


@dataclass(frozen=True)
class EnergyPlan(NamedEffects):
    """The effects of a scene as energies are booked; a hook is summed over those that define it."""

    def work(self, before: State, after: State) -> float:
        """Return the work of all applied forces (J)."""
        done = 0.0
        for name, effect in self.named("work"):
            done += self.timed(name, partial(effect.work, before, after))
        return done

    def losses(self, before: State, after: State) -> dict[str, float]:
        """Return what each effect took for good in an accepted step (J)."""
        return {
            name: self.timed(name, partial(one.loss, before, after))
            for name, one in self.named("loss")
        }

    def missed_losses(self, before: State, after: State) -> dict[str, float]:
        """Return what each effect took in a step of statics beyond `losses` (J)."""
        return {
            name: self.timed(name, partial(one.missed_loss, before, after))
            for name, one in self.named("missed_loss")
        }

    def first_work(self, before: State, after: State) -> float:
        """Return the work (J) that `work` lacks in the first step of statics."""
        return sum(effect.first_work(before, after) for effect in self.having("first_work"))

    def energy(self, name: str, state: State) -> float:
        """Return the energy of one effect (J), zero when the scene does not name it."""
        effect = self.effects.get(name)
        return 0.0 if effect is None else effect.energy(state)

    def energies(self, state: State) -> dict[str, float]:
        """Return the energy (J) that effects store, by its columns of the history."""
        found = {}
        for column, effects in self._stores:
            found[column] = 0.0
            for name, one in effects:
                found[column] += self.timed(name, partial(one.energy, state))
        return found

    @cached_property
    def _stores(self) -> list[tuple[str, list[tuple[str, Effect]]]]:
        """Effects that store energy with their names, by the columns of it."""
        shared = {
            column: [(name, self.effects[name]) for name in names if name in self.effects]
            for column, names in STORES.items()
        }
        own = {
            f"energy:{name.removeprefix(OWN)}": [(name, effect)]
            for name, effect in self.named("energy")
            if not any(name in names for names in STORES.values())
        }
        return [*shared.items(), *own.items()]
