"""Numbers read off a run by name, the same for every formulation.

Names (`nmm.results.quantity_names`): ``failure_load``, ``failure_factor`` and every number of the
summary; any column of the history, at its end (``monitor:tip:uy``) or as ``max:column`` /
``min:column``; ``energy``, the elastic energy at the end.
"""

import math
from collections.abc import Mapping
from dataclasses import fields
from typing import TYPE_CHECKING, Protocol

import numpy as np

from integration.arrays import Floats
from nmm.errors import Fault, NmmError
from nmm.results.quantity_names import ENERGY, REDUCED, parted
from nmm.results.summary import Summary
from nmm.scene.faults import suggestion

if TYPE_CHECKING:
    from nmm.scene import Scene

_NUMBERS = {item.name for item in fields(Summary)}


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
    reduction, column = parted(name)
    value = getattr(run.summary, name) if name in _NUMBERS else name
    if value is None or isinstance(value, int | float):
        return math.nan if value is None else float(value)
    return REDUCED[reduction](_column(run, column))


def _column(run: Measured, name: str) -> Floats:
    if not any(len(column) for column in run.history.values()):
        return np.array([math.nan])  # no step was accepted
    if name not in run.history:
        known = ", ".join(run.history)
        raise NmmError(
            f"quantity {name}: expected a number of the summary or a column of the history "
            f"({known}): correct the name, or add a monitor to the scene"
        )
    return run.history[name]


def check_quantity_name(scene: "Scene", name: str) -> None:
    """Refuse a name that no run of a scene has, before any is made.

    Columns of parts that are known as they are built are looked for after the run (`quantity`).

    Raises
    ------
    NmmError
        With the names there are.
    """
    from nmm.model.consistency import known_quantities, may_have_column

    known, sought = [ENERGY, *known_quantities(scene)], parted(name)[1]
    if sought not in known and not may_have_column(scene, sought, known):
        expected = "a number of the summary or a column of the history, or max: or min: of one"
        raise NmmError(Fault("quantity", f'"{name}"', expected, suggestion(name, known)))
