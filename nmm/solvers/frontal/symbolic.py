"""Plans of factorisations, kept while patterns stand."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_array

from nmm.solvers.frontal.elimination import Fronts
from nmm.solvers.frontal.symmetry import skew

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
