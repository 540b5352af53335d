"""Numbers read off a run by name, the same for every formulation.

Names: ``failure_load``, ``failure_factor`` and every number of the summary; any column of the
history, at its end (``monitor:tip:uy``) or as ``max:column`` / ``min:column``; ``energy``, the
elastic energy at the end.
"""

import math
from collections.abc import Mapping
from typing import Protocol

from integration.arrays import Floats
from nmm.errors import NmmError
from nmm.results.summary import Summary

_REDUCED = {"max": lambda column: column.max(), "min": lambda column: column.min()}


class Measured(Protocol):
    """A run as far as quantities are concerned."""

    @property
    def summary(self) -> Summary:
        """Verdict and totals."""

    @property
    def history(self) -> Mapping[str, Floats]:
        """Columns, one value a step."""


def quantity(run: Measured, name: str) -> float:
    """Return a quantity of a run; nan when the run ended before it existed.

    Raises
    ------
    NmmError
        When no run has a quantity of that name.
    """
    reduction, _, column = name.partition(":")
    if reduction in _REDUCED:
        return float(_REDUCED[reduction](_column(run, column)))
    if name == "energy":
        return float(_column(run, "strain_energy")[-1])
    if hasattr(run.summary, name):
        value = getattr(run.summary, name)
        return math.nan if value is None else float(value)
    return float(_column(run, name)[-1])


def _column(run: Measured, name: str) -> Floats:
    if name not in run.history:
        known = ", ".join(run.history) or "none, as no step was accepted"
        raise NmmError(
            f"quantity {name}: expected a number of the summary or a column of the history "
            f"({known}): correct the name, or add a monitor to the scene"
        )
    return run.history[name]
