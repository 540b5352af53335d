"""The kinematics of bodies, which a formulation chooses by ``[rotation] update``."""

from collections.abc import Callable
from dataclasses import dataclass

from integration.arrays import Floats
from nmm.assembly.model import Model
from nmm.assembly.moving.motion import move, strain_only, translate
from nmm.assembly.state import State


@dataclass(frozen=True)
class Kinematics:
    """How a body's place and deformation change in a step.

    Attributes
    ----------
    move
        From a model, a state and the unknowns (n,) of a step to the state after it.
    turns
        Whether the bodies' axes turn with them.
    small
        Whether displacements are small: forces need not follow the bodies.
    finite
        Whether strain is measured where bodies are, whatever they have turned.
    """

    move: Callable[[Model, State, Floats], State]
    turns: bool = False
    small: bool = False
    finite: bool = False

    @property
    def let_go(self) -> "Kinematics":
        """Kinematics of free bodies: large displacements, whatever was chosen."""
        return self if self.finite else COROTATIONAL


SMALL = Kinematics(strain_only, small=True)
"""Nothing moves: the theory of small displacements."""
COROTATIONAL = Kinematics(move, turns=True)
"""Bodies move and turn with their axes; strain within them is small."""
CLASSICAL = Kinematics(strain_only)
"""Bodies stay in a step and are laid anew after it (`nmm.stepping.step.remap`)."""
FINITE = Kinematics(translate, finite=True)
"""Bodies bend by any angle; their axes move along and never turn."""
