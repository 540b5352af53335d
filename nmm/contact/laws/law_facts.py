"""What the interface laws of a scene are, whatever contacts there are."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from integration.arrays import Bools
from nmm.interfaces.base import InterfaceLaw
from nmm.interfaces.history import HistoryColumn


@dataclass(frozen=True)
class LawFacts:
    """Facts of laws.

    Attributes
    ----------
    laws
        (n,) one for each interface.
    """

    laws: Sequence[InterfaceLaw]

    @cached_property
    def evolving(self) -> dict[str, HistoryColumn]:
        """Internal variables on which the response of laws depends within a step."""
        return {name: one for law in self.laws for name, one in law.columns.items()}

    def remembering(self, name: str) -> Bools:
        """(n,) which laws have the internal variable of a name."""
        return np.array([name in law.columns for law in self.laws], dtype=bool)

    @cached_property
    def stiff(self) -> bool:
        """Whether any law has a stiffness of its own."""
        return bool(self.has_stiffness.any())

    @cached_property
    def has_stiffness(self) -> Bools:
        """(n,) whether each law has a stiffness of its own."""
        return np.array([law.normal_stiffness is not None for law in self.laws], dtype=bool)

    @cached_property
    def makes_joints(self) -> Bools:
        """(n,) whether shared edges of each law are followed as joints."""
        return np.array([law.makes_joints for law in self.laws], dtype=bool)

    @cached_property
    def bonded(self) -> Bools:
        """(n,) whether joints of each law hold together at the start."""
        return np.array([law.bonded for law in self.laws], dtype=bool)

    @cached_property
    def damps(self) -> bool:
        """Whether any law has damping."""
        return any(law.damping for law in self.laws)

    @cached_property
    def brittle(self) -> Bools:
        """(n,) whether bonds of each law break at once."""
        found = np.zeros(len(self.laws), dtype=bool)
        for number, law in enumerate(self.laws):
            whole = law.initial(np.ones(1, dtype=bool))
            found[number] = np.isinf(law.response(whole, np.ones(1)).limits.tension[0])
        return found
