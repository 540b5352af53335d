"""Where and when cracks begin: what ``[fracture.nucleation]`` says, and lengths that follow."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
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
    length
        Along which stress is averaged (m).
    crack_length
        Of a crack that begins (m).
    away
        Distance from cracks below which none begins (m).
    most
        How many may begin; infinite without a limit.
    """

    strength: float
    length: float
    crack_length: float
    away: float
    most: float

    @classmethod
    def of(cls, table: "NucleationTable", toughness: Toughness, stiff: Floats) -> "NucleationRule":
        """Return the rule of a scene's table where E' is ``stiff`` (n,) (Pa)."""
        strength = table.tensile_strength
        tough = mean_length(float(toughness.intensities(stiff).max()), strength)
        length = tough if table.length is None else table.length
        crack_length = length if table.crack_length is None else table.crack_length
        most = np.inf if table.number is None else table.number
        return cls(strength, length, crack_length, AWAY * max(length, tough), most)


def mean_length(toughness: float, strength: float) -> float:
    """Length (m) over which the mean stress ahead of a tip at K_Ic is the strength.

    ``2 L`` with ``L = (K_Ic / f_t)^2 / pi``: the line method of critical distances (Taylor 2007).
    """
    return 2 / np.pi * (toughness / strength) ** 2
