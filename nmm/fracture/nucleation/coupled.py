"""The coupled criterion: a crack begins where stress and energy both suffice (Leguillon 2002).

Along a line of length ``l`` the mean stress must be the strength, and a crack of that length must
free what its faces take (finite fracture mechanics: Cornetti, Pugno, Carpinteri and Taylor 2006).
Both are asked of a ladder of lengths. Where the mean falls and the energy rises with the length,
they meet at one, which the crack then has.

What a crack frees follows from the stress where it is not yet: ``K`` of every shorter one by its
weight function, from the edge of a half plane (Tada, Paris and Irwin 2000) or in a whole plane. At
notches that is the one of a longer crack which goes on: K is 1, 3 and 8 % less by it than at
notches of 60, 90 and 120 degrees (Carpinteri, Cornetti, Pugno and Sapora 2010).
"""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Bools, Floats
from nmm.fracture.acting_stress import StressOn
from nmm.fracture.nucleation.line_stress import LineStress
from nmm.fracture.nucleation.reached import LineReach, OpeningLines
from nmm.fracture.principal import LargestPrincipal

# Lengths over that which goes with the toughness: stress is taken at each, linear between them, and
# cracks have those from a quarter on.
LADDER = np.concatenate([2.0 ** np.arange(-7, -2), 2.0 ** (np.arange(-5, 10) / 3)])
SHORTEST = 5
# Gauss points from one length to the next, and over the angle by whose sine a point is within one.
BETWEEN = np.polynomial.legendre.leggauss(3)
ROUND = np.polynomial.legendre.leggauss(32)
# Shares that differ by less are one: the shortest length counts.
ALIKE = 1e-9


@dataclass(frozen=True)
class CoupledCriterion:
    """A line opens where it has reached both.

    Attributes
    ----------
    strength
        Tensile strength (Pa).
    tough
        The length that goes with the toughness (m), see `mean_length`.
    """

    strength: float
    tough: float

    def reached(self, along: LineStress, stress: StressOn, lines: OpeningLines) -> LineReach:
        """See `LineCriterion.reached`."""
        far, body = self.tough * LADDER[-1] * lines.way, lines.body
        ladder = LADDER / LADDER[-1]
        ahead, known = along.at(stress, lines.point, far, body, ladder)
        behind, inside = ahead.copy(), lines.inside
        back = lines.point[inside], -far[inside], body[inside]
        behind[inside], there = along.at(stress, *back, ladder)
        known[inside] &= there
        known = np.logical_and.accumulate(known, axis=1)
        mean = np.einsum("ln,kni->kli", MEANS, (ahead + behind) / 2)
        pulled = LargestPrincipal.of(mean.reshape(-1, 3)).size.reshape(known.shape) / self.strength
        normal = np.stack([-lines.way[:, 1], lines.way[:, 0]], axis=1)
        across = [np.einsum("kni,ki->kn", one, _across(normal)) for one in (ahead, behind)]
        freed = self._freed(across[0], across[1], lines)
        share, rung = _largest(pulled, freed, known)
        rows = np.arange(len(rung))
        low = np.minimum(rung.astype(np.int64), len(LADDER) - 2)
        part = rung - low
        between = (1 - part)[:, None] * mean[rows, low] + part[:, None] * mean[rows, low + 1]
        length = self.tough * LADDER[low] * (LADDER[low + 1] / LADDER[low]) ** part
        return LineReach(share, between, length, known[:, SHORTEST])

    def _freed(self, ahead: Floats, behind: Floats, lines: OpeningLines) -> Floats:
        """Root of what cracks (k, n) of all lengths free, over that of what their faces take.

        Stresses (k, n) across the line are those at all lengths, ahead and behind.
        """
        notch = np.maximum(ahead @ NOTCH.T, 0.0) ** 2
        edge = np.where(lines.notched[:, None], notch, np.maximum(ahead @ EDGE.T, 0.0) ** 2)
        both = np.maximum((ahead + behind) @ PLANE.T, 0.0) ** 2 + ((ahead - behind) @ TILTED.T) ** 2
        square = np.where(lines.inside[:, None], both, edge)
        mean = np.cumsum((square * RUNGS).reshape(len(ahead), len(LADDER), -1).sum(axis=2), axis=1)
        return np.asarray(np.sqrt(mean / LADDER / (np.pi / 2)) / self.strength)


def _across(normal: Floats) -> Floats:
    """Rows (k, 3) that give the stress across planes from stresses [xx, yy, xy]."""
    return np.stack([normal[:, 0] ** 2, normal[:, 1] ** 2, 2 * normal[:, 0] * normal[:, 1]], axis=1)


def _largest(pulled: Floats, freed: Floats, known: Bools) -> tuple[Floats, Floats]:
    """Largest share (k,) that both have reached at one length, and its place on the ladder.

    Between two lengths at which now one, now the other is smaller, both are taken as linear.
    """
    rung = np.arange(len(LADDER), dtype=float)
    gap = freed - pulled
    with np.errstate(divide="ignore", invalid="ignore"):
        part = gap[:, :-1] / (gap[:, :-1] - gap[:, 1:])
    meet = (gap[:, :-1] < 0) & (gap[:, 1:] >= 0) & known[:, 1:]
    part = np.where(meet, part, 0.0)
    there = np.where(meet, (1 - part) * pulled[:, :-1] + part * pulled[:, 1:], -np.inf)
    share = np.concatenate([there, np.where(known, np.minimum(pulled, freed), -np.inf)], axis=1)
    at = np.concatenate([rung[:-1] + part, np.broadcast_to(rung, known.shape)], axis=1)
    share[at < SHORTEST] = -np.inf
    most = share.max(axis=1, keepdims=True)
    best = np.argmax(share >= most - ALIKE * np.abs(most), axis=1)
    rows = np.arange(len(best))
    return share[rows, best], at[rows, best]


def _means() -> Floats:
    """Means (n, n) over all lengths of what is known at them."""
    here = np.eye(len(LADDER))
    before = np.concatenate([here[:1], here[:-1]])
    pieces = np.diff(LADDER, prepend=0.0)[:, None] * (here + before) / 2
    return np.asarray(np.cumsum(pieces, axis=0) / LADDER[:, None])


def _intensities() -> tuple[Floats, Floats, Floats, Floats, Floats]:
    """Rows (a, n) that give K of cracks between all lengths, and the steps (a,) between them.

    Of one from an edge, the even and odd parts of one both ways in a plane, one that goes on.
    """
    start = np.append(0.0, LADDER[:-1])
    half = (LADDER - start) / 2
    length = (start[:, None] + half[:, None] * (1 + BETWEEN[0])).ravel()
    steps = (half[:, None] * BETWEEN[1]).ravel()
    angle, weight = (1 + ROUND[0]) * np.pi / 4, ROUND[1] * np.pi / 4
    s = np.sin(angle)

    def hats(at: Floats) -> Floats:
        every = np.eye(len(LADDER))
        return np.stack([np.interp(length[:, None] * at, LADDER, one) for one in every], axis=2)

    edge = 1 + (1 - s**2) * np.polyval([0.5094, -0.9942, 0.7685, -0.3912, 0.2945], s**2)
    root = np.sqrt(length / np.pi)[:, None]
    kinds = ((2 * edge, s), (1.0, s), (s, s), (np.sqrt(8) * s, s**2))
    rows = (root * np.einsum("q,aqn->an", weight * one, hats(at)) for one, at in kinds)
    return (*rows, steps)


MEANS = _means()
EDGE, PLANE, TILTED, NOTCH, RUNGS = _intensities()
