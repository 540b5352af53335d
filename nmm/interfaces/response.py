"""An interface law at a fixed history: what one contact solution of a step takes from it."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from integration.arrays import Bools, Floats
from nmm.interfaces.limits import Limits


@dataclass(frozen=True)
class InterfaceResponse:
    """Springs and limits of contacts, each (m,).

    Attributes
    ----------
    limits
        Tensile strength and cohesion (Pa), and the tangent of the friction angle. An infinite
        tensile strength is that of a brittle bond, which breaks between two solutions.
    open_share
        Share of the normal stiffness that an open bond retains.
    rise
        Opening by dilation (m).
    """

    limits: Limits
    open_share: Floats
    rise: Floats

    def pull(self, gap: Floats, bonded: Bools, stiffness: Floats) -> tuple[Floats, Floats, Floats]:
        """Return the normal traction (m,) in Pa at a gap (m), its derivative, and the shear bound.

        ``bonded`` (m,) are the bonds that were there before; ``stiffness`` (m,) Pa/m.
        """
        limits, stretch = self.limits, gap - self.rise
        spring = stiffness * np.where(bonded & (stretch > 0), self.open_share, 1.0)
        is_open = spring * stretch > limits.tension
        pull = np.where(is_open, limits.tension, spring * stretch)
        bound = limits.cohesion + limits.friction * np.maximum(-pull, 0.0)
        lost = is_open & (limits.tension <= 0)
        return pull, np.where(is_open, 0.0, spring), np.where(lost, 0.0, bound)


@dataclass(frozen=True)
class Traction:
    """Response of a law to a gap and a slip.

    Attributes
    ----------
    traction
        (m, 2) pull and shear (Pa).
    history
        Internal variables afterwards.
    slopes
        Computes `tangent` when it is asked for: it costs several times as much as the traction.
    """

    traction: Floats
    history: dict[str, Floats]
    slopes: Callable[[], Floats]

    @cached_property
    def tangent(self) -> Floats:
        """Derivatives (m, 2, 2) of the traction by gap and slip (Pa/m)."""
        return self.slopes()
