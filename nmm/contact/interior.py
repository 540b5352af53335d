"""Interior point on Coulomb's law, for problems on which cheaper iterations stall.

Unknowns beside ``d`` and the forces are, at each contact, the distance ``p`` of the normal force
from the tension limit with the opening ``w``, and the distances ``a, b`` of the shear force from
its two bounds with the sliding ``u, v`` over them:

    p w = a u = b v = kappa,   gap = N / k + w,   slip = T / k + u - v,

followed to ``kappa -> 0`` by Mehrotra's predictor and corrector (1992). The bound moves with the
normal force inside the linearisation, so there is no dilatancy; the matrix is then unsymmetric.
"""

from dataclasses import dataclass, replace

import numpy as np

from integration.arrays import Bools, Floats
from nmm.contact.newton import polish
from nmm.contact.pattern import SpringPattern
from nmm.contact.springs import CutSprings, Settled
from nmm.solvers.linear import Factor, LinearSolver

NEAR = 0.99
"""Part of the way to the boundary that a step may take."""
JAM = 0.1
"""Length of a step after which the next one only recentres."""
PATIENCE, ROUGH = 10, 1e-6
"""Steps without halving a defect below `ROUGH` after which rounding has the last word."""
SOFT = 1e-6
"""Compliance left to exact contacts in the matrix, as a part of their spring's."""


@dataclass(frozen=True)
class Point:
    """Unknowns of the method, and by the same names their steps."""

    increment: Floats
    normal: Floats
    shear: Floats
    p: Floats
    w: Floats
    a: Floats
    u: Floats
    b: Floats
    v: Floats

    def moved(self, step: "Point", length: float) -> "Point":
        """Point at ``length`` along ``step``."""
        names = ("increment", "normal", "shear", "p", "w", "a", "u", "b", "v")
        return Point(*(getattr(self, n) + length * getattr(step, n) for n in names))

    def pairs(self) -> tuple[tuple[Floats, Floats], ...]:
        """Complementary quantities."""
        return (self.p, self.w), (self.a, self.u), (self.b, self.v)


