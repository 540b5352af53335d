"""What dampers do in a step in time: their force, their share of its matrix, and what they took.

The velocity at the weighed instant of the step is a line in the increment, ``rate d + start``,
whatever the integrator, so that dampers are linear in it as all else is.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Self

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.integrators.base import Integrator


@dataclass(frozen=True)
class Damping:
    """Dampers of a step.

    Attributes
    ----------
    dampers
        Matrices (n, n) against the velocity, by effect.
    masses
        Matrices (n, n) that join the mass in this step alone, by effect.
    rate, start
        The velocity at the weighed instant is ``rate d + start`` (n,).
    """

    dampers: Mapping[str, csc_array]
    masses: Mapping[str, csc_array]
    rate: float
    start: Floats

    @classmethod
    def of(
        cls,
        dampers: Mapping[str, csc_array],
        masses: Mapping[str, csc_array],
        rule: Integrator,
        velocity: Floats,
        acceleration: Floats,
        step: float,
    ) -> Self | None:
        """Return the dampers and masses of a step that starts with such rates; None without any."""
        if not dampers and not masses:
            return None
        one, none, weight = np.ones(1), np.zeros(1), rule.end_weight
        rate = float(rule.rates(one, none, none, step)[0][0])
        last, _ = rule.rates(np.zeros_like(velocity), velocity, acceleration, step)
        return cls(dampers, masses, weight * rate, weight * last + (1 - weight) * velocity)

    def force(self) -> Floats:
        """Force (n,) of the dampers at no increment."""
        return -sum((one @ self.start for one in self.dampers.values()), np.zeros_like(self.start))

    def taken(
        self, increment: Floats, mass_factor: float, momentum: Floats
    ) -> tuple[dict[str, float], float, float]:
        """Return the work (J) by effect, and the products of the increment with the matrices.

        ``momentum`` (n,) is what the mass is multiplied by to join the forces. The products are
        those of dampers and of added masses, as the matrix of the step has them.
        """
        velocity = self.rate * increment + self.start
        way = mass_factor * increment
        work = {name: float(increment @ (one @ velocity)) for name, one in self.dampers.items()}
        for name, one in self.masses.items():
            gained = float(increment @ (one @ (way - momentum)))
            work[name] = work.get(name, 0.0) + gained
        damped = sum(float(increment @ (one @ increment)) for one in self.dampers.values())
        heavy = sum(float(increment @ (one @ way)) for one in self.masses.values())
        return work, self.rate * damped, heavy
