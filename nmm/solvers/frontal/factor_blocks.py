"""Factors on fronts: panels of numbers, and the plan they belong to."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import numpy.typing as npt

from integration.arrays import Floats, Ints
from nmm.solvers.frontal.blas import Index, addresses, words
from nmm.solvers.frontal.elimination import Fronts
from nmm.solvers.frontal.workspace import Loan
from nmm.solvers.threads import one_thread

Borrowed = tuple[Ints, npt.NDArray[np.uint8], Index, Floats]
"""Addresses of the kernels, and room for the letters, sizes and numbers they take."""


@dataclass(frozen=True)
class Panels(ABC):
    """A decomposition on fronts."""

    kernels: ClassVar[tuple[str, ...]]
    plan: Fronts
    panels: Loan

    def solve(self, rhs: Floats) -> Floats:
        """Return the solution of one right-hand side (n,) or of several (n, k)."""
        if rhs.ndim == 2:
            return np.stack([self.solve(column) for column in rhs.T], axis=1)
        x = np.empty(len(rhs))
        one = np.ascontiguousarray(rhs, dtype=np.float64)
        outside = addresses(*self.kernels), *words()
        with one_thread():
            self._fill(outside, one, x)
        return x

    @abstractmethod
    def _fill(self, outside: Borrowed, rhs: Floats, solution: Floats) -> None:
        """Solve for one right-hand side with what the compiled code borrows from outside."""
