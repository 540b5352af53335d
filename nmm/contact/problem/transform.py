"""Changes of a contact problem that are taken back from its answer."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from typing import Any

from nmm.contact.problem.step_problem import StepAnswer, StepProblem


class Transform(ABC):
    """One change of a problem into another that an enforcement solves in its place."""

    @abstractmethod
    def apply(self, problem: StepProblem) -> StepProblem:
        """Return the changed problem."""

    @abstractmethod
    def undo(self, answer: StepAnswer, problem: StepProblem) -> StepAnswer:
        """Return the answer to the ``problem`` that `apply` was given, from the changed one's."""

    def of_unknowns(self, values: Any) -> Any:
        """Return those of ``values`` (n,) that belong to the unknowns of the changed problem."""
        return values


def solve_through(
    transforms: Sequence[Transform],
    problem: StepProblem,
    solve: Callable[[StepProblem], StepAnswer],
) -> StepAnswer:
    """Apply transforms one after another, solve what comes of it, and undo them from the last."""
    stages = [problem]
    for transform in transforms:
        stages.append(transform.apply(stages[-1]))
    answer = solve(stages.pop())
    for transform, stage in zip(reversed(transforms), reversed(stages), strict=True):
        answer = transform.undo(answer, stage)
    return answer
