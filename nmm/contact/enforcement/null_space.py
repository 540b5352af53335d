"""Elimination of linear constraints by a null-space basis, in a step with contact.

A condition ``C d = g`` gives as many unknowns as there are conditions by the others,
``d = Z y + z`` with ``C Z = 0``. The step in ``y`` is an ordinary contact problem, which every
enforcement solves; the multipliers are what is left of the balance of the unknowns that were given.
"""

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from integration.arrays import Floats, Ints, same
from integration.sparse import csc_array, csr_array
from nmm.contact.problem.row_products import compressed
from nmm.contact.problem.step_problem import StepAnswer, StepProblem
from nmm.contact.problem.transform import Transform
from nmm.solvers.unchecked import magnitudes

# Conditions that others imply up to this share of the largest are left out.
IMPLIED = 1e-10


@dataclass(frozen=True)
class NullSpace(Transform):
    """Conditions ``rows @ d = sides``.

    Attributes
    ----------
    rows, sides
        (k, n) and (k,).
    given
        (r,) unknowns that follow from the others.
    factor, turn
        (r, r) and (k, r): ``factor @ d[given] = turn.T @ sides - ...`` of the other unknowns.
    basis
        (n, n - r) ``Z``.
    start
        (n,) ``z``.
    """

    rows: csr_array
    sides: Floats
    given: Ints
    factor: Floats
    turn: Floats
    basis: csc_array
    start: Floats
    _kept: dict[str, tuple[csc_array, csc_array]] = field(default_factory=dict)

    @classmethod
    def of(cls, rows: csr_array, sides: Floats, last: "NullSpace | None" = None) -> "NullSpace":
        """Choose the unknowns; the choice of the ``last`` step stands as long as the rows do."""
        if last is not None and _same(rows, last.rows):
            return replace(last, sides=sides, start=last._start(sides))
        from scipy.linalg import qr, solve_triangular

        n = rows.shape[1]
        touched = np.unique(rows.indices)
        q, r, order = qr(rows[:, touched].toarray(), mode="economic", pivoting=True)
        size = np.abs(r.diagonal())
        rank = int((size > IMPLIED * size.max(initial=0.0)).sum())
        given, others = touched[order[:rank]], touched[order[rank:]]
        share = solve_triangular(r[:rank, :rank], r[:rank, rank:])
        free = np.setdiff1d(np.arange(n), given)
        at = np.searchsorted(free, others)
        entries = np.concatenate([np.ones(len(free)), -share.ravel()])
        row = np.concatenate([free, np.repeat(given, len(others))])
        column = np.concatenate([np.arange(len(free)), np.tile(at, rank)])
        basis = csc_array((entries, (row, column)), shape=(n, len(free)))
        made = cls(rows, sides, given, r[:rank, :rank], q[:, :rank], basis, np.zeros(n))
        return replace(made, start=made._start(sides))

    def apply(self, problem: StepProblem) -> StepProblem:
        """Return the problem in the other unknowns."""
        matrix, basis, start = self._matrix(problem.matrix), self.basis, self.start
        normal, tangent = (csr_array(part @ basis) for part in problem.rows)
        for part in (normal, tangent):
            part.sort_indices()
        moved, among = problem.matrix @ start, problem.among
        if among is not None:
            among = magnitudes(basis).T @ (among + np.abs(moved))
        return replace(
            problem,
            matrix=matrix,
            force=basis.T @ (problem.force - moved),
            normal_rows=normal,
            tangent_rows=tangent,
            gap=problem.gap + problem.normal_rows @ start,
            slip=problem.slip + problem.tangent_rows @ start,
            start=None if problem.start is None else self.of_unknowns(problem.start),
            among=among,
        )

    def undo(self, answer: StepAnswer, problem: StepProblem) -> StepAnswer:
        """Return the answer in all unknowns, with the multipliers."""
        increment = self.basis @ answer.increment + self.start
        push = problem.pushed(answer.normal_force, answer.shear_force)
        rest = problem.force - problem.matrix @ increment - push
        return replace(answer, increment=increment, multipliers=self._multipliers(rest))

    def of_unknowns(self, values: Any) -> Any:
        """Return those (n - r,) of the unknowns that are not given."""
        return np.delete(values, self.given)

    def _multipliers(self, rest: Floats) -> Floats:
        """Multipliers (k,) with ``rows.T @ m = rest`` (n,), what is left of the balance."""
        from scipy.linalg import solve_triangular

        found = solve_triangular(self.factor, rest[self.given], trans="T")
        return np.asarray(self.turn @ found)

    def _start(self, sides: Floats) -> Floats:
        from scipy.linalg import solve_triangular

        start = np.zeros(self.rows.shape[1])
        start[self.given] = solve_triangular(self.factor, self.turn.T @ sides)
        return start

    def _matrix(self, matrix: csc_array) -> csc_array:
        """``Z^T matrix Z``, the same object of the same matrix."""
        kept = self._kept.get("matrix")
        if kept is None or kept[0] is not matrix:
            small = csc_array(self.basis.T @ (matrix @ self.basis))
            small = csc_array((small + small.T) / 2)
            small.sort_indices()
            kept = self._kept["matrix"] = matrix, small
        return kept[1]


def _same(a: csr_array, b: csr_array) -> bool:
    return a.shape == b.shape and all(map(same, compressed(a), compressed(b)))
