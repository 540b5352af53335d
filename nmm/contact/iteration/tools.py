"""Tools of the iterations of a step: linear solver, memory and options."""

from dataclasses import dataclass, replace

from integration.arrays import Ints
from nmm.contact.iteration.memory import Memory
from nmm.contact.iteration.options import IterationOptions
from nmm.solvers.linear import LinearSolver


@dataclass(frozen=True)
class Tools:
    """Tools of the iterations.

    Attributes
    ----------
    linear
        Factorises the matrices.
    memory
        What is kept from step to step.
    options
        Numbers that steer.
    """

    linear: LinearSolver
    memory: Memory
    options: IterationOptions

    def of_part(self, unknowns: Ints) -> "Tools":
        """Return those of the islands that have these ``unknowns``."""
        return replace(self, memory=self.memory.of_part(unknowns))
