"""The energy freed by crack growth between two equilibria, with the crack at its toughness.

In a linear material intensities are affine in the load factor L. With D = L + R, R being what stays
without the factor as one (dead loads; zero without any), growth by da frees D^2 g(a) da. The work
along the chord from one equilibrium to the next, which is booked, frees the integral of
(R + L1) (R + L2) g. But between them the crack is at its toughness too: D^2 g is constant there, so
that the energy freed is what the chord frees over the mean of (R + L1) (R + L2) / D^2.

Between equilibria log D and R are interpolated by cubics in the length, through two of them on
either side.
"""

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from integration.arrays import Bools, Floats, Ints

# Gauss rule between two equilibria: with ten points a ligament may shrink to a fifth at 1e-9.
POINTS, WEIGHTS = np.polynomial.legendre.leggauss(10)
# Equilibria through which a polynomial goes.
NODES = 4


@dataclass(frozen=True)
class GrowthPath:
    """The equilibria at which cracks were at their toughness.

    Attributes
    ----------
    equilibria
        (n, 5): growth (m), load factor, what stands in for dead loads, as a load factor, stored
        energy (J), and energy (J) freed so far along chords, of each equilibrium.
    jumped
        Load factor under which a crack nucleated, and what chords had freed (J); None where none
        did.
    """

    equilibria: Floats = field(default_factory=lambda: np.zeros((0, 5)))
    jumped: tuple[float, float] | None = None

    def on(
        self, length: float, factor: float, stored: float, freed: float, dead: float = 0.0
    ) -> "GrowthPath":
        """Return the path with one more equilibrium, up to which ``freed`` (J) is booked in all."""
        chords = freed - self.beyond_chords()
        found = np.append(self.equilibria, [[length, factor, dead, stored, chords]], axis=0)
        return replace(self, equilibria=found)

    def begun_anew(self) -> "GrowthPath":
        """Return the path that starts anew as a crack nucleates under the last load."""
        if not len(self.equilibria):
            return self
        _, factor, _, _, chords = self.equilibria[-1].tolist()
        return GrowthPath(jumped=(factor, chords + self.beyond_chords()))

    def beyond_chords(self, end: float | None = None) -> float:
        """Energy (J) freed on the whole path in excess of the chords.

        Where growth ends at a length ``end`` (m), as at the end of a ligament, K follows a power of
        the ligament, and the cubics are in its logarithm. Intervals near which the load factor
        changes its sign count with their chord.
        """
        if len(self.equilibria) < 2:
            return self._beyond_jump
        beyond = self._freed(end) - self._chords
        return float(beyond[self._one_sign].sum()) + self._beyond_jump

    def to_the_end(self, end: float, short: float | None = 0.0) -> float:
        """Energy (J) freed from the last equilibrium until no tip is left, at the length ``end``.

        D^2 g is constant there too: each length frees as much as in the interval before. Where
        bodies part, equilibria with a ligament below ``short`` (m) do not count, and the path
        before is corrected for the known ``end``; zero where the factor falls more slowly than the
        square root of the ligament. With None the crack ends on a hole or on a bonded body.
        """
        length, acting = self.equilibria[:, 0], self._acting
        left = end - length
        if len(left) < 2:
            return 0.0
        if short is None:
            return float(self._freed(None)[-1] * left[-1] / (length[-1] - length[-2]))
        if not 0 < acting[-1] / acting[-2] < np.sqrt(left[-1] / left[-2]):
            return 0.0
        known = replace(self, equilibria=self.equilibria[: max(2, int((left >= short).sum()))])
        last = known.equilibria[-2:, 0]
        rest = known._freed(end)[-1] * (end - last[1]) / (last[1] - last[0])
        found = known._chords.sum() + known.beyond_chords(end) + rest
        return float(found - self._chords.sum() - self.beyond_chords())

    def _freed(self, end: float | None) -> Floats:
        """Energy (n - 1,) freed in each interval at the toughness (J)."""
        length, factor, dead = self.equilibria[:, :3].T
        log = self._between(_place(length, end), np.log(np.abs(self._acting)), end)
        stays = self._between(_place(length, end), dead, end)
        chord = (stays + factor[:-1, None]) * (stays + factor[1:, None])
        return np.asarray(self._chords / ((chord * np.exp(-2 * log)) @ WEIGHTS / 2))

    @property
    def _acting(self) -> Floats:
        """Load factor (n,) that would act alone as all that acts does."""
        return np.asarray(self.equilibria[:, 1] + self.equilibria[:, 2])

    @property
    def _chords(self) -> Floats:
        """Energy (n - 1,) freed in each interval along the chord (J)."""
        return np.diff(self.equilibria[:, 4])

    @property
    def _beyond_jump(self) -> float:
        """Energy (J) in excess of the chord of a crack that nucleates under the last load."""
        if self.jumped is None or not len(self.equilibria):
            return 0.0
        (before, had), (_, factor, dead, _, chords) = self.jumped, self.equilibria[0].tolist()
        if (before + dead) * (factor + dead) <= 0:
            return 0.0
        return float((chords - had) * (before - factor) / (factor + dead))

    @cached_property
    def _window(self) -> Ints:
        """Equilibria (n - 1, m) through which the polynomial of each interval goes."""
        n = len(self.equilibria)
        m = min(n, NODES)
        first = np.clip(np.arange(n - 1) - 1, 0, n - m)
        return np.asarray(first[:, None] + np.arange(m))

    @cached_property
    def _one_sign(self) -> Bools:
        sign = np.sign(self._acting[self._window])
        return np.asarray((sign == sign[:, :1]).all(axis=1))

    def _between(self, x: Floats, y: Floats, end: float | None) -> Floats:
        """Values (n - 1, g) at the Gauss points of each interval by Lagrange interpolation."""
        length = self.equilibria[:, 0]
        where = _place(length[:-1, None] + (1 + POINTS) / 2 * np.diff(length)[:, None], end)
        nodes = x[self._window]
        m = nodes.shape[1]
        found = np.zeros_like(where)
        for one in range(m):  # four at most
            others = np.delete(nodes, one, axis=1)
            share = (where[..., None] - others[:, None]) / (
                nodes[:, None, one, None] - others[:, None]
            )
            found += y[self._window][:, one, None] * share.prod(axis=2)
        return found


def _place(length: Floats, end: float | None) -> Floats:
    """The variable of the cubics: the length, or the logarithm of what is left to ``end``."""
    return length if end is None else np.log(end - length)
