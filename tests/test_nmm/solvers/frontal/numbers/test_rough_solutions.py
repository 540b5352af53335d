"""Solutions in single precision where a factor keeps digits enough, in double where not."""

import numpy as np
import pytest
from scipy.sparse import csc_array, diags_array

from nmm.solvers.frontal import frontal_factor
from nmm.solvers.linear import make_solver


def chain(n: int, ground: float) -> csc_array:
    """Masses in a row on springs of one, each held by ``ground``."""
    return csc_array(diags_array([-1.0, 2.0 + ground, -1.0], offsets=[-1, 0, 1], shape=(n, n)))


@pytest.mark.parametrize("size", [1.0, 1e-60, 1e60])
def test_six_digits_whatever_the_size_of_the_load(
    size: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(frontal_factor, "LARGE", 0)
    matrix = chain(200, 0.1)
    factor = make_solver("cholesky").factorise(matrix)
    load = size * np.random.default_rng(0).normal(size=200)
    exact = np.linalg.solve(matrix.toarray(), load)
    off = np.linalg.norm(factor.rough(load) - exact) / np.linalg.norm(exact)
    assert 1e-9 < off < 1e-5


def test_a_factor_of_few_numbers_stays_in_double_precision() -> None:
    factor = make_solver("cholesky").factorise(chain(200, 0.1))
    load = np.ones(200)
    np.testing.assert_array_equal(factor.rough(load), factor.apply(load))


def test_a_factor_with_small_pivots_stays_in_double_precision(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(frontal_factor, "LARGE", 0)
    ends = np.zeros(200)
    ends[[0, -1]] = 1.0  # no springs beyond them: only the ground holds the row as a whole
    factor = make_solver("cholesky").factorise(csc_array(chain(200, 1e-8) - diags_array(ends)))
    load = np.ones(200)
    np.testing.assert_array_equal(factor.rough(load), factor.apply(load))
    np.testing.assert_allclose(factor.rough(load), 1e8, rtol=1e-6)


def test_a_load_of_nothing_moves_nothing() -> None:
    factor = make_solver("cholesky").factorise(chain(200, 0.1))
    assert not factor.rough(np.zeros(200)).any()


@pytest.mark.parametrize(("large", "rounding"), [(0, 1e-5), (10**9, 1e-14)])
def test_a_factor_that_is_asked_again_solves_with_inverted_pivots(
    large: int, rounding: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Springs between every two of 60 masses and of 30 others, joined at one: fronts of many."""
    monkeypatch.setattr(frontal_factor, "LARGE", large)
    rng, matrix = np.random.default_rng(1), np.zeros((90, 90))
    for part in (slice(0, 60), slice(59, 90)):
        size = part.stop - part.start
        joints = rng.normal(size=(size, size))
        matrix[part, part] += joints @ joints.T / size + 2.0 * np.eye(size)
    factor = make_solver("cholesky").factorise(csc_array(matrix))
    load = rng.normal(size=90)
    exact = np.linalg.solve(matrix, load)
    once, again = factor.rough(load), factor.rough(load)
    assert not np.array_equal(once, again)
    np.testing.assert_allclose(again, exact, atol=rounding * np.abs(exact).max())
    np.testing.assert_allclose(factor.apply(load), exact, atol=1e-14 * np.abs(exact).max())
