"""The static theorem under reduced strength: factors over which nothing can hold."""

from typing import TYPE_CHECKING

from nmm.stepping.bounds.static_theorem import carried

if TYPE_CHECKING:
    from nmm.assembly.state import State
    from nmm.stepping.step.stepper import Stepper

# The bound is found to this share of the width that is requested.
FINE = 1e-3


def safety_bound(
    stepper: "Stepper", state: "State", holds: float, highest: float, width: float
) -> float | None:
    """Return a factor with whose strengths no contact forces carry the loads (static theorem).

    It is sought above one that ``holds``, with whose strengths the stepper found the ``state``, and
    is the least such factor to a thousandth of ``width``: the theorem is of bodies where they stand
    in it. None where it shows nothing up to ``highest``.
    """

    def fails(factor: float) -> bool:
        found = carried(stepper, state, 1.0, weaker=factor / holds)
        return found is not None and found.fails

    low, high = holds, highest
    if not fails(high):
        return None
    while high - low > FINE * width:
        middle = (low + high) / 2
        low, high = (low, middle) if fails(middle) else (middle, high)
    return high
