"""Softening curves of bonds: strength over opening, and the energy under them."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats


@dataclass(frozen=True)
class SofteningCurve:
    """Piecewise linear share of the strength that is left over the width of the crack.

    Attributes
    ----------
    widths, share
        (k,) where the chords meet: m, from 0, and shares from 1 to 0.
    strength
        Pa.
    """

    widths: Floats
    share: Floats
    strength: float

    def left(self, damage: Floats) -> Floats:
        """Return the share (m,) of the strength that is left."""
        return np.asarray(np.interp(damage * self.widths[-1], self.widths, self.share))

    def damage(self, left: Floats) -> Floats:
        """Return the damage (m,) at a share of the strength."""
        return np.asarray(np.interp(-left, -self.share, self.widths) / self.widths[-1])

    def area(self, damage: Floats) -> Floats:
        """Return the area (m,) under the curve up to a damage (m)."""
        width = damage * self.widths[-1]
        chords = (self.share[1:] + self.share[:-1]) / 2 * np.diff(self.widths)
        at = np.clip(np.searchsorted(self.widths, width, "right") - 1, 0, len(chords) - 1)
        within = (self.share[at] + self.left(damage)) / 2 * (width - self.widths[at])
        return np.asarray(np.append(0.0, np.cumsum(chords))[at] + within)

    def mean(self, one: Floats, two: Floats) -> Floats:
        """Return the mean share (m,) between two damages."""
        width = self.widths[-1] * (two - one)
        grown = width > 0
        chord = (self.area(two) - self.area(one)) / np.where(grown, width, 1.0)
        least, most = self.left(two), self.left(one)
        return np.clip(np.where(grown, chord, least), least, most)

    def by_opening(
        self,
        damage: tuple[Floats, Floats],
        reached: Floats,
        opening: Floats,
        stiffness: Floats,
    ) -> Floats:
        """Return the energy (m,) that open bonds lose as their damage grows (J/m2).

        Under damage ``d`` they go back to the origin on a secant ``k(d)``, so that it takes
        ``-g^2 dk / 2`` at the opening ``g``. Where the opening is what damages, this is

            int_0^w s dw - s w / 2,        s(w) the strength left at the width w of the crack,

        whatever the spring, and the fracture energy in the end.

        Parameters
        ----------
        damage
            (m,) at both ends.
        reached
            (m,) up to which the opening has damaged; sliding did the rest.
        opening
            (m,) at the end (m).
        stiffness
            (m,) of the whole bonds (Pa/m).
        """
        before, after = damage
        slid = (self._secant(reached, stiffness) - self._secant(after, stiffness)) / 2
        opened = self._taken(reached) - self._taken(before)
        return np.asarray(opened + slid * np.maximum(opening, 0.0) ** 2)

    def _taken(self, damage: Floats) -> Floats:
        width = damage * self.widths[-1]
        return np.asarray(self.strength * (self.area(damage) - self.left(damage) * width / 2))

    def _secant(self, damage: Floats, stiffness: Floats) -> Floats:
        pull = self.left(damage) * self.strength
        return np.asarray(pull / (pull / stiffness + damage * self.widths[-1]))
