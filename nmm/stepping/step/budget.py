"""What a run may cost: seconds on the wall clock and steps, and the end when they are spent."""

from dataclasses import dataclass, field
from time import perf_counter


class BudgetSpentError(Exception):
    """Seconds or steps are spent: the run ends with its last step. Its files have no fault."""


@dataclass
class Budget:
    """Seconds and steps of a run; None is no bound.

    Attributes
    ----------
    seconds, steps
        Most seconds on the wall clock since ``begun``, and most accepted steps.
    taken
        Steps accepted so far.
    """

    seconds: float | None = None
    steps: int | None = None
    begun: float = field(default_factory=perf_counter)
    taken: int = 0

    def check(self) -> None:
        """End the run when the budget is spent; called before each solution.

        Raises
        ------
        BudgetSpentError
            With the sentence that says which bound was met, and its key.
        """
        used = perf_counter() - self.begun
        if self.seconds is not None and not used <= self.seconds:  # no number bounds nothing
            raise BudgetSpentError(
                f"the budget of {self.seconds:g} s was spent: give more by --budget or "
                "[loading] budget, or take larger steps"
            )
        if self.steps is not None and self.taken >= self.steps:
            raise BudgetSpentError(
                f"the budget of {self.steps} steps was spent: give more by [loading] max_steps, "
                "or take larger steps"
            )
