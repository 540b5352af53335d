"""QDLDL, the sparse LDL^T factorisation of OSQP, where it is installed."""

from dataclasses import dataclass
from typing import ClassVar

from scipy.sparse import csc_array, csc_matrix, triu

from nmm.solvers.factor import Decomposition, RankDeficientError
from nmm.solvers.libraries.optional import QDLDL
from nmm.solvers.libraries.superlu import DefiniteSolver


@dataclass(frozen=True)
class Qdldl(DefiniteSolver):
    """``A = L D L^T`` (Davis 2005; Stellato et al. 2020); also for quasi-definite matrices.

    Columns are handled one by one: faster than SuperLU up to some hundred blocks, slower beyond
    (benchmark `benchmarks/bench_contact.py`).
    """

    name: ClassVar[str] = "qdldl"

    def decompose(self, matrix: csc_array) -> Decomposition:
        """Factorise a scaled matrix; `RankDeficientError` at a zero pivot."""
        upper = csc_matrix(triu(matrix, format="csc"))
        try:
            found: Decomposition = QDLDL.load(self.name).Solver(upper, upper=True)
        except RuntimeError as fault:
            raise RankDeficientError(str(fault)) from fault
        return found
