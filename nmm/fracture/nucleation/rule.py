"""The rule of crack nucleation in ``[fracture.nucleation]`` and the lengths of it."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.fracture.free_length import LIGAMENT
from nmm.fracture.nucleation.line_criterion import LineCriterion, MeanOnLine
from nmm.fracture.toughness import Toughness

if TYPE_CHECKING:
    from nmm.scene.tables.fracture.nucleation import NucleationTable

# Distance from cracks below which none nucleates, in lengths of the mean, or critical lengths where
# those are longer: at that distance from a tip at K_Ic the mean is 0.55 of the strength.
AWAY = 1.5


@dataclass(frozen=True)
class NucleationRule:
    """Rule of crack nucleation.

    Attributes
    ----------
    strength
        Tensile strength (Pa).
    criterion
        The criterion for a line to open.
    length
        Over which stress is averaged (m): from an edge inwards, or both ways from a place inside.
        The critical length where the criterion considers several.
    crack_length
        Of a nucleus (m), as long both ways inside; None where it follows from the criterion.
    critical_length
        The length that follows from toughness and strength (m), see `mean_length`.
    max_number
        Largest number of nuclei; infinite without a limit.
    effective
        Whether the pore pressure helps to open cracks.
    """

    strength: float
    criterion: LineCriterion
    length: float
    crack_length: float | None
    critical_length: float
    max_number: float
    effective: bool = True

    @classmethod
    def of(cls, table: "NucleationTable", toughness: Toughness, stiff: Floats) -> "NucleationRule":
        """Return the rule of a table for material of effective moduli E' ``stiff`` (n,) (Pa)."""
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
    def crack_distance(self) -> float:
        """Distance from cracks below which none nucleates (m)."""
        return AWAY * max(self.length, self.critical_length)

    @property
    def inside_distance(self) -> float:
        """Distance from edges above which places count as inside (m)."""
        return (1 + LIGAMENT) * self.length


def mean_length(toughness: float, strength: float) -> float:
    """Length (m) over which the mean stress ahead of a tip at K_Ic equals the tensile strength.

    It is ``2 L`` with ``L = (K_Ic / f_t)^2 / pi``: the line method of the theory of critical
    distances (Taylor 2007). Under uniform stress at the strength, a crack of this half length
    frees as much energy as its faces take.
    """
    return 2 / np.pi * (toughness / strength) ** 2
