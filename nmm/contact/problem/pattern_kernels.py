"""Compiled loops over the unknowns that meet in contacts, in one sparse pattern."""

import numpy as np

from integration.arrays import Floats, Index
from nmm.compiled import compiled, place
from nmm.solvers.kernels.ascending import ascend, extended, place_of


@compiled
def meeting_unknowns(ptr_a: Index, idx_a: Index, ptr_b: Index, idx_b: Index) -> Index:
    """Return the unknowns (m, L) of the contacts of two compressed rows, ascending, then -1."""
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
def full_pattern(
    n: int, own_ptr: Index, own_idx: Index, who_ptr: Index, who: Index, unknowns: Index
) -> tuple[Index, Index]:
    """Return a matrix's pattern with the full squares of the unknowns of contacts in it."""
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
def matrix_places(indptr: Index, indices: Index, own_ptr: Index, own_idx: Index) -> Index:
    """Return the place of every entry of a matrix in a pattern that holds it."""
    place = np.empty(len(own_idx), dtype=np.int32)
    for j in range(len(own_ptr) - 1):
        for k in range(own_ptr[j], own_ptr[j + 1]):
            place[k] = place_of(own_idx[k], indices, indptr[j], indptr[j + 1])
    return place


@compiled
def row_places(unknowns: Index, ptr: Index, idx: Index) -> Index:
    """Return the place of every entry of compressed rows in an array (m, L) of all unknowns."""
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
def run_starts(indptr: Index, indices: Index, unknowns: Index) -> Index:
    """Return where runs of neighbours begin (m, L, R), see `SpringPattern.run_start`."""
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
def add_springs(
    data: Floats,
    unknowns: Index,
    start: Index,
    normal: Floats,
    tangent: Floats,
    kn: Floats,
    kt: Floats,
    mixed: Floats,
) -> None:
    """Add ``kn n n^T + kt t t^T + mixed t n^T`` of every contact to values in the pattern."""
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