class InteriorPoint:
    """One run of the method on ``springs``.

    Contacts marked ``exact`` obey ``gap >= 0`` and a sharp bound instead of a spring. Their spring
    only measures how far force and gap are from the law, and a part ``SOFT`` of its compliance
    regularises the matrix (Friedlander, Orban 2012), so that redundant contacts do no harm. What
    their forces still lack counts by the part ``slack`` beside the out-of-balance force.
    """

    def __init__(
        self,
        springs: CutSprings,
        pattern: SpringPattern,
        linear: LinearSolver,
        exact: Bools | None = None,
        slack: float = 1.0,
    ) -> None:
        self.springs, self.pattern, self.slack = springs, pattern, slack
        self.exact = np.zeros(springs.problem.n_contacts, dtype=bool) if exact is None else exact
        self.linear = linear.unsymmetric()
        limits = springs.problem.limits
        self.can_open = np.isfinite(limits.tension)
        self.can_slide = np.isfinite(limits.cohesion)
        self.smooth = (limits.friction == 0) & (limits.cohesion == 0)
        self.bounded = self.can_slide & ~self.smooth
        soft = np.where(self.exact, SOFT, 1.0)
        self.compliance_n = soft / springs.normal_stiffness
        self.compliance_t = soft / springs.shear_stiffness

    def run(self, start: Settled, budget: int, tolerance: float) -> Settled:
        """Follow the central path with at most ``budget`` factorisations.

        ``start`` gives unknowns and the size of forces; its springs may be softer.
        """
        springs, point = self.springs, self._start(start)
        size = max(springs.defect(start.increment).size, self._jump(springs, point))
        best = Settled(springs, start.increment, size, 0, 0, "")
        factorisations = solves = 0
        tried = mark = 1.0
        idle, length = 0, 1.0
        for _ in range(budget):
            springs = self._springs(point)
            size = max(springs.defect(point.increment).size, self._jump(springs, point))
            if size < best.size:
                best = replace(best, springs=springs, increment=point.increment, size=size)
            if size < 0.1 * tried and size < 1e-3 and not self.exact.any():
                tried = size
                end = polish(springs, self.pattern, self.linear, point.increment, tolerance)
                factorisations, solves = factorisations + end.factorisations, solves + end.solves
                if end.size < best.size:
                    best = replace(best, springs=springs, increment=end.increment, size=end.size)
            if best.size <= tolerance or not np.isfinite(point.increment).all():
                break
            idle = 0 if best.size < 0.5 * mark else idle + 1
            mark = best.size if idle == 0 else mark
            if idle > PATIENCE and best.size < ROUGH:
                break
            kappa = _gap(point, self)
            # Contacts that can neither open nor slide leave a linear step: there is no path.
            if kappa <= 0:
                break
            system = _Linearised(self, point)
            factorisations, solves = factorisations + 1, solves + 2
            affine = system.step(tuple(-x * y for x, y in point.pairs()))
            ahead = self._length(point, affine)
            shrink = (_gap(point.moved(affine, ahead), self) / kappa) ** 3
            jammed = length < JAM
            centre = kappa * (1.0 if jammed else min(max(shrink, 1e-8), 1.0))
            along = 1.0 if ahead > JAM and not jammed else 0.0
            targets = tuple(
                centre - along * dx * dy - x * y
                for (x, y), (dx, dy) in zip(point.pairs(), affine.pairs(), strict=True)
            )
            step = system.step(targets)
            length = min(1.0, NEAR * self._length(point, step))
            point = point.moved(step, length)
        if best.size > tolerance:
            end = polish(best.springs, self.pattern, self.linear, best.increment, tolerance)
            factorisations, solves = factorisations + end.factorisations, solves + end.solves
            if end.size < best.size:
                best = replace(best, increment=end.increment, size=end.size)
        story = f"interior point with {factorisations} factorisations"
        return replace(best, solves=solves, factorisations=factorisations, story=story)

    def _springs(self, point: Point) -> CutSprings:
        shifts = (self.springs.normal_shift, self.springs.shear_shift)
        forces = (point.normal, point.shear)
        chosen = (np.where(self.exact, f, s) for f, s in zip(forces, shifts, strict=True))
        return self.springs.shifted(*chosen)

    def _jump(self, springs: CutSprings, point: Point) -> float:
        if not self.exact.any():
            return 0.0
        found = np.concatenate(springs.forces(point.increment))
        meant = np.concatenate([point.normal, point.shear])
        size = float(np.abs(found).max())
        return self.slack * float(np.abs(found - meant).max()) / size if size > 0 else 0.0

    def _start(self, start: Settled) -> Point:
        springs, limits = self.springs, self.springs.problem.limits
        increment = start.increment
        normal, shear = start.springs.forces(increment)
        finite = np.abs(np.where(np.isfinite(normal), normal, 0.0))
        typical = float(np.sqrt(np.mean(finite**2))) or 1.0
        soft_n, soft_t = 1 / start.springs.normal_stiffness, 1 / start.springs.shear_stiffness
        pull = np.where(self.can_open, limits.tension, 0.0)
        p = np.maximum(pull - normal, typical)
        gap = springs.problem.gaps(increment) - (normal - start.springs.normal_shift) * soft_n
        normal = np.where(self.can_open, pull - p, normal)
        w = np.maximum(gap, typical**2 * soft_n / p)
        bound = np.where(self.bounded, self.bound(normal, p, w), 0.0)
        shear = np.where(self.bounded, np.clip(shear, -0.5 * bound, 0.5 * bound), shear)
        shear = np.where(self.smooth, 0.0, shear)
        over = springs.problem.slips(increment) - (shear - start.springs.shear_shift) * soft_t
        a = np.maximum(bound - shear, 1e-3 * typical)
        b = np.maximum(bound + shear, 1e-3 * typical)
        u = np.maximum(over, 0) + typical**2 * soft_t / a
        v = np.maximum(-over, 0) + typical**2 * soft_t / b
        return Point(increment, normal, shear, p, w, a, u, b, v)

    def bound(self, normal: Floats, p: Floats, w: Floats) -> Floats:
        """Bound of the shear force; the cohesion of an unbonded contact counts while it closes."""
        limits = self.springs.problem.limits
        closes = (limits.tension > 0) | (p > w * self.springs.normal_stiffness)
        return np.where(closes, limits.cohesion, 0.0) + limits.friction * np.maximum(-normal, 0.0)

    def _length(self, point: Point, step: Point) -> float:
        length = 1.0
        masks = (self.can_open, self.bounded, self.bounded)
        for mask, pair, move in zip(masks, point.pairs(), step.pairs(), strict=True):
            for value, change in zip(pair, move, strict=True):
                falls = mask & (change < 0)
                if falls.any():
                    length = min(length, float((-value[falls] / change[falls]).min()))
        return length


