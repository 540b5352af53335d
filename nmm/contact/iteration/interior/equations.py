"""Newton's equations of the interior point, reduced to the unknowns of the step."""

from integration.arrays import Floats
from nmm.contact.iteration.interior.complementarity import Complementarity, InteriorIterate
from nmm.contact.iteration.interior.elimination import load_for, reduced, step_of
from nmm.contact.problem.matrix_pattern import LaidProblem
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
        laid: LaidProblem,
        linear: LinearSolver,
        at: InteriorIterate,
        soft: float,
        coupled: bool = True,
    ) -> None:
        self.sides, self.at, self.solves = sides, at, 0
        springs = sides.springs.columns
        self.given = reduced(at.columns, springs, sides.columns(soft), coupled)
        normal, shear, mixed = self.given[4]
        self.factor = linear.factorise(laid.matrix(normal, shear, mixed * normal))

    def step(self, targets: Floats) -> InteriorIterate:
        """Step that brings every product to its value plus its entry of ``targets`` (3, m)."""
        rows, active = self.sides.springs.problem.compressed_rows, self.sides.active
        load, jump, flow = load_for(targets, self.at.slack, self.given, rows, active)
        increment, self.solves = -self.factor.apply(load), self.solves + 1
        return InteriorIterate(*step_of(increment, jump, flow, self.given, rows))
