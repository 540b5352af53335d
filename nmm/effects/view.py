"""An accepted state, as outputs and effects read it."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from integration.arrays import Floats

if TYPE_CHECKING:
    from nmm.assembly.model import Model
    from nmm.assembly.state import State
    from nmm.contact.points.contact_points import ContactPoints


@dataclass(frozen=True)
class View:
    """An accepted state as outputs and effects see it.

    Attributes
    ----------
    model, state
        Manifold with its materials, and the accepted state.
    contacts
        The C contact points; None without contact.
    stress_of
        Function of a state that returns mean Cauchy stresses (E, 3) in global axes (Pa).
    across_of
        Function of a state that returns the stress across the plane (E,) (Pa).
    """

    model: "Model"
    state: "State"
    contacts: "ContactPoints | None"
    stress_of: "Callable[[State], Floats]"
    across_of: "Callable[[State], Floats | None]"

    @cached_property
    def stress(self) -> Floats:
        """(E, 3) mean Cauchy stress (xx, yy, xy) of the elements in global axes (Pa)."""
        return self.stress_of(self.state)

    @cached_property
    def stress_across(self) -> Floats | None:
        """(E,) mean stress across the plane of the elements (Pa); None in plane stress."""
        return self.across_of(self.state)
