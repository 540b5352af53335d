"""Where a path stands, and where it is to end."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from integration.arrays import Floats
from nmm.assembly.state import State

if TYPE_CHECKING:
    from nmm.contact.points.contact_points import ContactPoints


@dataclass(frozen=True)
class OnPath:
    """Where a path stands.

    Attributes
    ----------
    state, contacts
        The last state in equilibrium, and its contacts as left.
    advance
        How far the next step goes, in the unit of what is controlled.
    way
        (n,) sum of all increments of the unknowns.
    gone
        How far what is controlled has come.
    peak
        Largest load factor so far.
    softened
        Whether any bond that gave way softens.
    changed
        Whether the model has changed in this state, which is not in balance again yet.
    events
        How often bonds gave way.
    shed
        By how much the bonds that gave way last hold less energy (J).
    lost
        Steps that found no balance since one of full length did.
    """

    state: State
    contacts: "ContactPoints | None"
    advance: float
    way: Floats
    gone: float = 0.0
    peak: float = 0.0
    softened: bool = False
    changed: bool = False
    events: int = 0
    shed: float = 0.0
    lost: int = 0

    @classmethod
    def at_start(cls, state: State, increment: float) -> "OnPath":
        """Return the start of a path from ``state``, whose first step goes so far at most."""
        return cls(state, None, increment, np.zeros_like(state.deformation))


@dataclass(frozen=True)
class PathEnd:
    """Where a path is to end.

    Attributes
    ----------
    factor
        Largest load factor.
    fall
        Share of the largest load so far to which it may fall.
    """

    factor: float
    fall: float
