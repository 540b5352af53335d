"""The members of one effect as links and slips, and their places in the memory of a state."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Self

import numpy as np

from integration.arrays import Floats, Ints
from nmm.effects.members.chains.chains import Chains
from nmm.effects.members.chains.layout import NONE
from nmm.effects.members.fibres import Fibres
from nmm.effects.members.links import Links

# Columns of memory: slip; plastic slip and its length; plastic strain and its length.
SLIP, BOND, AXIAL, WIDTH = 0, slice(1, 3), slice(3, 5), 5


@dataclass(frozen=True)
class Members:
    """Members of one effect as links.

    Attributes
    ----------
    names, places
        Name of each member, and its number of places of memory.
    links, chains
        The m links of all members, and the chains that they form.
    owner
        (m,) the member of each link.
    of_link, of_slip
        (m,) and (p,) places of memory of links and slips, counted through all members.
    """

    names: tuple[str, ...]
    places: tuple[int, ...]
    links: Links
    chains: Chains
    owner: Ints
    of_link: Ints
    of_slip: Ints

    @classmethod
    def without_slip(
        cls, names: tuple[str, ...], places: tuple[int, ...], links: Links, axial: Fibres
    ) -> Self:
        """Return members of ``places`` links each, none of which slips."""
        owner = np.repeat(np.arange(len(names)), places)
        chains, all_of_them = Chains.without_slip(axial), np.arange(len(links))
        return cls(names, places, links, chains, owner, all_of_them, NONE)

    @property
    def slip_owner(self) -> Ints:
        """(p,) member of each slip."""
        ends = np.cumsum(self.places)
        return np.asarray(np.searchsorted(ends, self.of_slip, side="right"))

    def memory(self, known: Mapping[str, Floats], fresh: float = 0.0) -> Floats:
        """Return the memory (places, 5) of all members; ``fresh`` for those that are new."""
        parts = [
            known.get(name, np.full((places, WIDTH), fresh))
            for name, places in zip(self.names, self.places, strict=True)
        ]
        return np.concatenate([np.zeros((0, WIDTH)), *parts])

    def remembered(self, whole: Floats) -> dict[str, Floats]:
        """Return the memory of each member by its name."""
        parts = np.split(whole, np.cumsum(self.places)[:-1])
        return dict(zip(self.names, parts, strict=True))
