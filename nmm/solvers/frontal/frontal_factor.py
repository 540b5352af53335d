"""Factors on fronts: panels of numbers, and the plan they belong to."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from itertools import count
from typing import Any, Self

import numpy as np
import numpy.typing as npt
from scipy.sparse import csc_array

from integration.arrays import Floats, Index, Ints
from nmm.solvers.frontal.elimination import Fronts
from nmm.solvers.frontal.numbers import fronts, inverted, substitution
from nmm.solvers.frontal.numbers.blas import Inside, Outside, addresses, words
from nmm.solvers.frontal.numbers.workspace import Workspace
from nmm.solvers.threads import OneThread

CHOLESKY_KERNELS = "dpotrf", "dtrsm", "dsyrk", "dtrsv", "dgemv"
LU_KERNELS = "dgetrf", "dtrsm", "dgemm", "dtrsv", "dgemv"
SINGLE_KERNELS = "spotrf", "strsm", "ssyrk", "strsv", "sgemv"
SINGLE_LU_KERNELS = "sgetrf", "strsm", "sgemm", "strsv", "sgemv"
INVERTING = "dtrtri", "dtrsm"
SINGLE_INVERTING = "strtri", "strsm"
SINGLE = 1e-4
"""Least pivot of a matrix of unit diagonal whose factor is rounded to single precision. Walls,
piles and slopes with springs of 10 E have 2e-3 and more, and keep six digits of a solution."""
LARGE = 200_000
"""Numbers of a factor from which reading half of them is quicker: about a core's own cache. Walls
of 100 blocks have a quarter of it, of 1 000 five times as many."""
ForLoops = tuple[Outside, Inside]
"""What compiled loops hand to `substitution.solve` before and after the right-hand side."""
NO_SWAPS = np.empty(0, dtype=np.int32)


@dataclass(frozen=True)
class FrontalFactor:
    """A decomposition on fronts.

    Attributes
    ----------
    plan
        Which unknowns are eliminated together, and where their numbers go.
    panels
        Numbers of the factor, or of both.
    swaps
        Rows exchanged (n,) in LU; empty in Cholesky, which exchanges none.
    turns
        Counts how often loops have asked for it.
    """

    plan: Fronts
    panels: Workspace
    swaps: Index
    turns: Iterator[int] = field(default_factory=count, compare=False, repr=False)

    @classmethod
    def cholesky(cls, matrix: csc_array, plan: Fronts) -> Self | None:
        """Return ``L`` of a symmetric matrix; None where it is not positive definite."""
        made = cls(plan, Workspace(plan.panel_start[-1]), NO_SWAPS)
        return made if made._filled(matrix, (plan.source, plan.target)) else None

    @classmethod
    def lu(cls, matrix: csc_array, plan: Fronts, single: bool = False) -> Self | None:
        """Return ``L`` and ``U`` of a matrix, in double or ``single`` precision.

        None at a zero pivot.
        """
        swaps = np.empty(matrix.shape[0], dtype=np.int32)
        made = cls(plan, Workspace(plan.beside_start[-1], single), swaps)
        return made if made._filled(matrix, plan.places) else None

    def solve(self, rhs: Floats) -> Floats:
        """Return the solution of one right-hand side (n,) or of several (n, k)."""
        if rhs.ndim == 2:
            return np.stack([self.solve(column) for column in rhs.T], axis=1)
        return self._solved(rhs, self._plain)

    def rough(self, rhs: Floats) -> Floats:
        """Return the solution (n,) in the precision of `for_loops`."""
        return self._solved(rhs, self.for_loops)

    def _solved(self, rhs: Floats, given: ForLoops) -> Floats:
        x, (outside, inside) = np.empty(len(rhs)), given
        one = np.ascontiguousarray(rhs, dtype=np.float64)
        with OneThread():
            substitution.solve(outside, one, inside, x)
        return x

    @property
    def for_loops(self) -> ForLoops:
        """What compiled loops solve with.

        In single precision where that keeps digits enough for a correction that later ones mend:
        a solution is as long as its factor takes to be read. They hold the factor, whose panels
        are a workspace, as long as they use it. A factor that is requested again goes on being so:
        from then on its pivot blocks are inverted.
        """
        if next(self.turns) > 0 and self.symmetric:
            return self._again
        return self._plain if self._single is None else self._inside(self._single[1])

    @cached_property
    def _plain(self) -> ForLoops:
        return self._inside(self.panels.numbers)

    @cached_property
    def _again(self) -> ForLoops:
        return self._inside(self._inverted[1], True)

    def _inside(self, panels: npt.NDArray[Any], inverted: bool = False) -> ForLoops:
        plan, single = self.plan, panels.dtype == np.float32
        kernels = addresses(*(SINGLE_KERNELS if single else self._kernels))
        first, row_start, rows, panel_start = plan.shape
        places = plan.order, first, row_start, rows, panel_start, self._beside_start
        return (kernels, *words(single)), (*places, panels, self.swaps, inverted)

    @cached_property
    def _single(self) -> tuple[Workspace, npt.NDArray[np.float32]] | None:
        """Panels in single precision, in a workspace; None where few, or pivots too small."""
        panels = self.panels.numbers[: self.plan.panel_start[-1]]
        if (
            not self.symmetric
            or len(panels) < LARGE
            or panels[self.plan.pivots].min(initial=1.0) ** 2 < SINGLE
        ):
            return None
        workspace = Workspace(len(panels), single=True)
        rounded = workspace.numbers[: len(panels)]
        rounded[:] = panels
        return workspace, rounded

    @cached_property
    def _inverted(self) -> tuple[Workspace, npt.NDArray[Any]]:
        """Panels with inverted pivot blocks, in the room of those in single precision if any."""
        workspace, panels = self._single or self._copied
        first, row_start, _, panel_start = self.plan.shape
        single = panels.dtype == np.float32
        kernels = addresses(*(SINGLE_INVERTING if single else INVERTING))
        with OneThread():
            inverted.invert((kernels, *words(single)), first, row_start, panel_start, panels)
        return workspace, panels

    @property
    def _copied(self) -> tuple[Workspace, npt.NDArray[Any]]:
        size = self.plan.panel_start[-1]
        workspace = Workspace(size)
        workspace.numbers[:size] = self.panels.numbers[:size]
        return workspace, workspace.numbers

    def _filled(self, matrix: csc_array, places: tuple[Ints, Ints]) -> bool:
        """Factorise a matrix whose entries go to ``places``; say whether all pivots will do."""
        plan, single = self.plan, self._is_single
        stack = Workspace(plan.stack_size, single)
        with OneThread():
            bad = fronts.factorise(
                (addresses(*self._kernels), *words(single)),
                matrix.data,
                *places,
                plan.n_children,
                *plan.shape,
                self._beside_start,
                self.panels.numbers,
                self.swaps,
                stack.numbers,
            )
        return bool(bad < 0)

    @property
    def symmetric(self) -> bool:
        """Whether it is ``L L^T``."""
        return not len(self.swaps)

    @property
    def _kernels(self) -> tuple[str, ...]:
        if self.symmetric:
            return CHOLESKY_KERNELS
        return SINGLE_LU_KERNELS if self._is_single else LU_KERNELS

    @property
    def _is_single(self) -> bool:
        return bool(self.panels.numbers.dtype == np.float32)

    @property
    def _beside_start(self) -> Ints:
        """Where rows beside pivots start (S+1,); not read in Cholesky, which has none."""
        return self.plan.panel_start if self.symmetric else self.plan.beside_start
