"""Sparse matrices made and multiplied without checks are scipy's own, to the last digit."""

import numpy as np
import pytest
from scipy.sparse import csc_array, csr_array, random_array

from nmm.solvers.unchecked import largest, made_of, product


@pytest.mark.parametrize("kind", [csr_array, csc_array])
@pytest.mark.parametrize(("height", "width"), [(7, 7), (3, 11), (11, 3), (1, 0)])
def test_product_is_that_of_scipy(kind, height, width):
    draws = np.random.default_rng(4)
    matrix = kind(random_array((height, width), density=0.4, rng=draws))
    vector = draws.normal(size=2 * width)[::2]  # every other number of an array
    assert np.array_equal(product(matrix, vector), matrix @ vector)


@pytest.mark.parametrize("kind", [csr_array, csc_array])
def test_what_is_made_of_arrays_is_what_scipy_makes_of_them(kind):
    given = kind(random_array((5, 8), density=0.5, rng=np.random.default_rng(2)))
    made = made_of(kind, given.data, given.indices, given.indptr, (5, 8))
    assert type(made) is kind
    assert made.shape == (5, 8)
    assert made.data is given.data
    assert np.array_equal(made.toarray(), given.toarray())
    assert np.array_equal((made.T @ made).toarray(), (given.T @ given).toarray())
    made.sum_duplicates()
    assert made.has_sorted_indices


@pytest.mark.parametrize("kind", [csr_array, csc_array])
def test_largest_sizes_leave_a_matrix_as_it_is_whose_indices_are_not_in_order(kind):
    # Lines of the matrix: entries -3 at 2 and 1 at 0; none; 2 at 1.
    data, indices, ends = np.array([-3.0, 1.0, 2.0]), np.array([2, 0, 1]), np.array([0, 2, 2, 3])
    given = kind((data.copy(), indices.copy(), ends), shape=(3, 3))
    assert np.array_equal(largest(given), [3.0, 0.0, 2.0])
    assert np.array_equal(given.data, data)
    assert np.array_equal(given.indices, indices)
