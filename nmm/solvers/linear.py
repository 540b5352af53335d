"""Base of linear solvers: a decomposition of scaled matrices, with settings; their names."""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Self

import numpy as np

from integration.arrays import Floats
from integration.sparse import csc_array
from nmm.registry import Registry
from nmm.solvers.factor import Decomposition as Decomposition
from nmm.solvers.factor import Factor as Factor
from nmm.solvers.factor import RankDeficientError as RankDeficientError
from nmm.solvers.scaling import jacobi_scale
from nmm.solvers.unchecked import made_of

SHIFT = 1e-10
"""Part of the diagonal added to a rank-deficient matrix (Duarte, Babuska, Oden 2000)."""


@dataclass(frozen=True)
class LinearSolver(ABC):
    """Base of direct solvers of symmetric sparse systems.

    Attributes
    ----------
    refinements
        Most steps of iterative refinement after a solution.
    shift
        Part of the scaled diagonal added before the decomposition and removed again by
        refinement. Zero for covers with independent functions; 1e-10 saves a second decomposition
        where functions are known to be dependent (Duarte, Babuska, Oden 2000).
    """

    name: ClassVar[str]
    refinements: int = 1
    shift: float = 0.0

    @abstractmethod
    def decompose(self, matrix: csc_array) -> Decomposition:
        """Factorise a scaled matrix; raise `RankDeficientError` at a zero pivot."""

    def factorise(self, matrix: csc_array) -> "Factor":
        """Scale and factorise ``matrix``.

        Raises
        ------
        SolveError
            When an entry is not finite.
        """
        compressed = getattr(matrix, "format", "") == "csc"
        short = compressed and matrix.indices.dtype == np.int32
        if short and matrix.has_sorted_indices:
            return Factor.of(self, matrix)
        found = csc_array(matrix)
        # Decompositions sort indices in place, which scaled copies share with their original.
        found.sort_indices()
        if not short:  # compiled code would be made anew for them
            pattern = found.indices.astype(np.int32), found.indptr.astype(np.int32)
            found = made_of(csc_array, found.data, *pattern, found.shape)
        return Factor.of(self, found)

    def indefinite(self) -> "LinearSolver":
        """Return the solver with settings for symmetric matrices with pivots of both signs."""
        return self

    def unsymmetric(self) -> "LinearSolver":
        """Return the solver with settings for nearly symmetric matrices with good pivots."""
        return self.indefinite()

    def rough(self) -> "LinearSolver":
        """Return the solver for steps that later ones mend: in the precision that costs least."""
        return self

    def in_full(self, unknowns: int) -> bool:
        """Return whether matrices of so many unknowns are regular and factorised in full."""
        return False

    def beside(self, compiled: bool) -> "LinearSolver":
        """Return the solver for runs that import compiled code anyway, or do not."""
        return self

    def scaling(self, matrix: csc_array) -> Floats:
        """(n,) factors that bring the matrix to entries of about one."""
        return jacobi_scale(matrix)

    def describe(self, unknowns: int) -> str:
        """Name of what factorises symmetric matrices of so many unknowns, for summaries."""
        return self.name

    def deflated(self) -> Self:
        """Return the solver with the shift for rank-deficient matrices."""
        return replace(self, shift=SHIFT, refinements=max(self.refinements, 5))


def sorted_rows(matrix: csc_array) -> csc_array:
    """Return the matrix with ascending rows in every column, itself where it has them."""
    return matrix if matrix.has_sorted_indices else matrix.sorted_indices()


SOLVERS: Registry[type[LinearSolver]] = Registry(
    "solver",
    LinearSolver,
    {
        "auto": "nmm.solvers.auto:Auto",
        "cholesky": "nmm.solvers.frontal.cholesky:Cholesky",
        "lu": "nmm.solvers.frontal.lu:FrontalLU",
        "superlu": "nmm.solvers.libraries.superlu:SuperLU",
        "dense": "nmm.solvers.dense:Dense",
        "qdldl": "nmm.solvers.libraries.qdldl:Qdldl",
        "mumps": "nmm.solvers.libraries.mumps:Mumps",
    },
)


def make_solver(name: str = "auto", options: Mapping[str, Any] | None = None) -> LinearSolver:
    """Return the linear solver ``name`` ("auto", a built-in or "module:Class").

    Raises
    ------
    FormulationError
        When the name or an option is not known.
    """
    made: LinearSolver = SOLVERS.make(name, options)
    return made
