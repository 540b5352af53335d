"""Energies of barrier contact: forces and curvatures that grow smoothly towards a wall."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from integration.arrays import Bools, Floats
from nmm.contact.problem.balance import relative_residual
from nmm.contact.problem.coulomb import bound_slope, shear_bound
from nmm.contact.problem.step_problem import StepProblem

DEEPEST = 0.49
"""Widths below touching at which a contact may start before its wall is moved back."""


@dataclass(frozen=True)
class BarrierForces:
    """Forces of all contacts and what they change with.

    Attributes
    ----------
    normal, shear
        (m,) forces (N).
    normal_stiffness, shear_stiffness
        (m,) derivatives by gap and slip for a given bound (N/m).
    mixed_stiffness
        (m,) derivative of the shear force by the gap where the bound follows the normal force.
    """

    normal: Floats
    shear: Floats
    normal_stiffness: Floats
    shear_stiffness: Floats
    mixed_stiffness: Floats


@dataclass(frozen=True)
class Potential:
    """The law of `Barrier` on the contacts of a step.

    The wall of a contact that starts deeper than `DEEPEST` widths is moved to where it stands,
    so that every start is feasible.

    Attributes
    ----------
    problem
        The step.
    width
        ``w`` (m).
    scale
        Stiffness of the barrier, force over width (N/m).
    """

    problem: StepProblem
    width: float
    scale: float

    @cached_property
    def spring(self) -> Bools:
        """(m,) contacts with a law of their own."""
        return np.asarray(self.problem.own_stiffness | (self.problem.limits.tension > 0))

    @cached_property
    def behind(self) -> Floats:
        """(m,) by how much walls were moved back (m)."""
        deep = np.maximum(-self.problem.gap - DEEPEST * self.width, 0.0)
        return np.asarray(deep * ~self.spring)

    @cached_property
    def offset(self) -> Floats:
        """(m,) distance of the wall behind touching (m)."""
        return np.asarray(self.width / 2 + self.behind)

    @property
    def shifted(self) -> StepProblem:
        """The step with gaps counted from where walls without width would stand."""
        return replace(self.problem, gap=self.problem.gap + self.behind)

    @cached_property
    def stretch(self) -> Floats:
        """(m,) stretch at which springs reach their tension limit (m)."""
        return np.asarray(self.problem.limits.tension / self.problem.normal_stiffness)

    @property
    def deep(self) -> int:
        """Number of contacts whose wall was moved."""
        return int((self.behind > 0).sum())

    def distance(self, gap: Floats) -> Floats:
        """(m,) distance to the wall over the width; infinite for springs."""
        return np.where(self.spring, np.inf, (gap + self.offset) / self.width)

    def normal(self, gap: Floats) -> tuple[Floats, Floats]:
        """Force and stiffness of every contact in its normal direction."""
        return self.normal_at(self.distance(gap), gap)

    def normal_at(self, distance: Floats, gap: Floats) -> tuple[Floats, Floats]:
        """The same at distances known better than gaps, which count for springs."""
        k = self.problem.normal_stiffness
        x = np.clip(distance, 1e-100, 1.0)
        log, rest = np.log(x), x - 1
        force = -self.scale * self.width * (2 * rest * log + rest**2 / x)
        curve = self.scale * (-2 * log - 4 * rest / x + (rest / x) ** 2)
        held = k * (gap <= self.stretch)
        pull = k * np.minimum(gap, self.stretch)
        return np.where(self.spring, pull, force), np.where(self.spring, held, curve)

    def stored(self, gap: Floats, slip: Floats) -> float:
        """Energy (J) whose slopes are the forces, of slips up to the bound of friction as it is.

        Springs are counted elsewhere.
        """
        x = np.clip(self.distance(gap), 1e-100, 1.0)
        pressed = -self.scale * self.width**2 * (x - 1) ** 2 * np.log(x)
        y = np.minimum(np.abs(slip) / (self.width / 2), 1.0)
        bound = np.where(self.spring, 0.0, self.bound(self.normal(gap)[0]))
        return float((pressed + bound * self.width / 2 * (y**2 - y**3 / 3)).sum())

    def shear(self, slip: Floats, bound: Floats) -> tuple[Floats, Floats, Floats]:
        """Force, stiffness and sense (force over bound) of every contact along its tangent."""
        k, half = self.problem.shear_stiffness, self.width / 2
        far, sign = np.abs(slip), np.sign(slip)
        y = np.minimum(far / half, 1.0)
        smooth = np.where(self.spring, 0.0, bound)  # springs have no ramp, nor a finite bound
        slope = smooth / half * (2 - 2 * y)
        slides = k * far >= bound
        force = np.where(slides, bound, k * far)
        return (
            sign * np.where(self.spring, force, smooth * y * (2 - y)),
            np.where(self.spring, np.where(slides, 0.0, k), slope),
            sign * np.where(self.spring, slides, y * (2 - y)),
        )

    def bound(self, normal: Floats) -> Floats:
        """Bound of the shear force that belongs to a normal force."""
        return shear_bound(normal, normal < 0, self.problem.limits)

    def pull(self, gap: Floats, slip: Floats) -> BarrierForces:
        """Forces for the bound of friction of their own normal force."""
        normal, stiff = self.normal(gap)
        return self.pulled(normal, stiff, slip, self.bound(normal), follows=True)

    def pulled(
        self, normal: Floats, stiff: Floats, slip: Floats, bound: Floats, follows: bool
    ) -> BarrierForces:
        """Forces for normal forces, their stiffness and a bound, which may follow them."""
        shear, stiff_t, sense = self.shear(slip, bound)
        mixed = -bound_slope(normal, self.problem.limits) * sense * stiff * follows
        return BarrierForces(normal, shear, stiff, stiff_t, mixed)

    def imbalance(self, increment: Floats, weight: Floats) -> float:
        """Relative out-of-balance force of unknowns (n,), infinite at or behind a wall.

        Friction is bounded by its own normal force; ``weight`` (n,) makes forces comparable.
        """
        problem = self.problem
        gap, slip = problem.gaps(increment), problem.slips(increment)
        if not (self.distance(gap) > 0).all():
            return np.inf
        pull = self.pull(gap, slip)
        return relative_residual(problem, weight, increment, pull.normal, pull.shear)
