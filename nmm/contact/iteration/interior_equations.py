"""Newton's equations of the interior point, reduced to the unknowns of the step."""

import numpy as np

from integration.arrays import Floats
from nmm.contact.iteration.complementarity import Complementarity, InteriorIterate
from nmm.contact.problem.coulomb import bound_slope
from nmm.contact.problem.matrix_pattern import SpringPattern
from nmm.contact.problem.row_products import stretched
from nmm.solvers.linear import LinearSolver


class Linearised:
    """The equations at a point, factorised; `solves` counts what was asked of them.

    Bounds follow the normal force where ``coupled``; else the equations are those of a convex
    problem, whose bounds stand still, and the next step sees what was missed.

    With ``y = flow / slack`` and the bound's step ``dB = -mu dN``, terms that are known left out,

        dN = G_n dd / (c_n + y_0),   dT = (G_t dd + (y_1 - y_2) dB) / (c_t + y_1 + y_2).
    """

    def __init__(
        self,
        sides: Complementarity,
        pattern: SpringPattern,
        linear: LinearSolver,
        at: InteriorIterate,
        soft: float,
        coupled: bool = True,
    ) -> None:
        self.problem, self.sides, self.at, self.solves = sides.springs.problem, sides, at, 0
        self._residuals()
        give = np.where(sides.exact, soft * sides.compliance, sides.give)
        follows = sides.active[1] & coupled
        self.slope = np.where(follows, bound_slope(at.normal, self.problem.limits), 0.0)
        self.ratio = np.where(sides.active, at.flow / at.slack, 0.0)
        self.spring_n = 1 / (give[0] + self.ratio[0])
        spring_t = 1 / (give[1] + self.ratio[1] + self.ratio[2])
        self.spring_t = np.where(sides.smooth, 0.0, spring_t)
        self.mixed = self.spring_t * (self.ratio[2] - self.ratio[1]) * self.slope
        springs = (self.spring_n, self.spring_t, self.mixed * self.spring_n)
        self.factor = linear.factorise(pattern.matrix(self.problem, *springs))

    def _residuals(self) -> None:
        problem, sides, at = self.problem, self.sides, self.at
        springs, give = sides.springs, sides.give
        flow = np.where(sides.active, at.flow, 0.0)
        bound = sides.bound(at.normal, at.slack[0], at.flow[0])
        held = np.array([problem.limits.tension - at.normal, bound - at.shear, bound + at.shear])
        carried = problem.pushed(at.normal, at.shear)
        self.rest = problem.matrix @ at.increment - problem.force + carried
        gap, slip = problem.jumps(at.increment)
        self.rest_gap = gap - flow[0] - (at.normal - springs.shift[0]) * give[0]
        self.rest_slip = slip - flow[1] + flow[2] - (at.shear - springs.shift[1]) * give[1]
        self.rest_slack = np.where(sides.active, at.slack - np.where(sides.active, held, 0), 0.0)

    def step(self, targets: Floats) -> InteriorIterate:
        """Step that brings every product to its value plus its entry of ``targets`` (3, m)."""
        problem, ratio, rest = self.problem, self.ratio, self.rest_slack
        flow = np.where(self.sides.active, targets / self.at.slack, 0.0)
        known_n = self.rest_gap - flow[0] - ratio[0] * rest[0]
        known_t = self.rest_slip - flow[1] + flow[2] - ratio[1] * rest[1] + ratio[2] * rest[2]
        normal = self.spring_n * known_n
        shear = self.spring_t * known_t + self.mixed * normal
        load = self.rest + problem.pushed(normal, shear)
        increment, self.solves = -self.factor.apply(load), self.solves + 1
        opened, slipped = stretched(*problem.rows, increment)
        normal = self.spring_n * (opened + known_n)
        shear = self.spring_t * (slipped + known_t) + self.mixed * normal
        bound = -self.slope * normal
        slack = np.array([-normal, bound - shear, bound + shear]) - rest
        return InteriorIterate(increment, normal, shear, slack, flow - ratio * slack)
