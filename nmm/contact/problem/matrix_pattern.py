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
from nmm.compiled import compiled, place
from nmm.contact.problem.step_problem import StepProblem
from nmm.solvers.kernels.ascending import ascend, extended, place_of
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
        unknowns = _unknowns(
            *_index(normal.indptr, normal.indices), *_index(tangent.indptr, tangent.indices)
        )
        members = csr_array(
            (np.ones((unknowns >= 0).sum(), dtype=np.int8), _members(unknowns)), shape=(n, m)
        )
        own = _index(matrix.indptr, matrix.indices)
        indptr, indices = _pattern(n, *own, *_index(members.indptr, members.indices), unknowns)
        run_start = _run_starts(indptr, indices, unknowns)
        return cls(
            _sources(problem),
            indices,
            indptr,
            _places(indptr, indices, *own),
            unknowns,
            _row_places(unknowns, *_index(normal.indptr, normal.indices)),
            _row_places(unknowns, *_index(tangent.indptr, tangent.indices)),
            run_start,
        )

    def fits(self, problem: StepProblem) -> bool:
        """Whether ``problem`` has the matrix and row patterns this one was built from."""
        return all(map(same, self.sources, _sources(problem)))

    def matrix(
        self, problem: StepProblem, normal: Floats, shear: Floats, mixed: Floats | None = None
    ) -> csc_array:
        """``matrix + Gn^T diag(normal) Gn + Gt^T diag(shear) Gt + Gt^T diag(mixed) Gn``."""
        data = np.zeros(len(self.indices))
        data[self.matrix_place] = problem.matrix.data
        rows = (
            self._in_full(problem.normal_rows.data, self.normal_place),
            self._in_full(problem.tangent_rows.data, self.tangent_place),
        )
        cross = np.zeros(len(normal)) if mixed is None else mixed
        _add_springs(data, self.unknowns, self.run_start, rows[0], rows[1], normal, shear, cross)
        made = made_of(csc_array, data, self.indices, self.indptr, problem.matrix.shape)
        made.has_sorted_indices = True  # or each matrix is looked through for it
        return made

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


def _sources(problem: StepProblem) -> tuple[npt.NDArray[Any], ...]:
    parts = (problem.matrix, problem.normal_rows, problem.tangent_rows)
    return tuple(array for part in parts for array in (part.indptr, part.indices))


def _index(indptr: npt.NDArray[Any], indices: npt.NDArray[Any]) -> tuple[Index, Index]:
    return indptr.astype(np.int32, copy=False), indices.astype(np.int32, copy=False)


def _members(unknowns: Index) -> tuple[Index, Index]:
    contact, _ = np.nonzero(unknowns >= 0)
    return unknowns[unknowns >= 0], contact.astype(np.int32)


@compiled
def _unknowns(ptr_a: Index, idx_a: Index, ptr_b: Index, idx_b: Index) -> Index:
    m = len(ptr_a) - 1
    width = 0
    for c in range(m):
        width = max(width, ptr_a[c + 1] - ptr_a[c] + ptr_b[c + 1] - ptr_b[c])
    both = np.empty((m, width), dtype=np.int32)
    merged = np.empty(width, dtype=np.int32)
    most = 0
    for c in range(m):
        total = 0
        for k in range(ptr_a[c], ptr_a[c + 1]):
            merged[total] = idx_a[k]
            total += 1
        for k in range(ptr_b[c], ptr_b[c + 1]):
            merged[total] = idx_b[k]
            total += 1
        ascend(merged[:total])
        count = 0
        for k in range(total):
            if k == 0 or merged[k] != merged[k - 1]:
                both[c, count] = merged[k]
                count += 1
        most = max(most, count)
        for k in range(count, width):
            both[c, k] = -1
    return both[:, :most].copy()


