"""Newton's method on unknowns and forces of a barrier together, to its own end or not at all."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.contact.barrier.curve import Curves, LawPoints
from nmm.contact.barrier.potential import Potential
from nmm.contact.iteration.multiplier_rounds import compliances, stiff_springs
from nmm.contact.iteration.tools import Tools
from nmm.errors import SolveError
from nmm.solvers.linear import Factor
from nmm.solvers.norm import norm

Trials = tuple[Floats, Floats]


@dataclass(frozen=True)
class Start:
    """Unknowns (n,) with trials (m,) of the forces in the springs of a `Newton`."""

    increment: Floats
    trials: Trials


@dataclass(frozen=True)
class _State:
    """Where an iteration stands, and by how much it misses balance and laws."""

    increment: Floats
    trials: Trials
    spot: LawPoints
    rest: Floats
    gap: Floats
    slip: Floats
    miss: float


class Newton:
    """Primal-dual Newton's method: linear in balance, gaps and laws at points on the laws.

    Steps are those of the potential, taken where force and gap belong to the trial instead of
    where the gap alone says. So gaps may pass the wall on the way; `run` says that it converged
    only at gaps before the wall whose own forces are in balance.

    Attributes
    ----------
    factorisations, solves
        Matrices factorised and systems solved so far.
    """

    def __init__(self, well: Potential, tools: Tools, weight: Floats) -> None:
        self.options, self.linear = tools.options.barrier, tools.linear.unsymmetric()
        self.well, self.pattern = well, tools.memory.pattern_of(well.problem)
        springs = stiff_springs(well.problem, 1.0)
        self.weight, self.own = springs.weight, weight
        self.soft = tuple(1 / c for c in compliances(well.problem))
        self.curves = Curves(
            well, self.options.stiff * self.soft[0], self.options.stiff * self.soft[1]
        )
        self.size = norm(self.weight * well.problem.force) or 1.0
        self.bound: Floats | None = None
        self.factorisations = self.solves = 0

    def run(self, start: Start, tolerance: float, budget: int, patient: bool) -> Floats | None:
        """Unknowns (n,) in balance within ``tolerance``, or None.

        Without patience the attempt ends at the first sign that it began too far away.
        """
        at = self._state(start.increment, start.trials)
        least, found, parts = at.miss, [at.miss], [1.0]
        for count in range(budget):
            if self._balanced(at, tolerance):
                return at.increment
            try:
                factor = self._factor(at)
            except SolveError:
                return None
            most = self.options.growth * least if patient and count < self.options.free else 0.0
            new, part = self._along(at, self._step(at, factor), most)
            if new is None:
                return None
            at = self._chords(new, factor, tolerance)
            found, parts = [*found, at.miss], [*parts, part]
            least = min(least, at.miss)
            slow = (
                count >= self.options.look - 1
                and at.miss > self.options.slow * found[-1 - self.options.look]
            )
            if not patient and (slow or max(parts[-2:]) < self.options.short):
                return None
        return at.increment if self._balanced(at, tolerance) else None

    def under_bound(self, start: Start, bound: Floats, budget: int) -> tuple[Start, Floats]:
        """Start near the balance under a given ``bound`` (m,) of friction, and normal forces (m,).

        Such a step is a convex problem: it ends where friction that follows stands still.
        """
        self.bound = bound
        at = self._state(start.increment, start.trials)
        for _ in range(budget):
            if at.miss <= self.options.near * self.size:
                break
            try:
                factor = self._factor(at)
            except SolveError:
                break
            new, _ = self._along(at, self._step(at, factor), 0.0)
            if new is None:
                break
            at = self._chords(new, factor, 0.0)
        self.bound = None
        return Start(at.increment, at.trials), at.spot.pull.normal

    def _state(self, increment: Floats, trials: Trials) -> _State:
        problem = self.well.problem
        places = problem.gaps(increment), problem.slips(increment)
        spot = self.curves.at(trials, *places, self.bound)
        rest = problem.out_of_balance(increment, spot.pull.normal, spot.pull.shear)
        gap, slip = places[0] - spot.gap, places[1] - spot.slip
        parts = float(self.soft[0] @ gap**2 + self.soft[1] @ slip**2)
        miss = float(np.sqrt(norm(self.weight * rest) ** 2 + parts))
        return _State(increment, trials, spot, rest, gap, slip, miss)

    def _balanced(self, at: _State, tolerance: float) -> bool:
        if not at.miss <= self.options.near * self.size:
            return False
        return self.well.imbalance(at.increment, self.own) <= tolerance

    def _factor(self, at: _State) -> Factor:
        pull = at.spot.pull
        stiffness = (pull.normal_stiffness, pull.shear_stiffness, pull.mixed_stiffness)
        self.factorisations += 1
        return self.linear.factorise(self.pattern.matrix(self.well.problem, *stiffness))

    def _step(self, at: _State, factor: Factor) -> tuple[Floats, Trials]:
        """Changes of unknowns and trials that meet the linearised equations."""
        problem, pull = self.well.problem, at.spot.pull
        normal = pull.normal_stiffness * at.gap
        shear = pull.shear_stiffness * at.slip + pull.mixed_stiffness * at.gap
        load = at.rest + problem.normal_rows.T @ normal + problem.tangent_rows.T @ shear
        step = -factor.apply(load)
        self.solves += 1
        opening = problem.normal_rows @ step + at.gap
        sliding = problem.tangent_rows @ step + at.slip
        shear = pull.shear_stiffness * sliding + pull.mixed_stiffness * opening
        normal = (pull.normal_stiffness + self.curves.normal) * opening
        return step, (normal, shear + self.curves.shear * sliding)

    def _moved(self, at: _State, step: tuple[Floats, Trials], part: float) -> _State:
        moved = tuple(t + part * c for t, c in zip(at.trials, step[1], strict=True))
        return self._state(at.increment + part * step[0], (moved[0], moved[1]))

    def _along(
        self, at: _State, step: tuple[Floats, Trials], most: float
    ) -> tuple[_State | None, float]:
        """State after the largest part of ``step`` that misses less, or ``most`` at most."""
        if not np.isfinite(step[0]).all():
            return None, 0.0
        for part in 0.5 ** np.arange(self.options.halvings):
            new = self._moved(at, step, float(part))
            if new.miss < max((1 - 0.1 * part) * at.miss, most):
                return new, float(part)
        return None, 0.0

    def _chords(self, at: _State, factor: Factor, tolerance: float) -> _State:
        """State after further solutions with ``factor``, while they are worth it."""
        for _ in range(self.options.chords):
            if self._balanced(at, tolerance):
                break
            new = self._moved(at, self._step(at, factor), 1.0)
            if not new.miss < self.options.gain * at.miss:
                break
            at = new
        return at
