"""What an effect is to the step loop."""

from abc import ABC
from dataclasses import dataclass

from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.assembly.motion import State


@dataclass(frozen=True)
class Instant:
    """The end of the step being solved.

    Attributes
    ----------
    time
        s.
    load_factor
        Factor on the scaled loads.
    """

    time: float
    load_factor: float


class Effect(ABC):
    """Base of effects: override the hooks the effect has; those left alone are never called.

    All vectors and matrices are in the unknowns of the step, that is in the bodies' axes.
    """

    name: str

    def force(self, state: State, end: Instant) -> Floats:
        """Force (n,) that acts through the step."""
        raise NotImplementedError

    def matrix(self, state: State) -> csc_array:
        """Symmetric matrix (n, n) that joins the stiffness in the step that starts at ``state``."""
        raise NotImplementedError

    def work(self, before: State, after: State, increment: Floats, end: Instant) -> float:
        """Work (J) that the effect did on the bodies in an accepted step."""
        raise NotImplementedError

    def energy(self, state: State) -> float:
        """Energy (J) the effect stores."""
        raise NotImplementedError


def defines(effect: Effect, hook: str) -> bool:
    """Say whether an effect has its own ``hook``."""
    return getattr(type(effect), hook) is not getattr(Effect, hook)
