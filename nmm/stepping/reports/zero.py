"""What displacements count from: the place as drawn, or that at the start of a stage that asks."""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Self

import numpy as np

from nmm.assembly.state import State
from nmm.assembly.transfer.state import carried

if TYPE_CHECKING:
    from nmm.effects.change import Change


@dataclass(frozen=True)
class ZeroDisplacement:
    """Where displacements are zero.

    Attributes
    ----------
    state
        On the present model; None is as drawn.
    resets
        How often it was set anew.
    """

    state: State | None = None
    resets: int = 0

    def followed(self, change: "Change", anew: bool) -> Self:
        """Return it on the new model of a change; ``anew`` it is the state at the change."""
        if anew:
            return replace(self, state=change.state, resets=self.resets + 1)
        if self.state is None:
            return self
        still = np.zeros_like(self.state.velocity)
        places = replace(self.state, velocity=still, acceleration=still, history={})
        start = replace(change.setup.start, history={})
        found = carried(change.old, change.new, change.parentage, places, start)
        return replace(self, state=found)
