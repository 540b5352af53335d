"""One-dimensional wave propagation in a column of layered ground, for the free field.

Linear elements and the trapezoidal rule, with a step of its own from the start of the run, so that
the motion is a function of time alone, and checkpoints need not store it.
"""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from scipy.linalg import cho_solve_banded, cholesky_banded

from integration.arrays import Floats

Drive = Callable[[float], float]


def still(time: float) -> float:
    """Return zero: the motion of fixed ground."""
    return 0.0


@dataclass
class GroundColumn:
    """Motion of one displacement component in a column.

    Parameters
    ----------
    height
        (k + 1,) nodes from the base upwards (m).
    modulus, density
        (k,) modulus (Pa) and density (kg/m3) of the elements.
    damping
        Rayleigh coefficients of mass (1/s) and stiffness (s).
    step
        Step of the integration (s).
    base
        Impedance of the ground below (Pa s/m) and the velocity of the incoming wave (m/s); or None
        and the displacement of the base (m).
    against
        Velocity of the ground relative to which the mass term damps (m/s).
    """

    height: Floats
    modulus: Floats
    density: Floats
    damping: tuple[float, float]
    step: float
    base: tuple[float | None, Drive]
    against: Drive = still
    _displacement: list[Floats] = field(default_factory=list)
    _velocity: list[Floats] = field(default_factory=list)

    def __post_init__(self) -> None:
        length = np.diff(self.height)
        spring, mass = self.modulus / length, self.density * length / 6
        self._stiffness = _tridiagonal(spring, -spring)
        self._mass = _tridiagonal(2 * mass, mass)
        self._dampers = self.damping[0] * self._mass + self.damping[1] * self._stiffness
        impedance, _ = self.base
        if impedance is not None:
            self._dampers[1, 0] += impedance
        system = 2 / self.step**2 * self._mass + self._dampers / self.step + self._stiffness / 2
        # A prescribed base is no unknown.
        self._free = 0 if impedance is not None else 1
        self._coupling = system[0, 1] if self._free else 0.0
        self._factor = cholesky_banded(np.delete(system, range(self._free), axis=1))
        rest = np.zeros(len(self.height))
        self._displacement, self._velocity = [rest], [rest]

    def velocity(self, time: float) -> Floats:
        """Return the velocity (k + 1,) of the nodes (m/s)."""
        return self._at(time, self._velocity)

    def stress(self, time: float) -> Floats:
        """Return the stress (k,) of the elements, with that of damping (Pa)."""
        moved = self._at(time, self._displacement)
        moved = moved + self.damping[1] * self._at(time, self._velocity)
        return np.asarray(self.modulus * np.diff(moved) / np.diff(self.height))

    def _at(self, time: float, known: list[Floats]) -> Floats:
        place = max(time, 0.0) / self.step
        number = int(np.floor(place + 1e-9))
        while len(known) < number + 2:
            self._advance()
        share = place - number
        return np.asarray((1 - share) * known[number] + share * known[number + 1])

    def _advance(self) -> None:
        """Take one step."""
        u, v = self._displacement[-1], self._velocity[-1]
        time, (impedance, drive) = (len(self._displacement) - 1) * self.step, self.base
        ends = drive(time), drive(time + self.step)
        push = 2 / self.step * _times(self._mass, v) - _times(self._stiffness, u)
        dragged = sum(self.against(at) for at in (time, time + self.step)) / 2
        push += self.damping[0] * _times(self._mass, np.full(len(u), dragged))
        way = np.zeros(len(u))
        if impedance is not None:
            push[0] += impedance * sum(ends)  # twice the mean velocity
        else:
            way[0] = ends[1] - ends[0]
            push[1] -= self._coupling * way[0]
        way[self._free :] = cho_solve_banded((self._factor, False), push[self._free :])
        self._displacement.append(u + way)
        self._velocity.append(2 / self.step * way - v)


def _tridiagonal(ends: Floats, between: Floats) -> Floats:
    """Sum of element matrices ``[[e, b], [b, e]]`` in the upper banded form (2, k + 1)."""
    found = np.zeros((2, len(ends) + 1))
    found[1, :-1] += ends
    found[1, 1:] += ends
    found[0, 1:] = between
    return found


def _times(banded: Floats, vector: Floats) -> Floats:
    found = banded[1] * vector
    found[:-1] += banded[0, 1:] * vector[1:]
    found[1:] += banded[0, 1:] * vector[:-1]
    return np.asarray(found)
