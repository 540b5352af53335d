"""A run against the answers from elsewhere that its scene holds."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from integration.arrays import Floats
from nmm.results.quantity_names import REDUCED, parted
from nmm.results.summary import Summary


class Answer(Protocol):
    """What is known from elsewhere; `nmm.scene.monitors.ReferenceTable` is one."""

    @property
    def quantity(self) -> str:
        """Name of a number of a run (`nmm.results.quantity_names`)."""

    @property
    def value(self) -> float:
        """The value, SI."""

    @property
    def tolerance(self) -> float:
        """Relative tolerance."""

    @property
    def source(self) -> str:
        """Where it comes from."""


@dataclass(frozen=True)
class ReferenceComparison:
    """One quantity of a run against its reference.

    Attributes
    ----------
    quantity, source
        As in the scene.
    found
        Value of the run; None when the run has none.
    expected, tolerance
        Reference value and relative tolerance.
    """

    quantity: str
    found: float | None
    expected: float
    tolerance: float
    source: str

    @property
    def deviation(self) -> float:
        """Difference relative to the reference, absolute where that is zero; nan if none."""
        if self.found is None:
            return math.nan
        return (self.found - self.expected) / (abs(self.expected) or 1.0)

    @property
    def holds(self) -> bool:
        """Whether the deviation is within the tolerance."""
        return abs(self.deviation) <= self.tolerance


def compare(
    summary: Summary, history: Mapping[str, Floats], references: Iterable[Answer]
) -> list[ReferenceComparison]:
    """Compare a run with the references of its scene."""
    return [
        ReferenceComparison(
            item.quantity,
            _found(summary, history, item.quantity),
            item.value,
            item.tolerance,
            item.source,
        )
        for item in references
    ]


def _found(summary: Summary, history: Mapping[str, Floats], quantity: str) -> float | None:
    value = getattr(summary, quantity, None)
    if isinstance(value, int | float):
        return float(value)
    reduction, name = parted(quantity)
    column = history.get(name)
    if column is None or not np.isfinite(column).any():
        return None
    return REDUCED[reduction](column[np.isfinite(column)])
