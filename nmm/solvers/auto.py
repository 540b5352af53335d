"""The solver that costs least: chosen by size and by what a run needs anyway."""

from dataclasses import dataclass, replace
from typing import ClassVar

from integration.sparse import csc_array
from nmm.solvers.dense import Dense
from nmm.solvers.factor import Decomposition
from nmm.solvers.libraries.superlu import DefiniteSolver, SuperLU
from nmm.solvers.linear import LinearSolver

FEW, MANY = 60, 20000
"""Unknowns below which a full matrix costs least, and from which on compiled code always pays."""


@dataclass(frozen=True)
class Auto(DefiniteSolver):
    """Cholesky's factorisation where compiled code is at hand or pays its import, else SuperLU.

    The least matrices are factorised in full.

    Attributes
    ----------
    compiled
        Whether compiled code is taken from `FEW` unknowns on, as it is where contact imports it
        anyway, or where many steps pay for it. What else the process has imported must not
        choose: a run that is gone on with elsewhere has the same digits.
    """

    name: ClassVar[str] = "auto"
    compiled: bool = False

    def beside(self, compiled: bool) -> "Auto":
        return replace(self, compiled=self.compiled or compiled)

    def decompose(self, matrix: csc_array) -> Decomposition:
        """Factorise a scaled matrix; `RankDeficientError` at a zero pivot."""
        return self._chosen(matrix.shape[0]).decompose(matrix)

    def in_full(self, unknowns: int) -> bool:
        return unknowns < FEW and not self.shift

    def describe(self, unknowns: int) -> str:
        return f"{self.name}: {self._chosen(unknowns).describe(unknowns)}"

    def unsymmetric(self) -> "AutoLU":
        """LU on the fronts of Cholesky's factorisation where that is taken, refined twice."""
        return AutoLU(max(self.refinements, 2), self.shift, self.compiled)

    def _chosen(self, unknowns: int) -> LinearSolver:
        if unknowns < FEW:
            return Dense(self.refinements, self.shift)
        if not (self.compiled or unknowns >= MANY):
            return SuperLU(self.refinements, self.shift)
        from nmm.solvers.frontal.cholesky import Cholesky

        return Cholesky(self.refinements, self.shift)


@dataclass(frozen=True)
class AutoLU(Auto):
    """LU in compiled code where it is at hand or pays its import, else SuperLU.

    Attributes
    ----------
    single
        Whether it is for steps that later ones mend.
    """

    single: bool = False

    def rough(self) -> "AutoLU":
        return replace(self, single=True)

    def _chosen(self, unknowns: int) -> LinearSolver:
        found = super()._chosen(unknowns).unsymmetric()
        return found.rough() if self.single else found