class _Linearised:
    """Newton's equations at a point, reduced to the unknowns of the step."""

    def __init__(self, method: InteriorPoint, at: Point) -> None:
        self.method, self.at = method, at
        springs = method.springs
        problem, limits = springs.problem, springs.problem.limits
        rest = problem.out_of_balance(at.increment, at.normal, at.shear)
        over_n = (at.normal - springs.normal_shift) * method.compliance_n
        over_t = (at.shear - springs.shear_shift) * method.compliance_t
        gap = problem.gaps(at.increment) - at.w * method.can_open
        self.rest_gap = gap - np.where(method.exact, 0.0, over_n)
        slip = problem.slips(at.increment) - (at.u - at.v) * method.bounded
        self.rest_slip = slip - np.where(method.exact, 0.0, over_t)
        bound = np.where(method.bounded, method.bound(at.normal, at.p, at.w), 0.0)
        self.rest_a = np.where(method.bounded, at.a - (bound - at.shear), 0.0)
        self.rest_b = np.where(method.bounded, at.b - (bound + at.shear), 0.0)
        self.pull = np.where(method.can_open, limits.tension - at.normal - at.p, 0.0)
        self.slope = np.where(at.normal < 0, limits.friction, 0.0) * method.bounded
        self.yield_n = np.where(method.can_open, at.w / at.p, 0.0)
        self.yield_a = np.where(method.bounded, at.u / at.a, 0.0)
        self.yield_b = np.where(method.bounded, at.v / at.b, 0.0)
        self.spring_n = 1 / (method.compliance_n + self.yield_n)
        spring_t = 1 / (method.compliance_t + self.yield_a + self.yield_b)
        self.spring_t = np.where(method.smooth, 0.0, spring_t)
        self.mixed = self.spring_t * (self.yield_b - self.yield_a) * self.slope
        matrix = method.pattern.matrix(
            problem, self.spring_n, self.spring_t, self.mixed * self.spring_n
        )
        self.factor: Factor = method.linear.factorise(matrix)
        self.rest = rest

    def step(self, targets: tuple[Floats, ...]) -> Point:
        """Step that brings every product to its value plus its entry of ``targets``."""
        at, method = self.at, self.method
        problem = method.springs.problem
        to_w = _over(targets[0], at.p, method.can_open)
        to_u = _over(targets[1], at.a, method.bounded)
        to_v = _over(targets[2], at.b, method.bounded)
        known_n = self.rest_gap - to_w + self.yield_n * self.pull
        known_t = self.rest_slip - to_u + to_v - self.yield_a * self.rest_a
        known_t = known_t + self.yield_b * self.rest_b
        force_n = self.spring_n * known_n
        force_t = self.spring_t * known_t + self.mixed * force_n
        load = self.rest + problem.normal_rows.T @ force_n + problem.tangent_rows.T @ force_t
        increment = -self.factor.refined(load)
        normal = self.spring_n * (problem.normal_rows @ increment) + force_n
        shear = self.spring_t * (problem.tangent_rows @ increment + known_t) + self.mixed * normal
        p = self.pull - normal
        bound = -self.slope * normal
        a = bound - shear - self.rest_a
        b = bound + shear - self.rest_b
        w = to_w - self.yield_n * p
        u, v = to_u - self.yield_a * a, to_v - self.yield_b * b
        return Point(increment, normal, shear, p, w, a, u, b, v)


def _over(target: Floats, value: Floats, mask: Bools) -> Floats:
    return np.asarray(np.divide(target, value, out=np.zeros_like(target), where=mask))


def _gap(point: Point, method: InteriorPoint) -> float:
    masks = (method.can_open, method.bounded, method.bounded)
    count = sum(int(mask.sum()) for mask in masks)
    products = zip(masks, point.pairs(), strict=True)
    return float(sum((x * y)[mask].sum() for mask, (x, y) in products) / max(count, 1))
