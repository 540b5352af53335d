"""Intensity factors at the tips of growing cracks, and the moduli of the material about them."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from covers.concatenate import some_of
from integration.arrays import Floats, Ints
from nmm.assembly.model import Model
from nmm.fracture.criteria.base import Kink
from nmm.quantity import Quantity


@dataclass(frozen=True)
class Intensities:
    """Intensity factors of the fronts with a tip in a state.

    Attributes
    ----------
    front, tip
        (k,) the fronts, and their tips in the cut.
    opening, sliding
        (k,) K_I and K_II (Pa m^1/2).
    stiff
        (k,) effective modulus E' of the material about each (Pa).
    kink, share
        Kink that each would grow by, and (k,) equivalent K over K_Ic.
    """

    front: Ints
    tip: Ints
    opening: Floats
    sliding: Floats
    stiff: Floats
    kink: Kink
    share: Floats

    def take(self, rows: Ints) -> "Intensities":
        """Return the selected rows."""
        return some_of(self, rows)

    @property
    def rate(self) -> Floats:
        """Energy release rate (k,) straight ahead, (K_I^2 + K_II^2) / E' (J/m2)."""
        return np.asarray((self.opening**2 + self.sliding**2) / self.stiff)

    @property
    def shut(self) -> float:
        """Largest ratio -K_I / |K| of all tips: above zero where a tip is closed."""
        size = np.hypot(self.opening, self.sliding)
        return float(np.max(-self.opening / np.where(size > 0, size, 1.0), initial=0.0))

    def quantities(self) -> dict[str, Quantity]:
        """Return the quantities of the tips for a frame."""
        return {
            "K_I": Quantity("tips", self.opening, "Pa m^0.5"),
            "K_II": Quantity("tips", self.sliding, "Pa m^0.5"),
            "G": Quantity("tips", self.rate, "J/m^2"),
            "share": Quantity("tips", self.share),
        }

    def row(self, names: Sequence[str]) -> dict[str, float]:
        """Return the values for a line of the history; ``names`` are those of all fronts."""
        columns = {"K_I": self.opening, "K_II": self.sliding, "G": self.rate, "share": self.share}
        return {
            f"{names[front]}:{key}": column[number]
            for number, front in enumerate(self.front)
            for key, column in columns.items()
        }


def tip_moduli(model: Model, element: Ints) -> tuple[Floats, Floats]:
    """Kolosov's constant and effective modulus E' (Pa) (n,) of the material of elements (n,)."""
    number = np.zeros(len(element), dtype=np.int64) if model.law is None else model.law[element]
    kappa = np.array([law.kolosov(model.plane) for law in model.laws])[number]
    return kappa, np.asarray(8 * model.elasticity[element, 2, 2] / (kappa + 1))