@compiled
def _pattern(
    n: int, own_ptr: Index, own_idx: Index, who_ptr: Index, who: Index, unknowns: Index
) -> tuple[Index, Index]:
    indptr = np.zeros(n + 1, dtype=np.int32)
    mark = np.full(n, -1)
    indices = np.empty(2 * len(own_idx) + 64, dtype=np.int32)
    total = 0
    for j in range(n):
        first = total
        need = own_ptr[j + 1] - own_ptr[j] + (who_ptr[j + 1] - who_ptr[j]) * unknowns.shape[1] + 1
        if total + need > len(indices):
            indices = extended(indices, 2 * len(indices) + need)
        mark[j] = j
        indices[total] = j
        total += 1
        for k in range(own_ptr[j], own_ptr[j + 1]):
            i = own_idx[k]
            if mark[i] != j:
                mark[i] = j
                indices[total] = i
                total += 1
        for k in range(who_ptr[j], who_ptr[j + 1]):
            for i in unknowns[who[k]]:
                if i >= 0 and mark[i] != j:
                    mark[i] = j
                    indices[total] = i
                    total += 1
        ascend(indices[first:total])
        indptr[j + 1] = total
    return indptr, indices[:total].copy()


@compiled
def _places(indptr: Index, indices: Index, own_ptr: Index, own_idx: Index) -> Index:
    place = np.empty(len(own_idx), dtype=np.int32)
    for j in range(len(own_ptr) - 1):
        for k in range(own_ptr[j], own_ptr[j + 1]):
            place[k] = place_of(own_idx[k], indices, indptr[j], indptr[j + 1])
    return place


@compiled
def _row_places(unknowns: Index, ptr: Index, idx: Index) -> Index:
    place = np.empty(len(idx), dtype=np.int32)
    width = unknowns.shape[1]
    for c in range(len(ptr) - 1):
        for k in range(ptr[c], ptr[c + 1]):
            for spot in range(width):
                if unknowns[c, spot] == idx[k]:
                    place[k] = c * width + spot
                    break
    return place


@compiled
def _run_starts(indptr: Index, indices: Index, unknowns: Index) -> Index:
    m, width = unknowns.shape
    most = 0
    for c in range(m):
        runs = 0
        for k in range(width):
            if unknowns[c, k] >= 0 and (k == 0 or unknowns[c, k] != unknowns[c, k - 1] + 1):
                runs += 1
        most = max(most, runs)
    start = np.zeros((m, width, most), dtype=np.int32)
    for c in range(m):
        for spot in range(width):
            j = unknowns[c, spot]
            if j < 0:
                break
            run = -1
            for k in range(width):
                i = unknowns[c, k]
                if i < 0:
                    break
                if k == 0 or i != unknowns[c, k - 1] + 1:
                    run += 1
                    start[c, spot, run] = place_of(i, indices, indptr[j], indptr[j + 1])
    return start


@compiled
def _add_springs(
    data: Floats,
    unknowns: Index,
    start: Index,
    normal: Floats,
    tangent: Floats,
    kn: Floats,
    kt: Floats,
    mixed: Floats,
) -> None:
    m, width = unknowns.shape
    first = np.empty(width + 1, dtype=np.int64)  # where each run of neighbours begins in a row
    for c in range(m):
        if kn[c] == 0.0 and kt[c] == 0.0 and mixed[c] == 0.0:
            continue
        runs = used = 0
        while used < width and unknowns[c, used] >= 0:
            if used == 0 or unknowns[c, used] != unknowns[c, used - 1] + 1:
                first[runs] = used
                runs += 1
            used += 1
        first[runs] = used
        for spot in range(used):
            along_n = kn[c] * normal[c, spot]
            along_t = kt[c] * tangent[c, spot] + mixed[c] * normal[c, spot]
            for run in range(runs):
                shift = start[c, spot, run] - first[run]
                for k in range(first[run], first[run + 1]):
                    part = along_n * normal[c, place(k)] + along_t * tangent[c, place(k)]
                    data[place(k + shift)] += part
