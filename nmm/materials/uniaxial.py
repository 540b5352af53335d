"""Laws of one force and one way: springs, bars along their axis, bonds along a bar.

Elastic, and plastic beyond a yield value that is a line between points over the accumulated plastic
way, be it hardening or softening; the return to it is exact (Simo and Hughes 1998, section 1.4).
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from integration.arrays import Floats


@dataclass(frozen=True)
class UniaxialAnswer:
    """What a law answers at m points: force and tangent, and its two variables afterwards."""

    force: Floats
    tangent: Floats
    plastic: Floats
    flowed: Floats


@dataclass(frozen=True)
class Uniaxial:
    """A law; force and way are what its constants say: N and m, or Pa and strain.

    Attributes
    ----------
    stiffness
        Elastic, > 0; or 0 of what carries nothing.
    flowed, yields
        Accumulated plastic ways, from 0 on, and the yield values there, constant beyond; none of
        what stays elastic. The yield value falls less steeply than the stiffness.
    pulls, pushes
        Whether it carries tension, and compression.
    """

    stiffness: float
    flowed: tuple[float, ...] = ()
    yields: tuple[float, ...] = ()
    pulls: bool = True
    pushes: bool = True

    @property
    def elastic(self) -> bool:
        """Whether it has no yield value."""
        return not self.yields

    @property
    def linear(self) -> bool:
        """Whether the force is a line in the way."""
        return self.elastic and self.pulls and self.pushes

    def update(self, trial: Floats, plastic: Floats, flowed: Floats) -> UniaxialAnswer:
        """Return the answer to trial forces (m,), those of no more plastic way.

        ``plastic`` and ``flowed`` (m,) are the plastic way, and its lengths back and forth added.
        """
        carried = (self.pulls | (trial <= 0)) & (self.pushes | (trial >= 0))
        force = np.where(carried, trial, 0.0)
        tangent = np.where(carried, self.stiffness, 0.0)
        if self.elastic:
            return UniaxialAnswer(force, tangent, plastic, flowed)
        over = np.abs(force) > np.interp(flowed, *self._curve)
        reached = np.abs(force) + self.stiffness * flowed
        after = np.where(over, self._returned(reached), flowed)
        more = (after - flowed) * np.sign(force)
        slope = self._slope(after)
        softer = self.stiffness * slope / (self.stiffness + slope)
        return UniaxialAnswer(
            force - self.stiffness * more, np.where(over, softer, tangent), plastic + more, after
        )

    def limits(self, flowed: Floats) -> tuple[Floats, Floats]:
        """Return the least and the largest force (m,) from now on, ``flowed`` (m,) so far."""
        most = np.full_like(flowed, np.inf if self.stiffness else 0.0)
        if not self.elastic:
            ways, values = self._curve
            ahead = np.where(ways > flowed[:, None], values, 0.0).max(axis=1)
            most = np.maximum(np.interp(flowed, ways, values), ahead)
        none = np.zeros_like(most)
        return -most if self.pushes else none, most if self.pulls else none

    def slack(self, trial: Floats) -> Floats:
        """Return the way (m,) to what carries from trial forces (m,); 0 where it does."""
        idle = ((trial > 0) & (not self.pulls)) | ((trial < 0) & (not self.pushes))
        return np.asarray(np.abs(trial) / self.stiffness * idle if self.stiffness else 0.0 * trial)

    def energy(self, force: Floats) -> Floats:
        """Stored at forces (m,), in force times way."""
        return np.asarray(force**2 / (2 * self.stiffness) if self.stiffness else 0.0 * force)

    def taken(self, flowed: Floats) -> Floats:
        """Return what flow to accumulated ways (m,) takes for good, in force times way.

        The area under the yield values, which forces follow exactly as they flow.
        """
        if self.elastic:
            return np.zeros_like(flowed)
        ways, values = self._curve
        areas = np.append(0.0, np.cumsum(np.diff(ways) * (values[1:] + values[:-1]) / 2))
        at = np.searchsorted(ways, flowed, side="right") - 1
        mean = (values[at] + np.interp(flowed, ways, values)) / 2
        return np.asarray(areas[at] + mean * (flowed - ways[at]))

    @cached_property
    def _curve(self) -> tuple[Floats, Floats]:
        return np.array(self.flowed), np.array(self.yields)

    @cached_property
    def _reached(self) -> Floats:
        """Yield value and elastic stiffness times way at the points, which grows along them."""
        ways, values = self._curve
        return np.asarray(values + self.stiffness * ways)

    def _returned(self, reached: Floats) -> Floats:
        """Accumulated way where the yield value and the elastic unloading are ``reached`` (m,)."""
        beyond = np.maximum(reached - self._reached[-1], 0.0) / self.stiffness
        return np.asarray(np.interp(reached, self._reached, self._curve[0]) + beyond)

    def _slope(self, flowed: Floats) -> Floats:
        """Slope of the yield value (m,)."""
        ways, values = self._curve
        slopes = np.append(np.diff(values) / np.diff(ways), 0.0)
        return np.asarray(slopes[np.searchsorted(ways, flowed, side="right") - 1])
