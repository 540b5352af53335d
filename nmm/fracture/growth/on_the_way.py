"""The energy that cracks free between one balance and the next, at their toughness all along.

With linear matter under loads of one factor L the energy freed by growth da is L^2 g(a) da, where
g is what a unit of the factor frees. Work along a chord, from one factor to the next, frees L1 L2
times the integral of g. But the crack was at its toughness between them too: there
L^2 g is constant, 1 / L goes with the intensity of a unit of the factor, and what is freed is the
integral of g over the mean of 1 / L^2. The integral of g is the gain of U / L^2, U being stored.

The logarithm of L is a cubic through four lengths, two on either side where there are as many.
"""

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from integration.arrays import Bools, Floats, Ints

# Gauss points on (-1, 1) between two lengths: ten have a ligament that falls to a fifth to 1e-9.
POINTS, WEIGHTS = np.polynomial.legendre.leggauss(10)
# Lengths through which a polynomial goes.
NODES = 4


@dataclass(frozen=True)
class GrowthPath:
    """Where cracks were at their toughness.

    Attributes
    ----------
    stations
        (n, 3): how far they had grown (m), the load factor, and the energy stored (J).
    jumped
        Load factor and energy stored under which a crack began at once; None without.
    """

    stations: Floats = field(default_factory=lambda: np.zeros((0, 3)))
    jumped: tuple[float, float] | None = None

    def on(self, length: float, factor: float, stored: float) -> "GrowthPath":
        """Return the path with one more station."""
        return replace(self, stations=np.append(self.stations, [[length, factor, stored]], axis=0))

    def begun_anew(self) -> "GrowthPath":
        """Return the path of cracks of which another begins under the last load."""
        if not len(self.stations):
            return self
        _, factor, stored = self.stations[-1].tolist()
        return GrowthPath(jumped=(factor, stored))

    def beyond_chord(self, end: float | None = None) -> float:
        """Energy (J) that was freed on the whole way beyond what chords say.

        Towards the ``end`` (m) of a ligament, intensities go with a power of what is left of it:
        there the logarithm of that is what the cubics run over. Pieces about which the factor
        changes its sign count as their chords.
        """
        if len(self.stations) < 2:
            return self._beyond_jump
        beyond = self._freed(end) - self._chords
        return float(beyond[self._one_sign].sum()) + self._beyond_jump

    def to_the_end(self, end: float, short: float = 0.0) -> float:
        """Energy (J) freed from the last station until bodies part at the length ``end``.

        L^2 g is constant there too: each length frees what it did in the piece before. Stations
        with less than ``short`` (m) left do not count. What is known now of the end corrects the
        way before it. Nothing is said where the factor does not fall with the root of what is left
        at least.
        """
        length, factor, _ = self.stations.T
        left = end - length
        if len(left) < 2:
            return 0.0
        if not 0 < factor[-1] / factor[-2] < np.sqrt(left[-1] / left[-2]):
            return 0.0
        known = replace(self, stations=self.stations[: max(2, int((left >= short).sum()))])
        last = known.stations[-2:, 0]
        rest = known._freed(end)[-1] * (end - last[1]) / (last[1] - last[0])
        found = known._chords.sum() + known.beyond_chord(end) + rest
        return float(found - self._chords.sum() - self.beyond_chord())

    def _freed(self, end: float | None) -> Floats:
        """Energy (n - 1,) that pieces freed at the toughness (J)."""
        length, factor, stored = self.stations.T
        nearly = np.exp(-2 * self._between(_place(length, end), np.log(np.abs(factor)), end))
        return np.asarray(np.diff(stored / factor**2) / (nearly @ WEIGHTS / 2))

    @property
    def _chords(self) -> Floats:
        """Energy (n - 1,) that pieces freed along chords (J)."""
        _, factor, stored = self.stations.T
        return np.asarray(np.diff(stored / factor**2) * factor[1:] * factor[:-1])

    @property
    def _beyond_jump(self) -> float:
        """Energy (J) that a crack frees beyond the chord if it begins under the load before."""
        if (
            self.jumped is None
            or not len(self.stations)
            or self.jumped[0] * self.stations[0, 1] <= 0
        ):
            return 0.0
        (before, held), (_, factor, stored) = self.jumped, self.stations[0].tolist()
        return float((stored / factor**2 - held / before**2) * before * (before - factor))

    @cached_property
    def _window(self) -> Ints:
        """Stations (n - 1, m) through which the polynomial of each piece goes."""
        n = len(self.stations)
        m = min(n, NODES)
        first = np.clip(np.arange(n - 1) - 1, 0, n - m)
        return np.asarray(first[:, None] + np.arange(m))

    @cached_property
    def _one_sign(self) -> Bools:
        sign = np.sign(self.stations[self._window, 1])
        return np.asarray((sign == sign[:, :1]).all(axis=1))

    def _between(self, x: Floats, y: Floats, end: float | None) -> Floats:
        """Values (n - 1, g) at the Gauss points of each piece (Lagrange's form)."""
        length = self.stations[:, 0]
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
    """What the cubics run over."""
    return length if end is None else np.log(end - length)
