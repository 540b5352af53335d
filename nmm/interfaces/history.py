"""What interface laws remember of a contact: named columns, one number a contact each."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

History = Mapping[str, Any]
"""Columns (m,) by name; of floats, but for ``bonded``, which is true or false."""


@dataclass(frozen=True)
class HistoryColumn:
    """One variable that contacts of a law remember.

    Attributes
    ----------
    bonded, unbonded
        Its value at the start, where a bond holds and where none does.
    metres
        Whether it is a length (m), small or large beside the gaps of a scene; otherwise it has no
        unit and counts beside one.
    grows
        Whether it never becomes less.
    most
        Its largest value.
    """

    bonded: float = 0.0
    unbonded: float = 0.0
    metres: bool = False
    grows: bool = True
    most: float = float("inf")


CUMULATIVE_SLIP = HistoryColumn(metres=True)
"""Displacement slid under load, back and forth added (m)."""
DAMAGE = HistoryColumn(unbonded=1.0, most=1.0)
"""0 of a whole bond, 1 of a broken one and of a contact that never had one."""
KEPT = {"bonded": HistoryColumn(1.0, grows=False), "plastic_slip": HistoryColumn(grows=False)}
"""Columns of every law: whether a bond holds, and the slip that is no longer elastic (m)."""
