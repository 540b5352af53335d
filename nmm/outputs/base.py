"""What an output is: quantities of a state for frames, and numbers of a step for the history."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.assembly.motion import State
from nmm.quantity import Quantity
from nmm.registry import Registry

if TYPE_CHECKING:
    from nmm.contact.points.contact_points import ContactPoints


@dataclass(frozen=True)
class View:
    """An accepted state as outputs see it.

    Attributes
    ----------
    model, state
        Manifold with its materials; where it is and how fast.
    contacts
        Its C contact points; None without contact.
    """

    model: Model
    state: State
    contacts: "ContactPoints | None"
    stress_of: Callable[[State], Floats]

    @cached_property
    def stress(self) -> Floats:
        """(E, 3) mean Cauchy stress (xx, yy, xy) of the elements in global axes (Pa)."""
        return self.stress_of(self.state)


class Output:
    """Base of outputs: define `fields`, `history` or both."""

    def fields(self, view: View) -> Mapping[str, Quantity]:
        """Return quantities by name, for a frame."""
        return {}

    def history(self, view: View) -> Mapping[str, float]:
        """Return numbers by name of column, for a line of the history; asked after each step."""
        return {}


OUTPUTS: Registry[type[Output]] = Registry(
    "output",
    Output,
    {
        "von_mises": "nmm.outputs.stresses:VonMises",
        "principal_stress": "nmm.outputs.stresses:PrincipalStress",
        "mean_stress": "nmm.outputs.stresses:MeanStress",
        "crack_opening": "nmm.outputs.contacts:CrackOpening",
    },
)
