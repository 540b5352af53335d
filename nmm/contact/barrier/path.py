"""Interior point down to the width of a barrier, for steps that begin far from their end.

Force and gap are independent unknowns, both positive, with a product that sinks (Mehrotra 1992):
so the states of hundreds of contacts are found in some ten factorisations, where Newton's method
on the barrier itself would creep along its walls.
"""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Bools, Floats
from nmm.contact.iteration.multiplier_rounds import compliances
from nmm.contact.problem.cut_springs import CutSprings
from nmm.contact.problem.matrix_pattern import SpringPattern
from nmm.contact.problem.step_problem import StepProblem
from nmm.errors import SolveError
from nmm.solvers.linear import LinearSolver

FAR = 0.99
"""Part of the way to the boundary that a step may take."""
JAM, WHOLE = 0.1, 0.9
"""Steps shorter than the first part recentre; one longer than the second may end the path."""
DEEP, LOST = 0.3, 1e-3
"""Parts of the goal at which products are aimed at least, and below which the path was left."""
STUCK = 1e-4
"""Step at which nothing holds a part: the load drives it away from all contacts."""


@dataclass(frozen=True)
class Point:
    """Unknowns (n,), and of every contact (m,) pressure, distance, shear and slips past a bound.

    ``pressure`` and ``distance`` stay positive, as do ``ahead`` and ``back``, whose difference is
    the slip, and the distances of the shear force from its two bounds. Steps have the same names.
    """

    increment: Floats
    pressure: Floats
    distance: Floats
    shear: Floats
    ahead: Floats
    back: Floats

    def moved(self, step: "Point", part: float) -> "Point":
        """Point after ``part`` of ``step``."""
        names = ("increment", "pressure", "distance", "shear", "ahead", "back")
        return Point(*(getattr(self, name) + part * getattr(step, name) for name in names))


class Path:
    """The path of one problem whose contacts have no law of their own.

    Attributes
    ----------
    factorisations
        Matrices factorised so far.
    """

    def __init__(
        self, problem: StepProblem, behind: Floats, pattern: SpringPattern, linear: LinearSolver
    ) -> None:
        """Lay out the path with walls (m,) ``behind`` touching (m)."""
        self.problem, self.behind, self.pattern = problem, behind, pattern
        self.linear = linear.unsymmetric()
        limits = problem.limits
        self.rubs: Bools = (limits.friction > 0) | (limits.cohesion > 0)
        self.factorisations = 0

    def start(self, rough: CutSprings, increment: Floats) -> Point:
        """Point near roughly settled springs, in the middle of its way."""
        problem, (soft, soft_shear) = self.problem, compliances(self.problem)
        normal, shear = rough.forces(increment)
        typical = float(np.sqrt(np.mean(normal**2))) or 1.0
        pressure = np.maximum(-normal, typical)
        gap = problem.gaps(increment) + self.behind
        distance = np.maximum(gap, typical**2 * soft / pressure)
        self.cohesion = np.where(normal < 0, problem.limits.cohesion, 0.0)
        bound = self._bound(pressure)
        shear = np.where(self.rubs, np.clip(shear, -0.5 * bound, 0.5 * bound), 0.0)
        slip = problem.slips(increment)
        past = typical**2 * soft_shear / np.where(self.rubs, bound, 1.0)
        ahead, back = np.maximum(slip, 0) + past, np.maximum(-slip, 0) + past
        return Point(increment, pressure, distance, shear, ahead, back)

    def followed(self, point: Point, goal: float, budget: int) -> Point | None:
        """Point where the mean product of force and distance is down to ``goal`` (N m)."""
        part = 1.0
        for _ in range(budget):
            mean = self._mean(point)
            if mean <= goal and part > WHOLE:
                return point
            if not mean > LOST * goal or part < STUCK:
                return None
            try:
                system = _System(self, point)
            except SolveError:
                return None
            self.factorisations += 1
            sure = system.step(tuple(-x * y for x, y in self._pairs(point)))
            reach = self._longest(point, sure)
            shrunk = (self._mean(point.moved(sure, reach)) / mean) ** 3
            jammed = part < JAM
            centre = max(mean * (1.0 if jammed else min(shrunk, 1.0)), DEEP * goal)
            second = 0.0 if jammed or reach < JAM else 1.0
            targets = tuple(
                centre - second * dx * dy - x * y
                for (x, y), (dx, dy) in zip(self._pairs(point), self._changes(sure), strict=True)
            )
            step = system.step(targets)
            part = min(1.0, FAR * self._longest(point, step))
            point = point.moved(step, part)
        return None

    def _bound(self, pressure: Floats) -> Floats:
        return np.asarray(self.cohesion + self.problem.limits.friction * pressure)

    def _pairs(self, at: Point) -> tuple[tuple[Floats, Floats], ...]:
        """Products of the path: pressure and distance, room below a bound and slip past it."""
        bound = self._bound(at.pressure)
        return (
            (at.pressure, at.distance),
            (bound - at.shear, at.ahead),
            (bound + at.shear, at.back),
        )

    def _changes(self, step: Point) -> tuple[tuple[Floats, Floats], ...]:
        grown = self.problem.limits.friction * step.pressure
        return (
            (step.pressure, step.distance),
            (grown - step.shear, step.ahead),
            (grown + step.shear, step.back),
        )

    def _mean(self, point: Point) -> float:
        normal, *slides = (x * y for x, y in self._pairs(point))
        total = float(normal.sum() + sum(products[self.rubs].sum() for products in slides))
        return total / (len(normal) + 2 * int(self.rubs.sum()))

    def _longest(self, point: Point, step: Point) -> float:
        """Part of ``step`` up to the first quantity that would vanish."""
        part = 1.0
        for number, (values, changes) in enumerate(
            zip(self._pairs(point), self._changes(step), strict=True)
        ):
            for value, change in zip(values, changes, strict=True):
                falls = (change < 0) & (self.rubs | (number == 0))
                if falls.any():
                    part = min(part, float((-value[falls] / change[falls]).min()))
        return part


