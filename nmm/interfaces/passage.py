"""Gaps, slips and tractions of contacts at the start and at the end of a step."""

from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats
from nmm.interfaces.history import History

Ends = tuple[Floats, Floats]
"""At the start and at the end of a step, (m,) each."""


@dataclass(frozen=True)
class Passage:
    """Contacts of one law from the start of a step to its end.

    Attributes
    ----------
    history
        At both ends.
    gap, slip
        Gap, and elastic slip (m).
    pull, shear
        Tractions (Pa).
    stiffness
        Normal and shear stiffness of undamaged bonds (Pa/m).
    """

    history: tuple[History, History]
    gap: Ends
    slip: Ends
    pull: Ends
    shear: Ends
    stiffness: tuple[Floats, Floats]

    @property
    def sliding(self) -> Floats:
        """Increment (m,) of the plastic slip, with its sign (m)."""
        start, end = self.history
        return np.asarray(end["plastic_slip"] - start["plastic_slip"])

    @property
    def pressure(self) -> Floats:
        """Mean pressure (m,) of both ends (Pa)."""
        start, end = (np.maximum(-pull, 0.0) for pull in self.pull)
        return np.asarray((start + end) / 2)
