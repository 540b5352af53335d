"""The sides of Coulomb's law at a contact, as the interior point sees them.

The normal force lacks ``p`` to the tension limit, the shear force ``a`` and ``b`` to its two
bounds (the *slack*); where one is used up the contact opens by ``w``, slides by ``u`` or back by
``v`` (the *flow*).
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from integration.arrays import Bools, Floats
from nmm.contact.iteration.interior.centrality import PointColumns, longest, mean_product
from nmm.contact.iteration.interior.elimination import SideColumns
from nmm.contact.problem.coulomb import frictionless, shear_bound
from nmm.contact.problem.cut_springs import CutSprings, IterationResult


@dataclass(frozen=True)
class InteriorIterate:
    """Unknowns of the method, or a step of them.

    Attributes
    ----------
    increment
        (n,) unknowns of the step.
    normal, shear
        (m,) forces (N).
    slack, flow
        (3, m) ``p, a, b`` (N) and ``w, u, v`` (m).
    """

    increment: Floats
    normal: Floats
    shear: Floats
    slack: Floats
    flow: Floats

    def moved(self, step: "InteriorIterate", length: float) -> "InteriorIterate":
        """Point at ``length`` along ``step``."""
        pairs = zip(self.columns, step.columns, strict=True)
        return InteriorIterate(*(own + length * way for own, way in pairs))

    @property
    def columns(self) -> PointColumns:
        """The same as compiled code takes it."""
        return self.increment, self.normal, self.shear, self.slack, self.flow


@dataclass(frozen=True)
class Complementarity:
    """Which sides contacts have, and how much they give way before.

    Attributes
    ----------
    springs
        The law. Contacts marked ``exact`` obey ``gap >= 0`` and a sharp bound instead of their
        spring, which then is far softer than the blocks and carries what forces are found.
    exact
        (m,) contacts without compliance.
    compliance
        (2, m) normal and tangential compliance ``c`` (m/N) of what each exact contact joins, and
        of the other springs: by it forces and lengths compare.
    """

    springs: CutSprings
    exact: Bools
    compliance: Floats

    @cached_property
    def active(self) -> Bools:
        """(3, m) sides that exist.

        What has no tension limit cannot open, what has no bound or no shear force does not slide.
        """
        limits = self.springs.problem.limits
        bounded = np.isfinite(limits.cohesion) & ~self.smooth
        return np.stack([np.isfinite(limits.tension), bounded, bounded])

    @cached_property
    def smooth(self) -> Bools:
        """(m,) contacts that carry no shear force."""
        return frictionless(self.springs.problem.limits)

    @cached_property
    def give(self) -> Floats:
        """(2, m) compliance (m/N) of springs; 0 of exact contacts."""
        return np.where(self.exact, 0.0, self.compliance)

    def columns(self, soft: float) -> SideColumns:
        """The same as compiled code takes it; exact contacts give way as springs a bit ``soft``."""
        give = np.where(self.exact, soft * self.compliance, self.give)
        return SideColumns(self.active, self.smooth, self.give, give, self.compliance)

    def mean(
        self, point: InteriorIterate, step: InteriorIterate | None = None, length: float = 0.0
    ) -> float:
        """Mean product of slack and flow (J) at a point, or a ``length`` along a step from it."""
        way = (step or point).columns
        return float(mean_product(self.active, point.columns, way, float(length)))

    def length(self, point: InteriorIterate, step: InteriorIterate) -> float:
        """Largest part of a step, up to 1, that leaves slack and flow positive."""
        return float(longest(self.active, point.columns, step.columns))

    def bound(self, normal: Floats, slack: Floats, flow: Floats) -> Floats:
        """Bound of the shear force; the cohesion of an unbonded contact counts while it closes.

        ``slack`` and ``flow`` are those of the normal force.
        """
        limits = self.springs.problem.limits
        closes = slack * self.compliance[0] > flow
        return np.where(self.active[1], shear_bound(normal, closes, limits), 0.0)

    def start(self, increment: Floats, trial: Floats, within: float) -> InteriorIterate:
        """Point well inside all sides.

        Parameters
        ----------
        increment
            (n,) unknowns as if every contact were a spring about as stiff as what it joins.
        trial
            (2, m) forces of these springs (N). Their root mean square tells how large forces
            are; all slack and flow is at least of that order.
        within
            Part (-) of its bound that a shear force may take up.
        """
        springs, scale, limits = self.springs, self.compliance, self.springs.problem.limits
        normal, shear = trial
        parted = springs.problem.gap / scale[0]  # in place of forces where there are none yet
        sizes = (float(np.sqrt(np.mean(one**2))) for one in (normal, shear, parted) if len(one))
        typical = next((size for size in sizes if size > 0), 1.0)
        pull = np.where(self.active[0], limits.tension, 0.0)
        p = np.maximum(pull - normal, typical)
        stretch = (normal - springs.shift[0]) * self.give[0]
        w = np.maximum(springs.problem.gaps(increment) - stretch, typical**2 * scale[0] / p)
        normal = np.where(self.active[0], pull - p, normal)
        bound = self.bound(normal, p, w)
        shear = np.where(self.active[1], np.clip(shear, -within * bound, within * bound), shear)
        shear = np.where(self.smooth, 0.0, shear)
        stretch = (shear - springs.shift[1]) * self.give[1]
        slip = springs.problem.slips(increment) - stretch
        a, b = (np.maximum(bound - side * shear, 1e-3 * typical) for side in (1, -1))
        u = np.maximum(slip, 0) + typical**2 * scale[1] / a
        v = np.maximum(-slip, 0) + typical**2 * scale[1] / b
        return InteriorIterate(increment, normal, shear, np.stack([p, a, b]), np.stack([w, u, v]))

    def judged(self, point: InteriorIterate) -> IterationResult:
        """The admissible forces of a point as springs that carry them, and what they lack."""
        springs, increment = self.springs, point.increment
        if not self.exact.any():
            return IterationResult(springs, increment, springs.residual(increment).size, 0, 0, "")
        forces = np.stack(springs.cut(point.normal, point.shear))
        moved = springs.problem.jumps(increment)
        meant = np.stack(springs.cut(*(forces + moved / self.compliance)))
        largest = float(np.abs(forces).max(initial=0.0))
        lacks = float(np.abs(np.where(self.exact, meant - forces, 0.0)).max(initial=0.0))
        carried = springs.shifted(np.where(self.exact, forces, springs.shift))
        error = lacks / largest if largest > 0 else 0.0
        return IterationResult(
            carried, increment, carried.residual(increment).size, 0, 0, "", error
        )
