"""What errors are measured against: the scene's own reference, or an extrapolated value."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from nmm.errors import NmmError
from nmm.scene import Scene
from nmm.study.orders import richardson
from nmm.study.record import Record


@dataclass(frozen=True)
class Reference:
    """A value to compare with.

    Attributes
    ----------
    quantity, value, uncertainty
        Name, number, and how far it may be off.
    source
        In words; says when it is an extrapolation.
    """

    quantity: str
    value: float
    uncertainty: float
    source: str

    def error(self, record: Record) -> float:
        """Relative error of a record; nan where the run gave none."""
        off = abs(record.quantities.get(self.quantity, np.nan) - self.value)
        return off / abs(self.value) if self.value else off


def stated_reference(scene: Scene, name: str | None) -> Reference | None:
    """Return the scene's own reference of a quantity; its first one when ``name`` is None."""
    for item in scene.references:
        if name is None or item.quantity == name:
            uncertainty = item.tolerance * abs(item.value)
            return Reference(item.quantity, item.value, uncertainty, item.source)
    return None


def extrapolated_reference(records: Sequence[Record], name: str) -> Reference:
    """Extrapolate from the three finest runs of the formulation with the most unknowns.

    Raises
    ------
    NmmError
        When no formulation has two valid runs.
    """
    usable = [one for one in records if one.valid and np.isfinite(one.quantities.get(name, np.nan))]
    names = {one.name for one in usable if sum(o.name == one.name for o in usable) > 1}
    if not names:
        raise NmmError(
            f"reference of {name}: no formulation has two valid runs: expected a [[reference]] in "
            "the scene or more sizes: add one of them"
        )
    finest = max((one for one in usable if one.name in names), key=lambda one: one.unknowns)
    series = [one for one in usable if one.name == finest.name]
    # In two dimensions the size of what carries an unknown falls with the root of their number.
    found = richardson(
        [one.unknowns**-0.5 for one in series], [one.quantities[name] for one in series]
    )
    source = f"Richardson extrapolation of the finest runs of {finest.name}"
    return Reference(name, found.value, found.uncertainty, source)
