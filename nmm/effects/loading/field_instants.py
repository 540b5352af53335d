"""Instants at which the quadrature of a field that varies in time resolves it."""

from dataclasses import dataclass
from typing import Self

import numpy as np

from integration.arrays import Floats
from nmm.effects.base import Setup
from nmm.effects.loading.fields import ValueField
from nmm.effects.loading.resolved import unresolved

MET_INSTANTS = 5
"""Their number; what is missed between them is measured."""

BETWEEN = np.array([0.31, 0.57, 0.83])
"""Where in each interval: middles would be where parts, which are halved, end."""


@dataclass(frozen=True)
class Instants:
    """Instants at which a field is resolved, ``met``, and between them, where it varies in time."""

    met: Floats
    between: Floats

    @classmethod
    def of(cls, setup: Setup, field: ValueField) -> Self:
        """Return those of a stage; load factors from 0 to 1 without a duration."""
        begin = setup.start.time
        if not field.varies:
            return cls(np.array([begin]), np.zeros(0))
        met = begin + np.linspace(0.0, 1.0, MET_INSTANTS) * (setup.scene.duration or 1.0)
        return cls(met, (met[:-1, None] + np.diff(met)[:, None] * BETWEEN).ravel())

    def missed(self, field: ValueField, corners: Floats, order: int) -> float:
        """Return what integrals on parts are off by between the instants, as a share."""
        if not len(self.between):
            return 0.0
        return unresolved(corners, order, field.sampled(self.between))
