"""What errors are measured against: the scene's own reference, or an extrapolated value."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np

from nmm.errors import NmmError
from nmm.scene import Scene
from nmm.study.cases.record import Record
from nmm.study.cases.variants import SIZE
from nmm.study.cost.orders import Extrapolated, richardson

UNSETTLED = 10.0
UNKNOWNS = "unknowns^(-1/2)"


@dataclass(frozen=True)
class Reference:
    """A value to compare with.

    Attributes
    ----------
    quantity, value, uncertainty
        Name, number, and how far it may be off.
    source
        In words; says when it is an extrapolation.
    extrapolated
        Whether it was found from the runs themselves.
    limits
        Where the runs of each formulation go, by name, when it was.
    """

    quantity: str
    value: float
    uncertainty: float
    source: str
    extrapolated: bool = False
    limits: dict[str, Extrapolated] = field(default_factory=dict)

    @property
    def kind_of_error(self) -> str:
        """Errors are relative but for a reference of zero."""
        return "relative error" if self.value else "error"

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


def sizes_of(records: Sequence[Record]) -> list[float]:
    """Return the size that error falls with (`size_name`); 1 where none differs.

    In two dimensions the size of what carries an unknown falls with the root of their number, but
    of few there are more along edges: 2 (n + 1)^2 on a square.
    """
    name = size_name(records)
    if name == UNKNOWNS:
        return [one.unknowns**-0.5 if one.unknowns else np.nan for one in records]
    return [_number(one.settings.get(name)) if name else 1.0 for one in records]


def size_name(records: Sequence[Record]) -> str:
    """Return the name of the size that differs among records; "" where none does.

    It is that of covers where no other setting differs. Where all have the same number of unknowns,
    it is the first setting (a step, an increment, a tolerance) that differs and is a positive
    number.
    """
    differs = [
        key
        for key in dict.fromkeys(key for one in records for key in one.settings)
        if any(one.settings.get(key) != records[0].settings.get(key) for one in records)
    ]
    sizes = [key for key in differs if all(_number(one.settings.get(key)) > 0 for one in records)]
    if differs == sizes == [SIZE]:
        return SIZE
    if len({one.unknowns for one in records}) > 1:
        return UNKNOWNS
    return sizes[0] if sizes else ""


def extrapolated_reference(records: Sequence[Record], name: str) -> Reference:
    """Extrapolate from the finest runs of the formulation that leaves the least uncertainty.

    The doubt about one whose three finest values do not approach each other counts ten times.

    Raises
    ------
    NmmError
        When no formulation has two valid runs of different size.
    """
    usable = [one for one in records if one.valid and np.isfinite(one.quantities.get(name, np.nan))]
    limits = {title: _limit(many, name) for title, many in by_name(usable).items()}
    known = {title: limit for title, limit in limits.items() if np.isfinite(limit.uncertainty)}
    if not known:
        raise NmmError(_without_reference(records, name))
    best = min(known, key=lambda title: _doubt(known[title]))
    found = known[best]
    order = f", order {found.order:.2f}" if np.isfinite(found.order) else ""
    source = f"Richardson extrapolation of the finest runs of {best}{order}"
    return Reference(name, found.value, found.uncertainty, source, True, known)


def by_name(records: Iterable[Record]) -> dict[str, list[Record]]:
    """Return the records of each formulation, in the order given."""
    found: dict[str, list[Record]] = {}
    for one in records:
        found.setdefault(one.name, []).append(one)
    return found


def _limit(records: Sequence[Record], name: str) -> Extrapolated:
    """Extrapolate the runs of one formulation, one value a size."""
    at = dict(zip(sizes_of(records), (one.quantities[name] for one in records), strict=True))
    return richardson(list(at), list(at.values()))


def _doubt(limit: Extrapolated) -> float:
    settled = np.isfinite(limit.order)
    return limit.uncertainty / (abs(limit.value) or 1.0) * (1.0 if settled else UNSETTLED)


def _number(value: object) -> float:
    return float(value) if isinstance(value, int | float) else float("nan")


def _without_reference(records: Sequence[Record], name: str) -> str:
    failed = next((one for one in records if not one.valid), None)
    why = f" (the run of {failed.label} failed: {failed.sentence})" if failed else ""
    return (
        f"reference of {name}: no formulation has two valid runs of different size{why}: expected "
        "a [[reference]] in the scene or more sizes: add one of them"
    )
