"""The energy freed by crack growth between two equilibria, with the crack at its toughness.

In a linear material under loads of one factor L, growth by da frees L^2 g(a) da, where g(a) is the
release rate for L = 1. The work along the secant from one equilibrium to the next frees L1 L2 times
the integral of g. But between them the crack is at its toughness too: L^2 g is constant there, so
that the energy freed is the integral of g over the mean of 1 / L^2. The integral of g is the
increase of U / L^2, with the stored energy U.

Between equilibria log L is interpolated by a cubic in the length, through two of them on either
side.
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
        (n, 3): growth (m), load factor, and stored energy (J) of each equilibrium.
    jumped
        Load factor and stored energy (J) under which a crack nucleated; None where none did.
    """

    equilibria: Floats = field(default_factory=lambda: np.zeros((0, 3)))
    jumped: tuple[float, float] | None = None

    def on(self, length: float, factor: float, stored: float) -> "GrowthPath":
        """Return the path with one more equilibrium."""
        found = np.append(self.equilibria, [[length, factor, stored]], axis=0)
        return replace(self, equilibria=found)

    def begun_anew(self) -> "GrowthPath":
        """Return the path that starts anew as a crack nucleates under the last load."""
        if not len(self.equilibria):
            return self
        _, factor, stored = self.equilibria[-1].tolist()
        return GrowthPath(jumped=(factor, stored))

    def beyond_secant(self, end: float | None = None) -> float:
        """Energy (J) freed on the whole path in excess of the secants.

        Where growth ends at a length ``end`` (m), as at the end of a ligament, K follows a power of
        the ligament, and the cubics are in its logarithm. Intervals near which the load factor
        changes its sign count with their secant.
        """
        if len(self.equilibria) < 2:
            return self._beyond_jump
        beyond = self._freed(end) - self._secants
        return float(beyond[self._one_sign].sum()) + self._beyond_jump

    def to_the_end(self, end: float, short: float | None = 0.0) -> float:
        """Energy (J) freed from the last equilibrium until no tip is left, at the length ``end``.

        L^2 g is constant there too: each length frees as much as in the interval before. Where
        bodies part, equilibria with a ligament below ``short`` (m) do not count, and the path
        before is corrected for the known ``end``; zero where the factor falls more slowly than the
        square root of the ligament. With None the crack ends on a hole or on a bonded body.
        """
        length, factor, _ = self.equilibria.T
        left = end - length
        if len(left) < 2:
            return 0.0
        if short is None:
            return float(self._freed(None)[-1] * left[-1] / (length[-1] - length[-2]))
        if not 0 < factor[-1] / factor[-2] < np.sqrt(left[-1] / left[-2]):
            return 0.0
        known = replace(self, equilibria=self.equilibria[: max(2, int((left >= short).sum()))])
        last = known.equilibria[-2:, 0]
        rest = known._freed(end)[-1] * (end - last[1]) / (last[1] - last[0])
        found = known._secants.sum() + known.beyond_secant(end) + rest
        return float(found - self._secants.sum() - self.beyond_secant())

    def _freed(self, end: float | None) -> Floats:
        """Energy (n - 1,) freed in each interval at the toughness (J)."""
        length, factor, stored = self.equilibria.T
        nearly = np.exp(-2 * self._between(_place(length, end), np.log(np.abs(factor)), end))
        return np.asarray(np.diff(stored / factor**2) / (nearly @ WEIGHTS / 2))

    @property
    def _secants(self) -> Floats:
        """Energy (n - 1,) freed in each interval along the secant (J)."""
        _, factor, stored = self.equilibria.T
        return np.asarray(np.diff(stored / factor**2) * factor[1:] * factor[:-1])

    @property
    def _beyond_jump(self) -> float:
        """Energy (J) in excess of the secant of a crack that nucleates under the last load."""
        if (
            self.jumped is None
            or not len(self.equilibria)
            or self.jumped[0] * self.equilibria[0, 1] <= 0
        ):
            return 0.0
        (before, had), (_, factor, stored) = self.jumped, self.equilibria[0].tolist()
        return float((stored / factor**2 - had / before**2) * before * (before - factor))

    @cached_property
    def _window(self) -> Ints:
        """Equilibria (n - 1, m) through which the polynomial of each interval goes."""
        n = len(self.equilibria)
        m = min(n, NODES)
        first = np.clip(np.arange(n - 1) - 1, 0, n - m)
        return np.asarray(first[:, None] + np.arange(m))

    @cached_property
    def _one_sign(self) -> Bools:
        sign = np.sign(self.equilibria[self._window, 1])
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
