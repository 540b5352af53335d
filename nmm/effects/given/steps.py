"""What effects are told of a step, and what they say of their force through it."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Self

from scipy.sparse import csc_array

from integration.arrays import Floats
from nmm.assembly.motion import State


@dataclass(frozen=True)
class Instant:
    """The end of the step being solved.

    Attributes
    ----------
    time
        s; in statics the load factor.
    load_factor
        Factor on the scaled loads.
    """

    time: float
    load_factor: float

    @classmethod
    def of(cls, state: State) -> Self:
        """Return the instant at which a state stands."""
        return cls(state.time, state.load_factor)


@dataclass(frozen=True)
class Span:
    """How a step weighs the forces at its ends.

    Attributes
    ----------
    step
        Its length (s); None in statics.
    weight
        Share of the end of the step.
    half
        Whether bodies move with the mean of the velocities at both ends, so that forces between
        the mean places of two points keep angular momentum.
    """

    step: float | None
    weight: float
    half: bool


@dataclass(frozen=True)
class StepForce:
    """What an effect does through a step.

    Attributes
    ----------
    force
        (n,) its weighed force on the unknowns.
    stiffness
        Makes the matrix (n, n) of about how it falls with the increment (`Effect.symmetric`).
    memory
        What the effect remembers if the step is accepted.
    rounding
        (n,) what of the force rounding of places makes; None is nothing that matters.
    """

    force: Floats
    stiffness: Callable[[], csc_array]
    memory: Mapping[str, Floats] = field(default_factory=dict)
    rounding: Floats | None = None
