"""How relaxation goes on: the length of its next step, and when speed is kept from step to step.

Steps from rest are long and damp all they can. Where friction has no answer for long ones they are
cut, and a block that falls slowly would take thousands of short steps from rest. Speed is kept
from then on, as long as kinetic energy grows (kinetic damping: Cundall 1976, Barnes 1999).
"""

from dataclasses import dataclass, field

import numpy as np

from integration.arrays import Floats
from nmm.assembly.model import Model

# A step is lengthened and cut by these; so many cuts before one as long as those that failed is
# taken, or a step of this share of the first, end the search: short ones get nowhere.
LONGER, SHORTER, CUTS, SHORTEST = 1.5, 0.3, 12, 1e-2
# After so many cuts speed is kept, and steps stay shorter than this share of what failed last.
UNEVEN, WARY = 2, 0.5


@dataclass
class Pace:
    """Lengths of steps (s), cut where one fails and lengthened where all goes slowly.

    Attributes
    ----------
    first, length, longest
        Of the first step, the next one, and of any from here on.
    failed, cuts
        The longest that failed, and how many did, since one as long was taken.
    energy
        Kinetic energy, twice, after the last step (J); zero where no speed is kept.
    """

    first: float
    length: float = field(init=False)
    longest: float = field(init=False, default=np.inf)
    failed: float = field(init=False, default=0.0)
    cuts: int = field(init=False, default=0)
    energy: float = field(init=False, default=0.0)
    _asked: int = field(init=False, default=0)
    _next: int = field(init=False, default=0)

    def __post_init__(self) -> None:
        self.length = self.first

    @property
    def keeps_speed(self) -> bool:
        """Whether bodies go on with their speed."""
        return self.cuts >= UNEVEN

    @property
    def ends(self) -> bool:
        """Whether steps were cut so short that nothing is found by shorter ones."""
        return self.cuts > CUTS or (self.keeps_speed and self.length < SHORTEST * self.first)

    def cut(self) -> None:
        """Cut the next step, as this one failed."""
        self.cuts, self.failed = self.cuts + 1, max(self.failed, self.length)
        if self.keeps_speed:
            self.longest = WARY * self.length
        self.length *= SHORTER

    def lengthen(self) -> None:
        """Lengthen the next step as far as is known to be wise."""
        self.length = min(LONGER * self.length, max(self.longest, self.length))

    def speed(self, model: Model, velocity: Floats) -> Floats:
        """Return the velocity to go on with: none, or that of the step until energy falls."""
        if self.length >= self.failed:
            self.cuts, self.failed = 0, 0.0
        energy = float(velocity @ (model.mass @ velocity)) if self.keeps_speed else 0.0
        falls, self.energy = energy <= self.energy, energy
        if falls:
            self.energy = 0.0
        return np.zeros_like(velocity) if falls else velocity

    def may_ask(self, steps: int) -> bool:
        """Whether it is time to ask for rest: after twice as many steps each time it was not."""
        if steps < self._next:
            return False
        self._asked += 1
        self._next = steps + 2 ** (self._asked - 1)
        return True
