"""Where and when cracks begin: what ``[fracture.nucleation]`` says, and lengths that follow."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.fracture.clear_way import LIGAMENT
from nmm.fracture.nucleation.reached import LineCriterion, MeanOnLine
from nmm.fracture.toughness import Toughness

if TYPE_CHECKING:
    from nmm.scene.tables.fracture.nucleation import NucleationTable

# Places nearer to a crack than so many times the length of the mean, or of the toughness where that
# is longer, do not count: a tip at its toughness brings the mean there to 0.55 of the strength.
AWAY = 1.5


@dataclass(frozen=True)
class NucleationRule:
    """How cracks begin.

    Attributes
    ----------
    strength
        Tensile strength (Pa).
    criterion
        When a line opens.
    length
        Along which stress is averaged (m): from an edge inwards, or both ways from a place inside;
        where the criterion asks several, that of the toughness.
    crack_length
        Of a crack that begins (m), as long both ways inside; None where the criterion says.
    tough
        The length that goes with the toughness (m), see `mean_length`.
    most
        How many may begin; infinite without a limit.
    effective
        Whether the pressure in the pores helps to open cracks.
    """

    strength: float
    criterion: LineCriterion
    length: float
    crack_length: float | None
    tough: float
    most: float
    effective: bool = True

    @classmethod
    def of(cls, table: "NucleationTable", toughness: Toughness, stiff: Floats) -> "NucleationRule":
        """Return the rule of a scene's table where E' is ``stiff`` (n,) (Pa)."""
        strength = table.tensile_strength
        tough = mean_length(float(toughness.intensities(stiff).max()), strength)
        most = np.inf if table.number is None else table.number
        effective = table.stress == "effective"
        if table.criterion == "coupled":
            from nmm.fracture.nucleation.coupled import CoupledCriterion

            return cls(
                strength, CoupledCriterion(strength, tough), tough, None, tough, most, effective
            )
        length = tough if table.length is None else table.length
        crack_length = length if table.crack_length is None else table.crack_length
        mean = MeanOnLine(strength, length)
        return cls(strength, mean, length, crack_length, tough, most, effective)

    @property
    def away(self) -> float:
        """Distance from cracks below which none begins (m)."""
        return AWAY * max(self.length, self.tough)

    @property
    def deep(self) -> float:
        """Distance from edges from which places count as inside (m)."""
        return (1 + LIGAMENT) * self.length


def mean_length(toughness: float, strength: float) -> float:
    """Length (m) over which the mean stress ahead of a tip at K_Ic is the strength.

    ``2 L`` with ``L = (K_Ic / f_t)^2 / pi``: the line method of critical distances (Taylor 2007).
    Under even stress at the strength a crack of that length both ways frees what its faces take.
    """
    return 2 / np.pi * (toughness / strength) ** 2
