"""A field in the course of time: what it was when the step began, and at ends that were tried.

A step may be tried more than once, with other ends. What the field is at each follows from what it
was when the step began; once the next one begins, all others are dropped.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from integration.arrays import Floats
from nmm.diffusion.problem import DiffusionProblem, step_between
from nmm.solvers.accuracy.known import LEAST

# Relative excess over the longest step that is rounding.
ROUNDING = 1e-9
# Number of implicit Euler steps that replace the first step (Rannacher 1984).
SOFT = 4


@dataclass(frozen=True)
class FieldAt:
    """A field at one time.

    Attributes
    ----------
    time
        s.
    unknowns
        (n,).
    taken
        Amount taken up since the start of the run, by its source.
    stored
        Increase of the stored amount since the start.
    exchanged
        Sum of the exchanges at edges by size; ``taken`` is their net sum.
    taken_in
        (n,) storage by volumetric strain, integrated with the functions of the field; None where
        the field is not coupled to strain.
    """

    time: float
    unknowns: Floats
    taken: Mapping[str, float]
    stored: float = 0.0
    exchanged: float = 0.0
    taken_in: Floats | None = None

    @property
    def imbalance(self) -> float:
        """Amount taken up and not stored, over the sum of all amounts by size.

        Where the net flow is small, that sum is at least the rounding error of the exchanges.
        """
        all_ways = sum(abs(amount) for amount in self.taken.values())
        all_ways = max(all_ways, LEAST * self.exchanged)
        lacking = self.stored - sum(self.taken.values())
        return abs(lacking) / all_ways if all_ways else 0.0


Parts = tuple[float, Floats, Mapping[str, float], float, float, Floats | None]


def _parts(field: FieldAt) -> Parts:
    known = field.time, field.unknowns, field.taken, field.stored, field.exchanged
    return *known, field.taken_in


class FieldCourse:
    """A field over the course of time: at the start of a step, and at trial ends.

    Parameters
    ----------
    problem
        Its equations.
    start
        The field at the start; None where it is steady at any time.
    theta, step
        Of the theta method; the longest step (s), None for those of the run.
    """

    def __init__(
        self,
        problem: DiffusionProblem,
        start: FieldAt | None,
        theta: float = 1.0,
        step: float | None = None,
    ) -> None:
        self.problem, self._theta, self._step = problem, theta, step
        self._start = self._began = start
        self._ends: dict[float, FieldAt] = {}

    def at(self, time: float) -> FieldAt:
        """Return the field at a time."""
        began = self._began
        if began is not None and began.time == time:
            return began
        if time not in self._ends:
            self._ends[time] = self._found(time)
        return self._ends[time]

    def begin(self, time: float) -> None:
        """Keep only the field at the start of a step."""
        if self._began is None or self._began.time != time:
            self._began, self._ends = self.at(time), {}

    @property
    def began(self) -> FieldAt | None:
        """The field at which the step begins; None where it is steady and was not asked for."""
        return self._began

    def count_room_from(self, taken_in: Floats) -> None:
        """Count what strain makes room for from a storage (n,) on, that at the start of a step."""
        assert self._began is not None
        self._began = replace(self._began, taken_in=taken_in)

    def make_room(self, time: float, taken_in: Floats) -> None:
        """Let strain have made room (n,) at the end of the step."""
        assert self._began is not None
        if time > self._began.time:
            self._ends[time] = self._gone_on(self._began, time, taken_in)

    @property
    def steady(self) -> bool:
        """Whether nothing is stored."""
        return self._start is None

    def go_on_from(self, field: FieldAt) -> None:
        """Begin at a field that came from elsewhere."""
        self._start = self._began = field
        self._ends = {}

    def carried(self) -> tuple[Parts | None, tuple[Parts, ...]]:
        """Return what the next step needs, as plain values."""
        began = None if self._began is None else _parts(self._began)
        return began, tuple(_parts(one) for one in self._ends.values())

    def carry(self, known: tuple[Parts | None, tuple[Parts, ...]]) -> None:
        """Take back what `carried` returned."""
        began, ends = known
        self._began = None if began is None else FieldAt(*began)
        self._ends = {parts[0]: FieldAt(*parts) for parts in ends}

    def _found(self, time: float) -> FieldAt:
        start, began = self._start, self._began
        if start is None or began is None:
            if began is not None and not self.problem.changes(began.time, time):
                return replace(began, time=time)
            unknowns = self.problem.steady(time)
            taken, exchanged = self.problem.taken(unknowns, time), self.problem.exchanged(time)
            return FieldAt(time, unknowns, taken, exchanged=exchanged)
        return self._gone_on(began if time > began.time else start, time)

    def _gone_on(self, last: FieldAt, time: float, taken_in: Floats | None = None) -> FieldAt:
        """Step from a field to a later time, in one step where strain makes room."""
        problem, unknowns, taken = self.problem, last.unknowns, dict(last.taken)
        exchanged, room = last.exchanged, None
        if taken_in is not None and last.taken_in is not None:
            room = taken_in - last.taken_in
        if room is None and problem.rests(unknowns):
            return replace(last, time=time)
        for begin, end, theta in self._steps(last.time, time):  # steps in time
            after = problem.stepped(unknowns, begin, end, theta, room)
            for share, field, at in ((1 - theta, unknowns, begin), (theta, after, end)):
                for name, rate in problem.taken(field, at).items():  # a handful of edges
                    taken[name] = taken.get(name, 0.0) + share * step_between(begin, end) * rate
            unknowns = after
            exchanged += step_between(begin, end) * problem.exchanged(end)
        gained = problem.stored(unknowns) - problem.stored(last.unknowns)
        if room is not None:
            gained += problem.total(room)
        kept = last.taken_in if taken_in is None else taken_in
        return FieldAt(time, unknowns, taken, last.stored + gained, exchanged, kept)

    def _steps(self, begin: float, end: float) -> Iterator[tuple[float, float, float]]:
        """Yield begin and end of equal steps, as few as their length allows, and theta."""
        span = end - begin
        number = 1 if self._step is None else int(np.ceil(span / self._step * (1 - ROUNDING)))
        times = [begin + span * i / number for i in range(number)] + [end]
        if self._theta < 1 and self._start is not None and begin == self._start.time:
            # What edges do at once at the start would ring on: it is damped first.
            first = times[1] - begin
            quarters = [begin + first * i / SOFT for i in range(SOFT)] + [times[1]]
            yield from ((a, b, 1.0) for a, b in pairwise(quarters))
            times = times[1:]
        yield from ((a, b, self._theta) for a, b in pairwise(times))
