"""Plans of factorisations, kept while patterns stand."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_array

from integration.arrays import Floats, Index
from nmm.compiled import compiled
from nmm.solvers.frontal.elimination import Fronts

SKEW = 1e-12
"""Part of the largest entry by which a symmetric matrix and its mirror image may differ."""
PLANS_KEPT = 4


@dataclass
class KeptPlan:
    """A plan, and whether matrices of its pattern are known to be symmetric."""

    plan: Fronts
    symmetric: bool


PLANS: list[KeptPlan] = []


def symmetric_plan(matrix: csc_array) -> Fronts | None:
    """Plan of a matrix with sorted rows; None where it is not symmetric to rounding."""
    kept = _known(matrix)
    if kept is not None and kept.symmetric:
        return kept.plan
    off, mirrored = skew(matrix.indptr, matrix.indices, matrix.data)
    if off > SKEW * np.abs(matrix.data).max(initial=0.0):
        return None
    kept = kept or _planned(matrix, mirrored)
    kept.symmetric = mirrored
    return kept.plan


def any_plan(matrix: csc_array) -> Fronts:
    """Plan of the pattern that a matrix with sorted rows and its mirror image fill together."""
    kept = _known(matrix)
    if kept is None:
        _, mirrored = skew(matrix.indptr, matrix.indices, matrix.data)
        kept = _planned(matrix, mirrored)
    return kept.plan


def _known(matrix: csc_array) -> KeptPlan | None:
    return next((kept for kept in PLANS if kept.plan.fits(matrix)), None)


def _planned(matrix: csc_array, mirrored: bool) -> KeptPlan:
    kept = KeptPlan(Fronts.of(matrix, mirrored), False)
    PLANS.insert(0, kept)
    del PLANS[PLANS_KEPT:]
    return kept


@compiled
def skew(indptr: Index, indices: Index, data: Floats) -> tuple[float, bool]:
    """Largest difference of a matrix with sorted rows from its mirror image; alike in pattern."""
    n = len(indptr) - 1
    at = np.empty(n, dtype=np.int64)  # next entry below the diagonal of each column
    most, alike = 0.0, True
    for j in range(n):
        k = indptr[j]
        while k < indptr[j + 1] and indices[k] < j:
            i = indices[k]
            while at[i] < indptr[i + 1] and indices[at[i]] < j:
                most, alike = max(most, abs(data[at[i]])), False
                at[i] += 1
            if at[i] < indptr[i + 1] and indices[at[i]] == j:
                most = max(most, abs(data[k] - data[at[i]]))
                at[i] += 1
            else:
                most, alike = max(most, abs(data[k])), False
            k += 1
        if k < indptr[j + 1] and indices[k] == j:
            k += 1
        at[j] = k
    for j in range(n):
        for k in range(at[j], indptr[j + 1]):
            most, alike = max(most, abs(data[k])), False
    return most, alike
