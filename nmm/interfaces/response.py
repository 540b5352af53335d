"""An interface law while its history stands: what one solution of a step is posed with."""

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
        Largest pull and cohesion (Pa), and the tangent of the friction angle. A pull without limit
        is that of a bond which breaks at once, between two solutions.
    open_share
        Of the normal stiffness that is left to a bond while it is open.
    rise
        By how much sliding has lifted the faces (m).
    """

    limits: Limits
    open_share: Floats
    rise: Floats

    def pull(self, gap: Floats, bonded: Bools, stiffness: Floats) -> tuple[Floats, Floats, Floats]:
        """Return the pull (m,) in Pa at a gap (m), its derivative (Pa/m), and the shear's bound.

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
    """Answer of a law to a gap and a slip.

    Attributes
    ----------
    traction
        (m, 2) pull and shear (Pa).
    history
        What the law remembers afterwards.
    slopes
        Gives `tangent`, which costs several times what a traction does, where it is asked for.
    """

    traction: Floats
    history: dict[str, Floats]
    slopes: Callable[[], Floats]

    @cached_property
    def tangent(self) -> Floats:
        """Derivatives (m, 2, 2) of the traction by gap and slip (Pa/m)."""
        return self.slopes()
