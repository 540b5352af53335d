"""The effects of a scene and their hooks, called all together.

Hooks that no effect has are never called.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property, partial
from operator import is_
from typing import TYPE_CHECKING, Any

import numpy as np

from integration.arrays import Floats
from integration.sparse import csc_array, csr_array
from nmm.assembly.state import State
from nmm.assembly.weakly import weakly
from nmm.effects.base import Effect, Instant, Span, StepForce, defines
from nmm.model.planning.forces import ForcePlan
from nmm.quantity import MemberSegments

if TYPE_CHECKING:
    from nmm.effects.event import Event
    from nmm.effects.view import View


@dataclass(frozen=True)
class Plan(ForcePlan):
    """The effects of a scene; a hook is summed over the effects that define it.

    Attributes
    ----------
    sums
        The last sum of matrices with its parts: parts that stay need not be added again.
    """

    sums: dict[str, tuple[list[csc_array], csc_array]] = field(default_factory=dict)

    def joined(self, effect: Effect) -> "Plan":
        """Return the plan with one effect more."""
        return Plan({**self.effects, effect.name: effect})

    def connected(self) -> "Plan":
        """Connect effects to the stresses and forces of others; return the plan itself.

        They hold one another weakly, and the plan holds all of them.
        """
        self.hooks.clear()
        for effect in self.having("receive_forces"):
            effect.receive_forces(self._handed("applied_forces"))
        if pores := self._handed("pore_pressure_at"):
            for effect in self.having("receive_pore_pressures"):
                effect.receive_pore_pressures(pores)
        if stresses := self._handed("stress_at"):
            for effect in self.having("receive_stresses"):
                effect.receive_stresses(stresses)
        for effect in self.having("receive_held_edges"):
            effect.receive_held_edges(self._handed("held_edges"))
        return self

    def _handed(self, hook: str) -> list[Any]:
        """Return a hook of the effects that define it, for other effects."""
        return [weakly(getattr(effect, hook)) for effect in self.having(hook)]

    def begin(self, state: State) -> State:
        """Return the state at the start of the run."""
        for effect in self.having("begin"):
            state = effect.begin(state)
        return state

    def matrix(self, state: State, base: csc_array) -> csc_array:
        """Return ``base`` with all effects' matrices added; the same sum of the same parts."""
        parts = [base, *self._matrices("matrix", state).values()]
        return self.total("matrix", parts, lambda: sum(parts[1:], start=base))

    def total(self, name: str, parts: list[csc_array], make: Callable[[], csc_array]) -> csc_array:
        """Return what is made of matrices, the same object as long as they are the same ones."""
        kept = self.sums.get(name)
        if kept is None or not _are(kept[0], parts):
            kept = self.sums[name] = parts, csc_array(make())
        return kept[1]

    def damping(self, state: State) -> dict[str, csc_array]:
        """Return the damping matrix of each effect that has one, by name."""
        return self._matrices("damping", state)

    def added_mass(self, state: State) -> dict[str, csc_array]:
        """Return what joins the mass in the step that starts at ``state``, by effect."""
        return self._matrices("added_mass", state)

    def _matrices(self, hook: str, state: State) -> dict[str, csc_array]:
        """Return the matrices of the effects that have a hook, by name."""
        having = self.named(hook)
        return {name: self.timed(name, partial(getattr(one, hook), state)) for name, one in having}

    def received_stress_energy(self, state: State) -> float:
        """Return the energy (J) at held edges of stresses that effects add."""
        having = self.named("received_stress_energy")
        return sum(effect.received_stress_energy(state) for _, effect in having)

    def added_stress(self, state: State) -> Floats | None:
        """Return the mean stress (E, 3) beyond that of the strain; None where nothing adds any."""
        parts = [effect.mean_stress(state) for _, effect in self.named("mean_stress")]
        return np.asarray(sum(parts[1:], start=parts[0])) if parts else None

    def border(self, state: State, end: Instant) -> tuple[csr_array, Floats] | None:
        """Return conditions on the step's unknowns that multipliers hold, None without any."""
        found = [effect.border(state, end) for _, effect in self.named("border")]
        parts = [part for part in found if part is not None]
        if not parts:
            return None
        from scipy.sparse import vstack

        rows = csr_array(vstack([part[0] for part in parts]))
        return rows, np.concatenate([part[1] for part in parts])

    def keep(self, multipliers: Floats) -> None:
        """Hand the multipliers of a solution to the effects whose conditions they hold."""
        for effect in self.having("border"):
            multipliers = effect.keep(multipliers)

    def carried(self) -> dict[str, Any]:
        """Return what the effects carry from step to step, by their names."""
        every = self.effects.items()
        return {name: effect.carried() for name, effect in every if defines(effect, "carried")}

    def carry(self, carried: Mapping[str, Any]) -> None:
        """Hand back what `carried` returned."""
        for name, known in carried.items():
            self.effects[name].carry(known)

    def forget(self) -> None:
        """Drop what is kept for speed alone."""
        self.sums.clear()
        for effect in self.having("forget"):
            effect.forget()

    def segments(self, state: State) -> MemberSegments | None:
        """Return the members of all effects; None without any."""
        parts = [effect.segments(state) for effect in self.having("segments")]
        return MemberSegments.joined(parts) if parts else None

    @cached_property
    def bent(self) -> dict[str, Effect]:
        """Effects, by name, whose force is no line in the unknowns of a step."""
        return {name: one for name, one in self.named("step_force") if one.nonlinear}

    def swelling(self, state: State, end: Instant) -> Floats | None:
        """Return what material points swell by at the end of a step (Q, 1); None where nothing."""
        asked = (effect.swelling(state, end) for _, effect in self.named("swelling"))
        found = [one for one in asked if one is not None]
        return sum(found[1:], start=found[0])[:, None] if found else None

    def step_force(self, name: str, before: State, after: State, span: Span) -> StepForce:
        """Return what a bent effect does through a step."""
        return self.timed(name, partial(self.effects[name].step_force, before, after, span))

    def work_correction(self, before: State, after: State, increment: Floats, span: Span) -> float:
        """Return what the rise of bent forces seems to do in a step and does not (J)."""
        bent = [one for _, one in self.named("work_correction") if one.nonlinear]
        return sum(one.work_correction(before, after, increment, span) for one in bent)

    @cached_property
    def tellers(self) -> list[tuple[str, Effect]]:
        """Effects with numbers for the history, by name."""
        return self.named("history")

    @cached_property
    def askers(self) -> tuple[str, ...]:
        """Names of the effects that may ask for another geometry."""
        return tuple(name for name, _ in self.named("event"))

    def accepted(self, state: State) -> None:
        """Tell the effects that ask where an accepted step has ended."""
        for name, effect in self._followers:
            self.timed(name, partial(effect.accepted, state))

    @cached_property
    def _followers(self) -> list[tuple[str, Effect]]:
        return self.named("accepted")

    def event(self, name: str, view: "View") -> "Event | None":
        """Return the event that a state calls for by one of the `askers`."""
        return self.timed(name, partial(self.effects[name].event, view))


def _are(some: list[csc_array], others: list[csc_array]) -> bool:
    return len(some) == len(others) and False not in map(is_, some, others)
