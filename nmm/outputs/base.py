"""What an output is: quantities of a state for frames, and numbers of a step for the history."""

from collections.abc import Mapping

from nmm.effects.view import View
from nmm.quantity import Quantity
from nmm.registry import Registry

__all__ = ["OUTPUTS", "Output", "View"]


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
