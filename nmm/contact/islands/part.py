"""Part of a problem: some unknowns and contacts, the rest held where it is."""

from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from scipy.sparse import csc_array, csr_array

from integration.arrays import Floats, Index, Ints
from nmm.compiled import compiled
from nmm.contact.problem.cut_springs import CutSprings
from nmm.contact.problem.row_products import Compressed, compressed
from nmm.solvers.unchecked import made_of


def part_of(springs: CutSprings, unknowns: Ints, contacts: Ints, increment: Floats) -> CutSprings:
    """Return springs of ``contacts`` between ``unknowns``, both ascending.

    All other unknowns stay at ``increment`` (n,), all other contacts keep the forces that they have
    there.
    """
    p, n = springs.problem, len(unknowns)
    place = np.full(len(increment), -1)
    place[unknowns] = np.arange(n)
    *matrix, pulled = _between(compressed(p.matrix), unknowns, place, increment)
    *normal_rows, opened = _between(compressed(p.normal_rows), contacts, place, increment)
    *tangent_rows, slid = _between(compressed(p.tangent_rows), contacts, place, increment)
    forces = springs.forces(increment)
    forces[:, contacts] = 0.0
    pushes = p.pushed(*forces)
    columns, shape = p.columns_of(contacts), (len(contacts), n)
    columns["gap"] += opened
    columns["slip"] += slid
    problem = replace(
        p,
        matrix=_matrix(csc_array, matrix, (n, n)),
        force=p.force[unknowns] - pulled - pushes[unknowns],
        normal_rows=_matrix(csr_array, normal_rows, shape),
        tangent_rows=_matrix(csr_array, tangent_rows, shape),
        **columns,
        start=None,
        among=None if p.among is None else (p.among + np.abs(pushes))[unknowns] + np.abs(pulled),
    )
    columns_of = partial(np.take, indices=contacts, axis=1)
    return CutSprings(problem, columns_of(springs.stiffness), columns_of(springs.shift))


def _matrix(kind: Any, parts: list[Any], shape: tuple[int, int]) -> Any:
    pointers, indices, data = parts
    return made_of(kind, data, indices, pointers, shape)


@compiled
def _between(
    rows: Compressed, chosen: Ints, place: Ints, increment: Floats
) -> tuple[Index, Index, Floats, Floats]:
    """Entries of ``chosen`` rows in columns that have a place; what the others make of unknowns."""
    pointers, indices, data = rows
    most = 0
    for row in chosen:
        most += pointers[row + 1] - pointers[row]
    starts = np.zeros(len(chosen) + 1, dtype=np.int32)
    columns, entries = np.empty(most, dtype=np.int32), np.empty(most)
    rest = np.zeros(len(chosen))
    total = 0
    for i in range(len(chosen)):
        for k in range(pointers[chosen[i]], pointers[chosen[i] + 1]):
            at = place[indices[k]]
            if at >= 0:
                columns[total], entries[total] = at, data[k]
                total += 1
            else:
                rest[i] += data[k] * increment[indices[k]]
        starts[i + 1] = total
    return starts, columns[:total], entries[:total], rest
