"""Tips that divide in two: where more energy comes in than one crack can take.

A tip that runs at ``v`` takes in ``G (1 - v / c_R)``, G that of the crack at rest; two tips of the
same crack take ``2 G_c`` at least. So one may become two as soon as ``G >= 2 G_c``: when it
runs at half the speed of Rayleigh's wave. This is a rule of the project: a bound by energy alone,
which leaves out how G falls as the tip divides. With the fields of both branches the least speed is
0.39 of that of shear waves in antiplane strain (Adda-Bedia 2004). Both branches then grow by the
criterion on their own.

Energy alone knows no distance from one division to the next, and would divide a tip at every piece.
So twice the fracture energy must have come in along a length that the tip has run since it divided.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from covers.cutting.cut_cells import CutCells
from integration.arrays import Bools, Floats
from nmm.fracture.growth.advance import new_ends, with_pieces
from nmm.fracture.growth.fronts import CrackFronts
from nmm.fracture.growth.tips.intensities import Intensities

# Multiples of the fracture energy from which a tip divides.
TWO = 2.0


@dataclass(frozen=True)
class Branching:
    """Tips divide into two.

    Attributes
    ----------
    angle
        Of either from where the tip would go (rad).
    length
        Along which twice the fracture energy must have come in (m).
    """

    angle: float
    length: float

    def laid(
        self,
        cut: CutCells,
        cracks: Sequence[Floats],
        fronts: CrackFronts,
        found: Intensities,
        twice: Bools,
        length: float,
    ) -> tuple[tuple[Floats, ...], str]:
        """Return the polylines with new pieces at all fronts ``found``, and what happened.

        Those that are fed ``twice`` (k,) divide. A branch to the left goes on in the polyline of
        its crack, one to the right begins another.
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
