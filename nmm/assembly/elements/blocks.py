"""Sparse matrices from element matrices, a block for each pair of covers.

Element matrices of congruent elements are held once. The sum over elements is a product of a
sparse matrix of counts, (pairs of covers) x (blocks of distinct element matrices), with these
blocks: nothing is repeated, and no scalar entry is sorted.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from integration.arrays import Floats, Ints
from integration.sparse import bsr_array, coo_array, csc_array, csr_array


@dataclass(frozen=True)
class Part:
    """Element matrices of one group.

    Attributes
    ----------
    unknowns
        (n, L) of each element.
    matrices
        (d, L, L) distinct element matrices.
    kind
        (n,) the matrix of each element.
    """

    unknowns: Ints
    matrices: Floats
    kind: Ints


def assemble(parts: Sequence[Part], n: int, offset: Ints, symmetric: bool = True) -> csc_array:
    """Sum element matrices.

    Parameters
    ----------
    parts
        Element matrices.
    n
        Number of unknowns.
    offset
        (C + 1,) first unknown of each cover.
    symmetric
        Whether all of them are.
    """
    sizes = np.diff(offset)
    if not parts or not len(sizes):
        return csc_array((n, n))
    if (sizes == sizes[0]).all() and all(_cover_by_cover(part, int(sizes[0])) for part in parts):
        return _by_blocks(parts, len(sizes), int(sizes[0]), symmetric)
    return _by_entries(parts, n)


def _cover_by_cover(part: Part, size: int) -> bool:
    """Whether the unknowns of elements are those of one cover after the other."""
    first = part.unknowns[:1]
    if not len(first):
        return True
    if first.shape[1] % size:
        return False
    steps = first.reshape(-1, size) - first.reshape(-1, size)[:, :1]
    return bool((steps == np.arange(size)).all())


def _by_blocks(parts: Sequence[Part], n_covers: int, size: int, symmetric: bool) -> csc_array:
    keys, sources, blocks, first = [], [], [], 0
    for part in parts:  # a handful of groups
        d, length, _ = part.matrices.shape
        k = length // size
        cover = part.unknowns[:, ::size] // size
        keys.append((cover[:, :, None] * n_covers + cover[:, None, :]).ravel())
        sources.append((first + part.kind[:, None] * k * k + np.arange(k * k)).ravel())
        split = part.matrices.reshape(d, k, size, k, size)
        blocks.append(np.swapaxes(split, 2, 3).reshape(d * k * k, size * size))
        first += d * k * k
    pairs, position = np.unique(np.concatenate(keys), return_inverse=True)
    source = np.concatenate(sources)
    counts = coo_array((np.ones(len(source)), (position, source)), shape=(len(pairs), first))
    data = csr_array(counts) @ np.concatenate(blocks)
    begin = np.searchsorted(pairs, np.arange(n_covers + 1) * n_covers)
    n = n_covers * size
    shape = (len(pairs), size, size)
    summed = bsr_array((data.reshape(shape), pairs % n_covers, begin), shape=(n, n)).tocsr()
    if not symmetric:
        return csc_array(summed)
    # Rows serve as columns.
    return csc_array((summed.data, summed.indices, summed.indptr), shape=(n, n))


def _by_entries(parts: Sequence[Part], n: int) -> csc_array:
    rows, columns, values = [], [], []
    for part in parts:  # a handful of groups
        length = part.unknowns.shape[1]
        rows.append(np.repeat(part.unknowns, length, axis=1).ravel())
        columns.append(np.tile(part.unknowns, length).ravel())
        values.append(part.matrices[part.kind].ravel())
    entries = (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns)))
    return csc_array(coo_array(entries, shape=(n, n)))
