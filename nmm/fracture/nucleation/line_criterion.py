"""Criteria for lines to open: the protocol, and the criterion of the mean stress."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.fracture.acting_stress import StressField
from nmm.fracture.nucleation.line_stress import LineStress
from nmm.materials.principal_stresses import PrincipalStresses

# Gauss points along a line, as shares of its length.
LINE_NODES, LINE_WEIGHTS = np.polynomial.legendre.leggauss(8)
SHARES = (1 + LINE_NODES) / 2


@dataclass(frozen=True)
class OpeningLines:
    """Candidate lines for cracks, each in a body.

    Attributes
    ----------
    point, way
        (k, 2) start of each line, or its middle inside, and its unit direction.
    body
        (k,) body that it may not leave.
    inside
        (k,) whether it goes both ways from its point.
    notched
        (k,) whether it begins at or beside a re-entrant corner.
    """

    point: Floats
    way: Floats
    body: Ints
    inside: Bools
    notched: Bools


@dataclass(frozen=True)
class LineEvaluation:
    """The criterion evaluated on lines (k,).

    Attributes
    ----------
    share
        Ratio to the criterion: a line opens at 1.
    mean
        (k, 3) mean stress along each, in body axes (Pa).
    length
        Of each (m); both ways inside.
    known
        Whether it stays in its body; the other values are valid only where it does.
    """

    share: Floats
    mean: Floats
    length: Floats
    known: Bools


class LineCriterion(Protocol):
    """A criterion for lines to open."""

    def evaluate(
        self, along: LineStress, stress: StressField, lines: OpeningLines
    ) -> LineEvaluation:
        """Return the ratios of lines under a stress.

        Parameters
        ----------
        along
            Evaluates the stress along lines of the model.
        stress
            The stress field.
        lines
            The candidate lines.
        """


@dataclass(frozen=True)
class MeanOnLine:
    """A line of one length (m) opens when its mean stress is the strength (Pa).

    The average stress criterion (Whitney and Nuismer 1974).
    """

    strength: float
    length: float

    def evaluate(
        self, along: LineStress, stress: StressField, lines: OpeningLines
    ) -> LineEvaluation:
        """See `LineCriterion.evaluate`."""
        begin = lines.point - (lines.inside * self.length)[:, None] * lines.way
        way = (self.length * (1 + lines.inside))[:, None] * lines.way
        found, known = along.at(stress, begin, way, lines.body, SHARES)
        mean = np.einsum("q,kqi->ki", LINE_WEIGHTS / 2, found)
        share = PrincipalStresses.of(mean).larger / self.strength
        length = np.full(len(share), self.length)
        return LineEvaluation(share, mean, length, np.asarray(known.all(axis=1)))
