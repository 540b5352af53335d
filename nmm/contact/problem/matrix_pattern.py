"""The matrix of a step with contact springs in it: fixed pattern, new values every pass.

The pattern holds the full square of the unknowns that meet in a contact, zeros included: so it
stands for every state and every step as long as the same unknowns meet, and a fill-reducing
ordering sees whole blocks.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.sparse import csc_array, csr_array

from integration.arrays import Floats, Index, same
from nmm.contact.problem.pattern_kernels import (
    add_springs,
    full_pattern,
    matrix_places,
    meeting_unknowns,
    row_places,
    run_starts,
)
from nmm.contact.problem.step_problem import StepProblem
from nmm.solvers.unchecked import made_of


@dataclass(frozen=True)
class SpringPattern:
    """Places of matrix entries and contact springs in one sparse pattern.

    Attributes
    ----------
    sources
        Index arrays of matrix and rows from which the pattern was built.
    indices, indptr
        The pattern, compressed columns.
    matrix_place
        Place of every entry of the problem's matrix.
    unknowns
        (m, L) unknowns of every contact, ascending, filled up with -1.
    normal_place, tangent_place
        Place of every entry of the rows in an array (m, L).
    run_start
        (m, L, R) place of the first entry of run ``r`` of unknowns in the column of unknown ``l``;
        a run is a stretch of consecutive unknowns, which stay neighbours in every column.
    """

    sources: tuple[npt.NDArray[Any], ...]
    indices: Index
    indptr: Index
    matrix_place: Index
    unknowns: Index
    normal_place: Index
    tangent_place: Index
    run_start: Index

    @classmethod
    def of(cls, problem: StepProblem) -> "SpringPattern":
        """Lay out the pattern of a problem."""
        matrix = problem.matrix
        n, m = matrix.shape[0], problem.n_contacts
        normal, tangent = problem.normal_rows, problem.tangent_rows
        unknowns = meeting_unknowns(
            *_index(normal.indptr, normal.indices), *_index(tangent.indptr, tangent.indices)
        )
        members = csr_array(
            (np.ones((unknowns >= 0).sum(), dtype=np.int8), _members(unknowns)), shape=(n, m)
        )
        own = _index(matrix.indptr, matrix.indices)
        indptr, indices = full_pattern(n, *own, *_index(members.indptr, members.indices), unknowns)
        return cls(
            _sources(problem),
            indices,
            indptr,
            matrix_places(indptr, indices, *own),
            unknowns,
            row_places(unknowns, *_index(normal.indptr, normal.indices)),
            row_places(unknowns, *_index(tangent.indptr, tangent.indices)),
            run_starts(indptr, indices, unknowns),
        )

    def fits(self, problem: StepProblem) -> bool:
        """Whether ``problem`` has the matrix and row patterns this one was built from."""
        return all(map(same, self.sources, _sources(problem)))

    def matrix(
        self, problem: StepProblem, normal: Floats, shear: Floats, mixed: Floats | None = None
    ) -> csc_array:
        """``matrix + Gn^T diag(normal) Gn + Gt^T diag(shear) Gt + Gt^T diag(mixed) Gn``."""
        return self.laid(problem).matrix(normal, shear, mixed)

    def laid(self, problem: StepProblem) -> "LaidProblem":
        """Return the numbers of a problem at their places."""
        data = np.zeros(len(self.indices))
        data[self.matrix_place] = problem.matrix.data
        normal = self._in_full(problem.normal_rows.data, self.normal_place)
        tangent = self._in_full(problem.tangent_rows.data, self.tangent_place)
        return LaidProblem(self, data, normal, tangent)

    def _in_full(self, entries: Floats, places: Index) -> Floats:
        """Entries (m, L) of rows at their places; those of full rows stand there already."""
        if self._full:
            return entries.reshape(self.unknowns.shape)
        rows = np.zeros(self.unknowns.size)
        rows[places] = entries
        return rows.reshape(self.unknowns.shape)

    @cached_property
    def _full(self) -> bool:
        """Whether all rows hold all unknowns of their contacts, in order."""
        ascending = np.arange(self.unknowns.size)
        pairs = self.normal_place, self.tangent_place
        return all(np.array_equal(places, ascending) for places in pairs)


@dataclass(frozen=True)
class LaidProblem:
    """Numbers of a problem in a pattern, to which springs of any stiffness are added.

    Attributes
    ----------
    pattern
        Where they stand.
    data
        Entries of the matrix without springs.
    normal, tangent
        (m, L) entries of the rows.
    """

    pattern: SpringPattern
    data: Floats
    normal: Floats
    tangent: Floats

    def matrix(self, normal: Floats, shear: Floats, mixed: Floats | None = None) -> csc_array:
        """See `SpringPattern.matrix`."""
        pattern, data = self.pattern, self.data.copy()
        cross = np.zeros(len(normal)) if mixed is None else mixed
        rows = self.normal, self.tangent
        add_springs(data, pattern.unknowns, pattern.run_start, *rows, normal, shear, cross)
        n = len(pattern.indptr) - 1
        made = made_of(csc_array, data, pattern.indices, pattern.indptr, (n, n))
        made.has_sorted_indices = True  # or each matrix is looked through for it
        return made


def _sources(problem: StepProblem) -> tuple[npt.NDArray[Any], ...]:
    parts = (problem.matrix, problem.normal_rows, problem.tangent_rows)
    return tuple(array for part in parts for array in (part.indptr, part.indices))


def _index(indptr: npt.NDArray[Any], indices: npt.NDArray[Any]) -> tuple[Index, Index]:
    return indptr.astype(np.int32, copy=False), indices.astype(np.int32, copy=False)


def _members(unknowns: Index) -> tuple[Index, Index]:
    contact, _ = np.nonzero(unknowns >= 0)
    return unknowns[unknowns >= 0], contact.astype(np.int32)
