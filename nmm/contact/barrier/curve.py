"""Where force and gap of a barrier lie for a given trial force: its law without its steepness.

Next to its wall the force of a barrier grows without bound with the gap, and the gap hardly
changes with the force: Newton's method in either alone creeps. In the *trial* ``force + c gap``
with a spring ``c`` both are smooth functions whose slopes lie between 0 and 1 and 1/c.
"""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.contact.barrier.potential import BarrierForces, Potential

TURNS = 40
"""Most steps of Newton's method for one number; five to eight are usual."""


@dataclass(frozen=True)
class LawPoints:
    """Points on the laws of all contacts.

    Attributes
    ----------
    gap, slip
        (m,) where the laws are met (m); those of the unknowns for contacts that are springs.
    pull
        Forces there and what they change with.
    """

    gap: Floats
    slip: Floats
    pull: BarrierForces


@dataclass(frozen=True)
class Curves:
    """The laws of a `Potential` as curves through gap and force.

    Attributes
    ----------
    well
        The laws.
    normal, shear
        (m,) springs ``c`` of the trials (N/m).
    """

    well: Potential
    normal: Floats
    shear: Floats

    def trials(
        self, gap: Floats, slip: Floats, normal: Floats, shear: Floats
    ) -> tuple[Floats, Floats]:
        """Trials (m,) of gaps and slips (m) with forces (N), gaps counted from the wall."""
        return normal + self.normal * (gap + self.well.offset), shear + self.shear * slip

    def at(
        self,
        trials: tuple[Floats, Floats],
        gap: Floats,
        slip: Floats,
        bound: Floats | None = None,
    ) -> LawPoints:
        """Point of every law with the given trials; springs take ``gap`` and ``slip`` (m,).

        The ``bound`` of friction (m,) is that of the normal force found unless given.
        """
        well, spring = self.well, self.well.spring
        x = self._distance(trials[0])
        normal, stiff = well.normal_at(np.where(spring, well.distance(gap), x), gap)
        limit = well.bound(normal) if bound is None else bound
        found = np.where(spring, slip, self._slip(trials[1], np.where(spring, 0.0, limit)))
        place = np.where(spring, gap, x * well.width - well.offset)
        pull = well.pulled(normal, stiff, found, limit, follows=bound is None)
        return LawPoints(place, found, pull)

    def _distance(self, trial: Floats) -> Floats:
        """(m,) distance ``x`` to the wall over the width, from ``c w x - f(x) = trial``."""
        well = self.well
        force, soft = well.scale * well.width, self.normal * well.width
        x = trial / soft
        near = (x < 1) & ~well.spring
        if not near.any():
            return x
        c, t = soft[near], -trial[near]
        # f(x) >= force (1 - x)^2 / x, whose quadratic equation starts left of the root; the
        # function is convex and falls, so Newton's method stays left of it
        b = 2 * force + t
        root = np.sqrt(np.maximum(b * b - 4 * (force - c) * force, 0.0))
        with np.errstate(divide="ignore", invalid="ignore"):
            y = np.where(b > 0, 2 * force / (b + root), (b - root) / (2 * (force - c)))
        y = np.clip(y, 1e-100, 1.0)
        for _ in range(TURNS):
            log, rest = np.log(y), y - 1
            value = force * (2 * rest * log + rest**2 / y) - c * y - t
            slope = force * (2 * log + 4 * rest / y - (rest / y) ** 2) - c
            change = -value / slope
            y = np.clip(y + change, 1e-100, 1.0)
            if (np.abs(change) <= 1e-14 * y).all():
                break
        x[near] = y
        return x

    def _slip(self, trial: Floats, bound: Floats) -> Floats:
        """(m,) slip from ``c s + bound y (2 - y) = trial`` with ``y = 2 s / w`` up to 1."""
        half, size = self.well.width / 2, np.abs(trial)
        ramp = 2 * bound + self.shear * half
        root = np.sqrt(np.maximum(ramp**2 - 4 * bound * size, 0.0))
        short = 2 * size / (ramp + root) * half
        slides = size >= bound + self.shear * half
        return np.sign(trial) * np.where(slides, (size - bound) / self.shear, short)
