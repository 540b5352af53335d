"""What is known of each front of growing cracks, as fronts divide and others begin."""

from dataclasses import dataclass, fields
from typing import Any, Self

import numpy as np

from integration.arrays import Ints


@dataclass(frozen=True)
class OverFronts:
    """Arrays (n,) over the fronts, which subclasses add.

    Attributes
    ----------
    time
        Of the last step (s).
    """

    time: float

    @property
    def arrays(self) -> tuple[Any, ...]:
        """All attributes."""
        return tuple(getattr(self, item.name) for item in fields(self))

    def divided(self, parents: Ints) -> Self:
        """Return them with branches (k,) behind, of which each has what its parent has."""
        each = (np.append(values, values[parents]) for values in self.arrays[1:])
        return type(self)(self.time, *each)

    def joined(self, new: Self) -> Self:
        """Return them with new fronts behind."""
        pairs = zip(self.arrays[1:], new.arrays[1:], strict=True)
        return type(self)(self.time, *(np.concatenate(pair) for pair in pairs))
