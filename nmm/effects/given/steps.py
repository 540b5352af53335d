"""The data of a step that effects are given, and the force that they return for it."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Self

from integration.arrays import Floats
from integration.sparse import csc_array
from nmm.assembly.state import State


@dataclass(frozen=True)
class Instant:
    """The end of the step that is being solved.

    Attributes
    ----------
    time
        Time (s); in statics the load factor.
    load_factor
        Factor of the scaled loads.
    """

    time: float
    load_factor: float

    @classmethod
    def of(cls, state: State) -> Self:
        """Return the instant of a state."""
        return cls(state.time, state.load_factor)


@dataclass(frozen=True)
class Span:
    """The weights of a step on the forces at its ends.

    Attributes
    ----------
    step
        Its duration (s); None in statics.
    weight
        Weight of its end.
    half
        Whether bodies move by the mean of the velocities at both ends (midpoint rule), so that
        forces along the line between the midpoints of two points conserve angular momentum.
    """

    step: float | None
    weight: float
    half: bool


@dataclass(frozen=True)
class StepForce:
    """The force of an effect through a step.

    Attributes
    ----------
    force
        (n,) weighted force on the unknowns.
    stiffness
        Returns its tangent (n, n), minus the derivative by the increment (see `Effect.symmetric`).
    memory
        The memory of the effect if the step is accepted.
    rounding
        (n,) error of the force by rounding; None where it is negligible.
    """

    force: Floats
    stiffness: Callable[[], csc_array]
    memory: Mapping[str, Floats] = field(default_factory=dict)
    rounding: Floats | None = None
