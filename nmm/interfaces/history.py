"""Internal variables of interface laws: named columns, one number for each contact."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

History = Mapping[str, Any]
"""Columns (m,) by name; of floats, but for ``bonded``, which is true or false."""


@dataclass(frozen=True)
class HistoryColumn:
    """One internal variable of the contacts of a law.

    Attributes
    ----------
    bonded, unbonded
        Its initial value, with a bond and without.
    metres
        Whether it is a length (m), to be compared with the gaps of a scene; otherwise it is
        dimensionless and compared with one.
    grows
        Whether it never decreases.
    most
        Its largest value.
    """

    bonded: float = 0.0
    unbonded: float = 0.0
    metres: bool = False
    grows: bool = True
    most: float = float("inf")


CUMULATIVE_SLIP = HistoryColumn(metres=True)
"""Accumulated slip under load (m), whatever its sign."""
DAMAGE = HistoryColumn(unbonded=1.0, most=1.0)
"""0 for an undamaged bond, 1 for a broken one and for a contact without a bond."""
KEPT = {"bonded": HistoryColumn(1.0, grows=False), "plastic_slip": HistoryColumn(grows=False)}
"""Columns of every law: whether a bond holds, and the slip that is no longer elastic (m)."""
