"""The factors that a search for safety has tried, stored after each: it goes on after the last.

A search asks the same questions in the same order whenever it is run. What is known of the answers
is given again, so that one that was stopped tries no factor twice, and ends as one that was not.
"""

import json
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from nmm.results.storage.values import TREE, Arrays

SEARCH = "search"
"""Name of the text, among the arrays of a checkpoint, that the search makes."""

Answer = tuple[str, str]
"""Status of a run, and its verdict in words."""


@dataclass
class TriedFactors:
    """Answers of a search by their number.

    Attributes
    ----------
    keep
        Takes what is stored.
    answers
        Factors with what their runs ended as.
    bounds
        Factors that the static theorem showed to fail, None where it showed none.
    """

    keep: Callable[[Arrays], None] = lambda arrays: None
    answers: list[tuple[float, Answer]] = field(default_factory=list)
    bounds: list[float | None] = field(default_factory=list)
    _asked: list[int] = field(default_factory=lambda: [0, 0])

    def tried(self, factor: float, run: Callable[[float], Answer]) -> Answer:
        """Return what a run over a factor ends as."""
        number = self._next(0)
        if number == len(self.answers):
            self.answers.append((factor, run(factor)))
            self.store({})
        known, answer = self.answers[number]
        assert known == factor, f"the search has tried {known!r}, not {factor!r}"
        return answer

    def bounded(self, seek: Callable[[], float | None]) -> float | None:
        """Return what the static theorem shows."""
        number = self._next(1)
        if number == len(self.bounds):
            self.bounds.append(seek())
            self.store({})
        return self.bounds[number]

    def store(self, arrays: Arrays) -> None:
        """Store the answers, with what else the run goes on from."""
        self.keep({**arrays, SEARCH: np.array(json.dumps([self.answers, self.bounds]))})

    def taken_up(self, arrays: Arrays) -> bool:
        """Take up what was stored; return whether a run over the factor sought had begun.

        Raises
        ------
        ValueError
            When the arrays are of no search.
        """
        try:
            answers, bounds = json.loads(arrays[SEARCH].item())
            self.answers = [
                (float(one), (str(status), str(said))) for one, (status, said) in answers
            ]
            self.bounds = [None if one is None else float(one) for one in bounds]
        except (KeyError, TypeError) as fault:
            raise ValueError(f"it is of no search for a factor ({fault})") from fault
        return TREE in arrays

    def _next(self, question: int) -> int:
        self._asked[question] += 1
        return self._asked[question] - 1
