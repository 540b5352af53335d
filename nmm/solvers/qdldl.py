"""QDLDL, the sparse LDL^T factorisation of OSQP, where it is installed."""

from dataclasses import dataclass
from importlib import import_module
from typing import ClassVar

from scipy.sparse import csc_array, csc_matrix, triu

from nmm.errors import FormulationError
from nmm.solvers.linear import Decomposition, LinearSolver, RankDeficientError


@dataclass(frozen=True)
class Qdldl(LinearSolver):
    """``A = L D L^T`` (Davis 2005; Stellato et al. 2020); also for quasi-definite matrices.

    Columns are handled one by one: faster than SuperLU up to some hundred blocks, slower beyond
    (benchmark `benchmarks/enforcement.py`).
    """

    name: ClassVar[str] = "qdldl"

    def decompose(self, matrix: csc_array) -> Decomposition:
        """Factorise a scaled matrix; `RankDeficientError` at a zero pivot."""
        try:
            module = import_module("qdldl")
        except ImportError as fault:
            raise FormulationError(
                'solver "qdldl": not installed: expected the package qdldl: '
                'install it or choose "auto"'
            ) from fault
        upper = csc_matrix(triu(matrix, format="csc"))
        try:
            found: Decomposition = module.Solver(upper, upper=True)
        except RuntimeError as fault:
            raise RankDeficientError(str(fault)) from fault
        return found

    def unsymmetric(self) -> LinearSolver:
        """SuperLU: the factorisation is symmetric."""
        from nmm.solvers.superlu import SuperLU

        return SuperLU(self.refinements, self.shift).unsymmetric()

    def indefinite(self) -> LinearSolver:
        """SuperLU, which searches pivots."""
        from nmm.solvers.superlu import SuperLU

        return SuperLU(self.refinements, self.shift).indefinite()