class _System:
    """Linearised equations of the path at a point, reduced to the unknowns of the step."""

    def __init__(self, path: Path, at: Point) -> None:
        self.path, self.at = path, at
        problem, rubs = path.problem, path.rubs
        (_, _), (self.room, _), (self.room_back, _) = path._pairs(at)
        self.stiff = at.pressure / at.distance
        give = at.ahead / np.where(rubs, self.room, 1.0)
        give_back = at.back / np.where(rubs, self.room_back, 1.0)
        self.stiff_shear = np.where(rubs, 1 / (give + give_back), 0.0)
        self.drag = self.stiff_shear * (give_back - give) * problem.limits.friction
        self.gap = problem.gaps(at.increment) + path.behind - at.distance
        self.slip = problem.slips(at.increment) - (at.ahead - at.back)
        matrix = path.pattern.matrix(problem, self.stiff, self.stiff_shear, self.drag * self.stiff)
        self.factor = path.linear.factorise(matrix)
        self.rest = problem.out_of_balance(at.increment, -at.pressure, at.shear)

    def step(self, targets: tuple[Floats, ...]) -> Point:
        """Step that changes every product by its entry of ``targets`` (m,)."""
        at, problem, rubs = self.at, self.path.problem, self.path.rubs
        to_ahead = np.where(rubs, targets[1], 0.0) / np.where(rubs, self.room, 1.0)
        to_back = np.where(rubs, targets[2], 0.0) / np.where(rubs, self.room_back, 1.0)
        known = self.stiff * self.gap - targets[0] / at.distance
        known_shear = self.stiff_shear * (self.slip - to_ahead + to_back) + self.drag * known
        load = self.rest + problem.normal_rows.T @ known + problem.tangent_rows.T @ known_shear
        increment = -self.factor.apply(load)
        opening = problem.normal_rows @ increment
        normal = self.stiff * opening + known
        sliding = problem.tangent_rows @ increment
        shear = self.stiff_shear * sliding + self.drag * self.stiff * opening + known_shear
        grown = -problem.limits.friction * normal
        ahead = to_ahead - at.ahead / np.where(rubs, self.room, 1.0) * (grown - shear)
        back = to_back - at.back / np.where(rubs, self.room_back, 1.0) * (grown + shear)
        return Point(increment, -normal, opening + self.gap, shear, ahead, back)
