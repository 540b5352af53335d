"""The effect of permanently tied interfaces, whatever the method.

Forces are read from the whole jump as it stands, so that nothing drifts over steps. Where bodies
turn, a point that a linear step holds has moved by half the angle squared times its arm when the
step ends: stiff ties that were left there would push back by far more than they carry. So steps
in time of what may turn are solved for the forces at their end.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from integration.arrays import Floats, Ints
from integration.sparse import csc_array
from nmm.assembly.model import Model
from nmm.assembly.moving.motion import middle
from nmm.assembly.state import State
from nmm.assembly.stress_points import StressAt
from nmm.assembly.tractions.held_edges import HeldEdge
from nmm.constraints.imposition import Imposition
from nmm.constraints.interface import joined
from nmm.constraints.ties.held_by_multipliers import HeldByMultipliers
from nmm.constraints.turned_axes import rounded, turned_axes
from nmm.effects.base import Instant, Span, StepForce


class TiedInterfaces(HeldByMultipliers):
    """Interfaces with the methods that tie them.

    Parameters
    ----------
    ties
        The interfaces.
    n_unknowns
        Of the model.
    turning
        The model, where its bodies may turn in steps in time; None: forces are lines in the
        unknowns of a step.
    """

    def __init__(
        self, ties: Sequence[Imposition], n_unknowns: int, turning: Model | None = None
    ) -> None:
        super().__init__(ties)
        # Multipliers hold jumps of lines.
        self._turning_model = None if any(tie.shared is not None for tie in ties) else turning
        self._bends = any(tie.bends for tie in ties)
        self._n = n_unknowns
        self._kept: tuple[Floats, csc_array] | None = None  # the matrix, at angles
        unlike = [t.interface.bodies for t in ties if t.turns]
        self._stresses: Sequence[StressAt] = ()
        self._turning = np.unique(np.concatenate([*unlike, np.zeros(0, dtype=np.int64)]))

    @property
    def about(self) -> str:
        points: dict[str, int] = {}
        for tie in self.ties:
            if tie.shared is None:
                points[tie.words] = points.get(tie.words, 0) + len(tie.interface)
        said = [f"{words} at {number} points" for words, number in points.items()]
        said += [f"{self.multipliers} Lagrange multipliers"] if self._spaces else []
        return ", ".join(said)

    @property
    def turns_with_bodies(self) -> str:
        oriented = any(tie.oriented for tie in self.ties)
        return "springs that are unlike along an interface and across" if oriented else ""

    def matrix(self, state: State) -> csc_array:
        """Return the stiffness of all ties, the same object as long as no tied body turns."""
        kept = self._kept
        if kept is not None and not len(self._turning) and not self._bends:
            return kept[1]
        known = state.deformation if self._bends else state.frames.angle[self._turning]
        if kept is None or not np.array_equal(kept[0], known):
            kept = self._kept = known, self._stiffness(state)
        return kept[1]

    def _stiffness(self, state: State) -> csc_array:
        row, column, value = joined([_NOTHING, *(tie.matrix(state) for tie in self.ties)])
        return csc_array((value, (row, column)), shape=(self._n, self._n))

    def force(self, state: State, end: Instant) -> Floats:
        """Return the pull at the start of the step towards the places at its end."""
        total = np.zeros(self._n)
        for tie, jump in self._each(state, end):
            total += tie.force(state, jump)
            if self._stresses:
                total += tie.interface.spread(state, self._added(tie, state, end))
        return total

    @property
    def nonlinear(self) -> bool:
        """See `Effect.nonlinear`: where bodies turn, or held matter bends by any angle."""
        return self._turning_model is not None or self._bends

    def step_force(self, before: State, after: State, span: Span) -> StepForce:
        """See `Effect.step_force`: forces at both ends of the step, where bodies are half way.

        There these keep angular momentum of two bodies that are tied.
        """
        if self._turning_model is None:
            return self._bent_force(before, after, span)
        at = middle(before, after) if span.half else after
        turned = turned_axes(self._turning_model, before, at)
        late = self._pulls(after, Instant.of(after))
        soon = late if span.weight == 1 else self._pulls(before, Instant.of(before))
        total, rounding = np.zeros(self._n), np.zeros(self._n)
        for tie, (last, more), (first, some) in zip(self.ties, late, soon, strict=True):
            pull = span.weight * last + (1 - span.weight) * first
            total += tie.interface.spread(at, pull)
            total += span.weight * more + (1 - span.weight) * some
            rounding += np.abs(tie.interface.spread(at, rounded(tie, after)))

        def stiffness() -> csc_array:
            return csc_array(span.weight * (turned.T @ self._stiffness(at) @ turned))

        return StepForce(turned.T @ total, stiffness, rounding=rounding)

    def _bent_force(self, before: State, after: State, span: Span) -> StepForce:
        """Return `step_force` of held matter that bends by any angle, in axes that do not turn."""
        total = span.weight * self.force(after, Instant.of(after))
        if span.weight < 1:
            total += (1 - span.weight) * self.force(before, Instant.of(before))
        rounding = np.zeros(self._n)
        for tie in self.ties:
            rounding += np.abs(tie.interface.spread(after, rounded(tie, after)))
        return StepForce(total, lambda: span.weight * self.matrix(after), rounding=rounding)

    def work_correction(self, before: State, after: State, increment: Floats, span: Span) -> float:
        now, end = Instant.of(before), Instant.of(after)
        rise = self.step_force(before, after, replace(span, weight=1.0)).force
        total = -float((rise - self.force(before, now)) @ increment)
        pairs = zip(self.ties, self._pulls(before, now), self._pulls(after, end), strict=True)
        for tie, (first, some), (last, more) in pairs:
            way = tie.interface.motion(after) - tie.interface.motion(before)
            total += float(np.sum(tie.interface.held * (last - first) * way))
            total += float((more - some) @ increment)
        return total

    def _pulls(self, state: State, end: Instant) -> list[tuple[Floats, Floats]]:
        """Forces (m, 2) in N on the first side of each tie, and (n,) what it does besides."""
        found = []
        for tie, jump in self._each(state, end):
            pull = tie.point_forces(state, jump)
            beside = tie.force(state, jump) - tie.interface.spread(state, pull)
            if self._stresses:
                pull = pull + self._added(tie, state, end)
            found.append((pull, beside))
        return found

    def receive_stresses(self, stresses: Sequence[StressAt]) -> None:
        self._stresses = stresses

    def held_edges(self, state: State, end: Instant) -> list[HeldEdge]:
        """See `Effect.held_edges`."""
        found = (tie.held_edge(state, jump) for tie, jump in self._each(state, end))
        return [one for one in found if one is not None]

    def _added(self, tie: Imposition, state: State, end: Instant) -> Floats:
        """Forces (m, 2) in N on the first side of a tie by stresses that other effects add."""
        return tie.added(state, self._stresses, end.time)

    def forget(self) -> None:
        self._kept = None
        self.jumps.forget()

    def energy(self, state: State) -> float:
        """Energy (J) stored in ``state``, with places of its own instant."""
        now = Instant.of(state)
        held = self._each(state, now)
        stored = (tie.energy(state, jump) + tie.laid_energy(state, jump) for tie, jump in held)
        return sum(stored) - self._felt(state, now)

    def received_stress_energy(self, state: State) -> float:
        """See `Effect.received_stress_energy`: minus their tractions times the jumps.

        With that of the initial stress that springs carry.
        """
        now = Instant.of(state)
        laid = sum(tie.laid_energy(state, jump) for tie, jump in self._each(state, now))
        return laid - self._felt(state, now)

    def work(self, before: State, after: State) -> float:
        """Work (J) of these stresses as they change, on the mean jump of both ends of the step."""
        if not self._stresses:
            return 0.0
        start, end = Instant.of(before), Instant.of(after)
        rise = (self._felt(state, end) - self._felt(state, start) for state in (before, after))
        return -sum(rise) / 2

    def _felt(self, state: State, at: Instant) -> float:
        """Tractions of stresses at an instant times the jumps of a state (J); zero without any."""
        if not self._stresses:
            return 0.0
        pairs = self._each(state, Instant.of(state))
        return sum(float(np.sum(jump * self._added(tie, state, at))) for tie, jump in pairs)

    def gap_volume(self, state: State, k: int) -> Floats:
        total = np.zeros(k)
        for tie, jump in self._each(state, Instant.of(state)):
            total += tie.gap_volume(state, jump, k)
        return total

    def tied_unknowns(self) -> Ints:
        """Return the unknowns tied to those of neighbours, as by ghost terms."""
        none = [np.empty(0, dtype=np.int64)]
        return np.unique(np.concatenate(none + [tie.tied_unknowns for tie in self.ties]))


_NOTHING = (np.zeros(0, dtype=np.int64), np.zeros(0, dtype=np.int64), np.zeros(0))
