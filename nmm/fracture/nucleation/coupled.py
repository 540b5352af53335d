"""The coupled criterion of stress and energy (Leguillon 2002).

A crack of length ``l`` nucleates if the mean stress along it is the tensile strength and its growth
from nothing frees the fracture energy of its faces (finite fracture mechanics: Cornetti, Pugno,
Carpinteri and Taylor 2006). Both conditions are evaluated on a set of lengths. Where the mean
stress falls and the energy rises with the length, they meet at one, which is that of the crack.

The energy follows from the stress before the crack is there: ``K`` of every shorter crack by its
weight function, that of an edge crack in a half plane (Tada, Paris and Irwin 2000) or of a crack in
an infinite plane. To the first is added what the weight function of a free strip as wide as the
body is deep has more than that of a half plane (Bueckner 1970). At notches it is the weight
function of a long crack that extends, by which K is 1, 3 and 8 % too small at notches of 60, 90 and
120 degrees (Carpinteri, Cornetti, Pugno and Sapora 2010).
"""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Bools, Floats
from integration.plane_vectors import counterclockwise
from nmm.fracture.acting_stress import StressField
from nmm.fracture.nucleation.line_criterion import LineEvaluation, OpeningLines
from nmm.fracture.nucleation.line_stress import LineStress
from nmm.materials.principal_stresses import PrincipalStresses

# Lengths over the critical length. Stress is evaluated at each and linear between them; nuclei have
# those from a quarter on.
LADDER = np.concatenate([2.0 ** np.arange(-7, -2), 2.0 ** (np.arange(-5, 10) / 3)])
SHORTEST = 5
# Gauss rules from one length to the next, and over the angle whose sine is the place along a crack.
BETWEEN = np.polynomial.legendre.leggauss(3)
ROUND = np.polynomial.legendre.leggauss(32)
# Terms of the weight function of a strip by length over width, squared and to the sixth, and the
# largest ratio for which they are known.
STRIP, DEEPEST = ((17.1844, 8.7822), (3.2889, 70.0444)), 0.5
# Relative difference below which ratios are equal: then the shortest length counts.
ALIKE = 1e-9


@dataclass(frozen=True)
class CoupledCriterion:
    """Criterion of strength and fracture energy.

    Attributes
    ----------
    strength
        Tensile strength (Pa).
    critical_length
        The length that follows from toughness and strength (m), see `mean_length`.
    """

    strength: float
    critical_length: float

    def evaluate(
        self, along: LineStress, stress: StressField, lines: OpeningLines
    ) -> LineEvaluation:
        """See `LineCriterion.evaluate`."""
        far, body = self.critical_length * LADDER[-1] * lines.way, lines.body
        ladder = LADDER / LADDER[-1]
        ahead, known = along.at(stress, lines.point, far, body, ladder)
        behind, inside = ahead.copy(), lines.inside
        back = lines.point[inside], -far[inside], body[inside]
        behind[inside], there = along.at(stress, *back, ladder)
        known[inside] &= there
        known = np.logical_and.accumulate(known, axis=1)
        mean = np.einsum("ln,kni->kli", MEANS, (ahead + behind) / 2)
        pulled = (
            PrincipalStresses.of(mean.reshape(-1, 3)).larger.reshape(known.shape) / self.strength
        )
        normal = counterclockwise(lines.way)
        across = [np.einsum("kni,ki->kn", one, _across(normal)) for one in (ahead, behind)]
        depth = along.depth(lines.point, lines.way, lines.body, ~lines.inside & ~lines.notched)
        freed = self._freed(across[0], across[1], lines, depth)
        share, rung = _largest(pulled, freed, known)
        rows = np.arange(len(rung))
        low = np.minimum(rung.astype(np.int64), len(LADDER) - 2)
        part = rung - low
        between = (1 - part)[:, None] * mean[rows, low] + part[:, None] * mean[rows, low + 1]
        length = self.critical_length * LADDER[low] * (LADDER[low + 1] / LADDER[low]) ** part
        return LineEvaluation(share, between, length, known[:, SHORTEST])

    def _freed(self, ahead: Floats, behind: Floats, lines: OpeningLines, depth: Floats) -> Floats:
        """Square root of freed over fracture energy (k, n) of cracks of all lengths.

        ``ahead`` and ``behind`` (k, n) are the stresses across the line at all lengths (Pa),
        ``depth`` (k,) how far bodies reach along lines (m).
        """
        notch = np.maximum(ahead @ NOTCH.T, 0.0) ** 2
        strip = np.maximum(edge_intensities(ahead, self.critical_length / depth), 0.0) ** 2
        edge = np.where(lines.notched[:, None], notch, strip)
        both = np.maximum((ahead + behind) @ PLANE.T, 0.0) ** 2 + ((ahead - behind) @ TILTED.T) ** 2
        square = np.where(lines.inside[:, None], both, edge)
        mean = np.cumsum((square * RUNGS).reshape(len(ahead), len(LADDER), -1).sum(axis=2), axis=1)
        return np.asarray(np.sqrt(mean / LADDER / (np.pi / 2)) / self.strength)


def edge_intensities(stress: Floats, depth: Floats) -> Floats:
    """K (k, a) of edge cracks under stresses (k, n), by critical lengths in the depth (k,)."""
    ratio = np.minimum(depth[:, None] * LENGTHS, DEEPEST)
    found = stress @ EDGE.T
    for (second, sixth), rows in zip(STRIP, (STRIP_FIRST, STRIP_SECOND), strict=True):
        found += (second * ratio**2 + sixth * ratio**6) * (stress @ rows.T)
    return np.asarray(found)


def _across(normal: Floats) -> Floats:
    """Rows (k, 3) that give the normal stress on planes from stresses [xx, yy, xy]."""
    return np.stack([normal[:, 0] ** 2, normal[:, 1] ** 2, 2 * normal[:, 0] * normal[:, 1]], axis=1)


def _largest(pulled: Floats, freed: Floats, known: Bools) -> tuple[Floats, Floats]:
    """Largest ratio (k,) that both conditions reach at one length, and the number of that length.

    Where the smaller of both changes between two lengths, both are interpolated linearly, and the
    number (k,) is not whole.
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
    """Matrix (n, n) from values at all lengths to the means up to each."""
    here = np.eye(len(LADDER))
    before = np.concatenate([here[:1], here[:-1]])
    pieces = np.diff(LADDER, prepend=0.0)[:, None] * (here + before) / 2
    return np.asarray(np.cumsum(pieces, axis=0) / LADDER[:, None])


def _intensities() -> tuple[Floats, ...]:
    """Rows (a, n) that give K of cracks from stresses at all lengths, lengths and weights (a,).

    For an edge crack, for the even and the odd part of the stress on a crack in a plane, for a
    long crack that extends, and for both terms of a strip.
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
    straight, bent = (np.sqrt(2) * (1 - s) ** power * np.cos(angle) for power in (0.5, 1.5))
    kinds = ((2 * edge, s), (1.0, s), (s, s), (np.sqrt(8) * s, s**2), (straight, s), (bent, s))
    rows = (root * np.einsum("q,aqn->an", weight * one, hats(at)) for one, at in kinds)
    return (*rows, length, steps)


MEANS = _means()
EDGE, PLANE, TILTED, NOTCH, STRIP_FIRST, STRIP_SECOND, LENGTHS, RUNGS = _intensities()
