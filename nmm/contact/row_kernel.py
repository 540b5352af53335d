"""Products with the rows of a problem, normal and tangential in one compiled pass."""

from typing import Any

import numba as nb
import numpy as np
import numpy.typing as npt

from integration.arrays import Floats
from nmm.contact.moment_kernel import pushed
from nmm.contact.problem import StepProblem

Index = npt.NDArray[Any]


def stretches(problem: StepProblem, increment: Floats) -> Floats:
    """(2, m) how far each contact opens and slips (m) under unknowns (n,)."""
    normal, tangent = problem.normal_rows, problem.tangent_rows
    moved = np.empty((2, problem.n_contacts))
    _along(normal.indptr, normal.indices, normal.data, increment, moved[0])
    _along(tangent.indptr, tangent.indices, tangent.data, increment, moved[1])
    return moved


def resultant(problem: StepProblem, forces: Floats) -> Floats:
    """(n,) what normal and shear forces (2, m) (N) do on the unknowns."""
    rows = (problem.normal_rows, problem.tangent_rows)
    parts: list[Any] = [part for one in rows for part in (one.indptr, one.indices, one.data)]
    parts += [forces[0], forces[1], len(problem.force)]
    return np.asarray(pushed(*parts))


@nb.njit(cache=True)
def _along(pointers: Index, columns: Index, entries: Floats, x: Floats, found: Floats) -> None:
    for c in range(len(pointers) - 1):
        total = 0.0
        for k in range(pointers[c], pointers[c + 1]):
            total += entries[k] * x[columns[k]]
        found[c] = total
