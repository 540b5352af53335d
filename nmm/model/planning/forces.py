"""The forces of the effects of a scene: summed, checked, and those that no instant changes."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import isfinite
from time import perf_counter
from types import MappingProxyType

import numpy as np

from integration.arrays import Floats
from nmm.assembly.state import State
from nmm.assembly.stress_points import StressAt
from nmm.effects.base import Instant
from nmm.effects.half_way import HalfWay
from nmm.errors import SolveError
from nmm.model.planning.energies import EnergyPlan


@dataclass(frozen=True)
class ForcePlan(EnergyPlan):
    """The effects of a scene as a step's loads; a hook is summed over those that define it."""

    @property
    def stresses(self) -> list[StressAt]:
        """What tells the stresses that effects add to that of the strain."""
        return [effect.stress_at for effect in self.having("stress_at")]

    def force(self, state: State, end: Instant, half: HalfWay | None = None) -> Floats:
        """Return the sum of all effects' forces (n,)."""
        total = np.zeros(len(state.deformation))
        for part in self.forces(state, end, half):
            total += part
        return total

    def forces(
        self,
        state: State,
        end: Instant,
        half: HalfWay | None = None,
        known: Mapping[str, Floats] = MappingProxyType({}),
    ) -> Iterator[Floats]:
        """Yield the force (n,) of each effect, dead ones ``half`` way where bodies turn.

        Those ``known`` by name are not asked for again.
        """
        shape = state.deformation.shape
        for name, effect in self.named("force"):
            if name in known:
                yield known[name]
                continue
            start = perf_counter()
            if half is None or not effect.dead:
                part = effect.force(state, end)
            else:
                part = half.force(effect, state, end)
            self.seconds[name] += perf_counter() - start
            if part.shape != shape:
                raise SolveError(
                    f"{name}: the force has the shape {part.shape}: expected {shape}, one "
                    "number an unknown: correct Effect.force"
                )
            # A sum is infinite or no number where a part of it is; one that overflows is looked at.
            if not isfinite(np.add.reduce(part)) and not np.isfinite(part).all():
                raise SolveError(
                    f"{name} at {end.time:.6g} s: the force is infinite or no number: "
                    "expected finite numbers: correct its magnitude, history or place"
                )
            yield part

    def force_at_start(
        self, state: State, end: Instant, half: HalfWay | None, parts: Sequence[Floats]
    ) -> Floats:
        """Return the sum (n,) as a step begins; ``parts`` (n,) are the forces at its ``end``."""
        total = np.zeros(len(state.deformation))
        known = dict(zip(self._lasting, parts, strict=True))
        known.pop("", None)
        same = end.load_factor == state.load_factor
        for part in self.forces(state, Instant.of(state), half, known if same else {}):
            total += part
        return total

    @cached_property
    def _lasting(self) -> list[str]:
        """Names of the effects with forces that no instant changes; empty for others.

        What is told of stresses of others changes with them.
        """
        told = {name for name, _ in self.named("receive_stresses")} if self.stresses else set()
        pairs = self.named("force")
        return [name if one.steady and name not in told else "" for name, one in pairs]

    def unit_load(self, state: State) -> Floats:
        """Return the force (n,) that a load factor of one more adds (N)."""
        time, factor = state.time, state.load_factor
        more, now = (self.force(state, Instant(time, at)) for at in (factor + 1.0, factor))
        return more - now

    def dead_load(self, state: State, way: Floats) -> Floats:
        """Return the force (n,) of what no factor scales: weight, stress without strain (N).

        ``way`` (n,) is how far the unknowns have come: what pulls them back, as springs of supports
        do, is no load.
        """
        dead = {name for hook in ("work", "stress_at") for name, _ in self.named(hook)}
        at = Instant(state.time, 0.0)
        loads = (one.force(state, at) for name, one in self.named("force") if name in dead)
        back = (one.matrix(state) @ way for name, one in self.named("matrix") if name in dead)
        return sum((*loads, *back), start=np.zeros(len(state.deformation)))

    @cached_property
    def steady(self) -> bool:
        """Whether no force depends on the instant, in dynamics."""
        return all(effect.steady for effect in self.effects.values())

    @cached_property
    def dead(self) -> bool:
        """Whether a force keeps its direction while bodies turn, beside weight at centroids."""
        return any(effect.dead for effect in self.effects.values())
