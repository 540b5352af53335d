"""What lines have reached of what it takes to open them, and the criterion of the mean stress."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.fracture.acting_stress import StressOn
from nmm.fracture.nucleation.line_stress import LineStress
from nmm.fracture.principal import LargestPrincipal

# Gauss points along a line, as parts of it.
LINE_NODES, LINE_WEIGHTS = np.polynomial.legendre.leggauss(8)
SHARES = (1 + LINE_NODES) / 2


@dataclass(frozen=True)
class OpeningLines:
    """Lines from places, each in a body.

    Attributes
    ----------
    point, way
        (k, 2) where each begins, or its middle inside, and its direction.
    body
        (k,) which it may not leave.
    inside
        (k,) whether it goes both ways.
    notched
        (k,) whether it begins at or beside a corner that looks into the material.
    """

    point: Floats
    way: Floats
    body: Ints
    inside: Bools
    notched: Bools


@dataclass(frozen=True)
class LineReach:
    """What lines (k,) have reached.

    Attributes
    ----------
    share
        Of what it takes.
    mean
        (k, 3) stresses along each, in body axes (Pa).
    length
        Of each, both ways inside (m).
    known
        Whether it stays in its body; nothing else is right where it does not.
    """

    share: Floats
    mean: Floats
    length: Floats
    known: Bools


class LineCriterion(Protocol):
    """When a line opens."""

    def reached(self, along: LineStress, stress: StressOn, lines: OpeningLines) -> LineReach:
        """Return what lines have reached under a stress."""


@dataclass(frozen=True)
class MeanOnLine:
    """A line of one length opens where its mean stress is the strength (Whitney, Nuismer 1974)."""

    strength: float
    length: float

    def reached(self, along: LineStress, stress: StressOn, lines: OpeningLines) -> LineReach:
        """See `LineCriterion.reached`."""
        begin = lines.point - (lines.inside * self.length)[:, None] * lines.way
        way = (self.length * (1 + lines.inside))[:, None] * lines.way
        found, known = along.at(stress, begin, way, lines.body, SHARES)
        mean = np.einsum("q,kqi->ki", LINE_WEIGHTS / 2, found)
        share = LargestPrincipal.of(mean).size / self.strength
        length = np.full(len(share), self.length)
        return LineReach(share, mean, length, np.asarray(known.all(axis=1)))
