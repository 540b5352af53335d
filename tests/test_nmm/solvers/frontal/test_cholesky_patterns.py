"""Patterns that sums of sparse matrices leave behind."""

import numpy as np
import pytest
from scipy.sparse import csc_array, eye_array, kron

from integration.arrays import Floats
from nmm.solvers.frontal.cholesky import Cholesky
from nmm.solvers.frontal.elimination import Fronts
from nmm.solvers.frontal.symbolic import skew
from nmm.testing.solvers import is_cholesky


def chain(n: int, block: int) -> csc_array:
    """Chain of coupled blocks, unit diagonal, positive definite."""
    near = eye_array(n, k=1) + eye_array(n, k=-1)
    line = eye_array(n) - 0.3 * near
    dense = np.eye(block) + 0.2 * (np.ones((block, block)) - np.eye(block))
    return csc_array(kron(line, dense, format="csc"))


def without(matrix: csc_array, row: int, column: int) -> csc_array:
    """Drop one entry of the pattern."""
    coo = matrix.tocoo()
    kept = (coo.row != row) | (coo.col != column)
    return csc_array((coo.data[kept], (coo.row[kept], coo.col[kept])), shape=matrix.shape)


def solved(matrix: csc_array) -> tuple[object, Floats, Floats]:
    load = np.random.default_rng(0).normal(size=matrix.shape[0])
    found = Cholesky().decompose(matrix)
    return found, found.solve(load), np.linalg.solve(matrix.toarray(), load)


@pytest.mark.parametrize("upper", [True, False])
def test_entry_that_rounded_to_zero_on_one_side_only_leaves_cholesky_at_work(upper: bool) -> None:
    matrix = chain(40, 3)
    tiny = csc_array(matrix.toarray())
    row, column = (61, 65) if upper else (65, 61)
    tiny[61, 65] = tiny[65, 61] = 1e-17
    found, x, exact = solved(without(tiny, row, column))
    assert is_cholesky(found)
    np.testing.assert_allclose(x, exact, rtol=1e-12)  # condition below 1e2


def test_matrix_that_is_not_symmetric_is_not_left_to_cholesky() -> None:
    matrix = without(chain(40, 3), 61, 64)  # an entry of 0.06 without mirror image
    for _ in range(2):  # a kept plan must not let it pass either
        found, x, exact = solved(matrix)
        assert not is_cholesky(found)
        np.testing.assert_allclose(x, exact, rtol=1e-12)


def test_difference_from_the_mirror_image_is_that_of_dense_algebra() -> None:
    random = np.random.default_rng(3)
    for _ in range(20):
        dense = np.where(random.uniform(size=(12, 12)) < 0.3, random.normal(size=(12, 12)), 0.0)
        both = dense + dense.T
        for array in (dense, both, dense + 0.1 * both):
            sparse = csc_array(array)
            off, alike = skew(sparse.indptr, sparse.indices, sparse.data)
            assert off == pytest.approx(np.abs(array - array.T).max(), abs=1e-15)
            assert alike == np.array_equal(array != 0, array.T != 0)


def test_columns_of_one_cover_stay_together_when_some_of_their_entries_are_gone() -> None:
    matrix = chain(200, 6)
    gone = without(without(matrix, 601, 606), 606, 601)
    whole, holed = Fronts.of(matrix), Fronts.of(gone)
    np.testing.assert_array_equal(whole.first, holed.first)


def test_columns_of_a_line_of_single_unknowns_are_not_lumped() -> None:
    # Every unknown with its neighbours only: lumping columns that overlap would fill the factor.
    line = csc_array(chain(500, 1) + eye_array(500))
    plan = Fronts.of(line)
    assert plan.panel_start[-1] < 20 * 500
