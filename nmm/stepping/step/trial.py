"""The result of a trial step."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Self

import numpy as np

from integration.arrays import Floats
from nmm.assembly.state import State
from nmm.errors import SolveError
from nmm.frozen import with_parts
from nmm.stepping.step.booking import BookedWork

if TYPE_CHECKING:
    from nmm.contact.solution.record import ContactSolution


@dataclass(frozen=True)
class Attempt:
    """The result of a trial step, to be accepted or discarded.

    Attributes
    ----------
    converged, sentence
        The verdict.
    state
        The state at the end; that of the start when the step failed.
    increment
        (n,) unknowns of the step.
    motion
        Largest motion of a point (m).
    residual
        Relative out-of-balance force.
    passes
        Linear systems solved.
    solved
        Contact points with their forces; None without contact.
    booked
        Work of inertia and contact; None in statics.
    singular
        Whether the load moves a part that nothing holds, or matter flows without end.
    yields
        Whether matter yields all along that motion, which anchors would hide.
    imbalances
        Relative out-of-balance force of matter after each iteration; empty where it is linear.
    missed
        (n,) contact forces where the step ends less those where it was foreseen to end (N); None
        where they act at a place that is known.
    """

    converged: bool
    sentence: str
    state: State
    increment: Floats
    motion: float
    residual: float
    passes: int
    solved: "ContactSolution | None" = None
    booked: BookedWork | None = None
    singular: bool = False
    yields: bool = False
    imbalances: tuple[float, ...] = ()
    missed: Floats | None = None

    @classmethod
    def failed(cls, state: State, fault: SolveError) -> Self:
        """Return the result of a step from ``state`` that has no solution."""
        rest = np.zeros_like(state.deformation)
        return cls(False, str(fault), state, rest, 0.0, np.nan, 1, singular=fault.singular)

    def told(
        self, converged: bool, sentence: str, solved: "ContactSolution", passes: int
    ) -> "Attempt":
        """Return the result with the outcome of the contact solution."""
        residual = solved.answer.residual
        verdict = {"converged": converged, "sentence": sentence, "residual": residual}
        return with_parts(self, **verdict, passes=passes, solved=solved)
