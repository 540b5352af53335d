"""Interior point on Coulomb's law: fifteen to thirty factorisations, whatever the contacts do.

Slack and flow of every side of every contact (`complementarity` in this room) are kept positive
with the same product,

    p w = a u = b v = kappa,   gap = N / k + w,   slip = T / k + u - v,

and ``kappa -> 0`` is followed by Mehrotra's predictor and corrector (1992) with Gondzio's
corrections of centrality (1996). The bound moves with the normal force inside the linearisation,
so there is no dilatancy; the matrix is then unsymmetric.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from nmm.contact.iteration.interior.centrality import recentred
from nmm.contact.iteration.interior.complementarity import Complementarity, InteriorIterate
from nmm.contact.iteration.interior.equations import Linearised
from nmm.contact.iteration.interior.settling import Settling
from nmm.contact.iteration.newton.semismooth_newton import polish
from nmm.contact.iteration.tools import Tools
from nmm.contact.problem.cut_springs import IterationResult
from nmm.errors import SolveError


@dataclass(frozen=True)
class Goal:
    """Tolerances: relative out-of-balance force, and `IterationResult.error` of exact contacts."""

    balance: float
    error: float = np.inf

    def distance(self, found: IterationResult) -> float:
        """How many times the tolerances are exceeded; up to 1 they are met."""
        return max(found.size / self.balance, found.error / self.error)


class InteriorPoint:
    """One search for forces on the springs and sharp contacts of ``sides``.

    Attributes
    ----------
    reached
        Last point of the path, from which another search may go on.
    factorisations, solves
        So far.
    """

    def __init__(self, sides: Complementarity, tools: Tools) -> None:
        self.options, self.linear = tools.options.interior, tools.linear.unsymmetric()
        # Springs and inertia hold all parts: what single precision leaves out of balance the next
        # step takes up. Neither exact contacts nor mechanisms in statics are so kind.
        kind = tools.memory.moving and not sides.exact.any()
        self.inside = self.linear.rough() if kind else self.linear
        self.sides, self.pattern = sides, tools.memory.pattern_of(sides.springs.problem)
        self.laid = self.pattern.laid(sides.springs.problem)
        self.keep = tools.memory.keep_tangent
        self.factorisations = self.solves = 0
        self.reached: InteriorIterate

    def run(
        self,
        start: InteriorIterate,
        budget: int,
        goal: Goal,
        nearer: InteriorIterate | None = None,
    ) -> IterationResult:
        """Follow paths with at most ``budget`` factorisations in all; return the best found.

        The first is from ``nearer``, if given, the others from ``start`` and its multiples.
        """
        best, self.reached = self.sides.judged(start), start
        for at in self._starts(start, nearer):
            best = self._followed(at, best, budget, goal)
            if goal.distance(best) <= 1 or self.factorisations >= budget:
                break
        return replace(
            best,
            solves=self.solves,
            factorisations=self.factorisations,
            story=f"interior point with {self.factorisations} factorisations",
        )

    def _starts(
        self, start: InteriorIterate, nearer: InteriorIterate | None
    ) -> Iterator[InteriorIterate]:
        if nearer is not None:
            yield nearer
        for distance in self.options.distances:
            yield replace(start, slack=distance * start.slack, flow=distance * start.flow)

    def centred(
        self, point: InteriorIterate, product: float, budget: int
    ) -> InteriorIterate | None:
        """Point near the path whose mean product of slack and flow (J) is down to ``product``.

        None where the path cannot be followed that far, as of a part that nothing holds.
        """
        options, length = self.options, 1.0
        for _ in range(budget):
            kappa = self.sides.mean(point)
            if kappa <= product and length > options.whole:
                return point
            if not kappa > options.left * product or length < options.stuck:
                return None
            try:
                point, length = self._moved(
                    point, kappa, length < options.jam, options.deep * product
                )
            except SolveError:
                return None
        return None

    def _followed(
        self, point: InteriorIterate, best: IterationResult, budget: int, goal: Goal
    ) -> IterationResult:
        """Best of what is known and of the path from ``point``."""
        length, mark, idle = 1.0, np.inf, 0
        settling = Settling(self.options.settled)
        while (
            self.factorisations < budget
            and goal.distance(best) > 1
            and idle <= self.options.patience
        ):
            kappa = self.sides.mean(point)
            # Contacts that can neither open nor slide leave a linear step: there is no path.
            if kappa <= 0:
                break
            idle, mark = (0, kappa) if kappa < 0.5 * mark else (idle + 1, mark)
            point, length = self._moved(point, kappa, length < self.options.jam)
            if not np.isfinite(point.increment).all():
                break
            self.reached, found = point, self.sides.judged(point)
            if not self.sides.exact.any() and settling.seen(self.sides, point):
                found = self._polished(found, goal)
            best = found if goal.distance(found) < goal.distance(best) else best
        return best

    def _polished(self, found: IterationResult, goal: Goal) -> IterationResult:
        """Newton's method on springs from a point that may be near enough for it."""
        given = found.springs, lambda: self.pattern, self.linear
        end = polish(*given, found.increment, goal.balance, keep=self.keep)
        self.factorisations += end.factorisations
        self.solves += end.solves
        return end if end.size < found.size else found

    def _moved(
        self, point: InteriorIterate, kappa: float, jammed: bool, floor: float = 0.0
    ) -> tuple[InteriorIterate, float]:
        """Point after predictor, corrector and corrections of centrality, and how far it went."""
        sides, options, products = self.sides, self.options, point.slack * point.flow
        system = Linearised(sides, self.laid, self.inside, point, options.soft, not jammed)
        affine = system.step(-products)
        if not np.isfinite(affine.increment).all():
            return affine, 0.0
        ahead = sides.length(point, affine)
        shrink = (sides.mean(point, affine, ahead) / kappa) ** 3
        centre = max(floor, kappa * (1.0 if jammed else min(max(shrink, 1e-8), 1.0)))
        along = affine.slack * affine.flow if ahead > options.jam and not jammed else 0.0
        targets = centre - along - products
        step = system.step(targets)
        length = min(1.0, options.boundary * sides.length(point, step))
        for _ in range(options.corrections):
            tried = min(1.0, length + options.reach), centre, options.spread
            targets = recentred(targets, point.columns, step.columns, *map(float, tried))
            longer = system.step(targets)
            reached = min(1.0, options.boundary * sides.length(point, longer))
            if reached < length + options.gain:
                break
            step, length = longer, reached
        self.factorisations += 1
        self.solves += system.solves
        return point.moved(step, length), length
