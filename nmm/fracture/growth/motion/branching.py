"""Crack branching: where more energy flows into a tip than one crack can take.

The energy flow into a tip of speed ``v`` is ``G (1 - v / c_R)``, with G of the crack at rest; two
tips need ``2 G_c`` at least. So a tip may branch as soon as ``G >= 2 G_c``, which is at half the
Rayleigh wave speed. This rule is the project's own: a bound by energy alone, which leaves out that
G falls as the tip branches. With the fields of both branches, the least speed in antiplane strain
is 0.39 of the shear wave speed (Adda-Bedia 2004). Each branch then grows by the criterion.

An energy bound gives no distance between branchings: a tip would branch at every segment. So twice
the fracture energy must have flowed in along a length that the tip has run since it last branched.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from covers.cutting.cut_cells import CutCells
from integration.arrays import Bools, Floats
from nmm.fracture.growth.advance import new_ends, with_pieces
from nmm.fracture.growth.fronts import CrackFronts
from nmm.fracture.growth.tips.intensities import Intensities

# Multiple of the fracture energy from which a tip branches.
TWO = 2.0


@dataclass(frozen=True)
class Branching:
    """Rule of branching.

    Attributes
    ----------
    angle
        Of each branch from the kink of the criterion (rad).
    length
        Along which twice the fracture energy must have flowed in (m).
    """

    angle: float
    length: float

    def extended(
        self,
        cut: CutCells,
        cracks: Sequence[Floats],
        fronts: CrackFronts,
        found: Intensities,
        twice: Bools,
        length: float,
    ) -> tuple[tuple[Floats, ...], str]:
        """Return the polylines with new segments at all fronts ``found``, and what happened.

        The fronts ``twice`` (k,) branch. The left branch continues the polyline of its crack, the
        right one begins another.
        """
        begin = fronts.points(cracks)[found.front]
        angle = found.kink.angle + self.angle * twice
        ends = new_ends(
            cut,
            np.concatenate([begin, begin[twice]]),
            np.concatenate([found.tip, found.tip[twice]]),
            np.concatenate([angle, found.kink.angle[twice] - self.angle]),
            length,
        )
        n = len(begin)
        grown = with_pieces(cracks, fronts, found.front, ends[:n])
        born = tuple(np.stack(pair) for pair in zip(begin[twice], ends[n:], strict=True))
        said = [
            f"cracks {verb} at {', '.join(fronts.name[one] for one in found.front[rows])}"
            for verb, rows in (("grew", ~twice), ("branched", twice))
            if rows.any()
        ]
        return grown + born, ", ".join(said)
