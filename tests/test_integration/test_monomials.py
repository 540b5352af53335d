"""Algebra of coefficient rows against evaluation and numpy.polynomial."""

import numpy as np
import pytest
from numpy.polynomial import polynomial

from integration.monomials import affine, count, differentiate, evaluate, exponents, multiply


def grid(row, degree):
    """Coefficients c[a, b] of one row as numpy.polynomial stores them."""
    table = np.zeros((degree + 1, degree + 1))
    table[tuple(exponents(degree).T)] = row
    return table


def value(rows, degree, points):
    return np.einsum("nk,nk->n", rows, evaluate(points, degree))


def test_monomials_are_graded():
    assert exponents(2).tolist() == [[0, 0], [1, 0], [0, 1], [2, 0], [1, 1], [0, 2]]
    assert [count(d) for d in (-1, 0, 1, 2, 3, 4)] == [0, 1, 3, 6, 10, 15]
    assert all(len(exponents(d)) == count(d) for d in range(9))


def test_values_are_powers_of_the_coordinates(rng):
    points = rng.integers(-4, 5, (7, 3, 2)).astype(float)
    expected = np.prod(points[..., None, :] ** exponents(5), axis=-1)
    assert np.array_equal(evaluate(points, 5), expected)


@pytest.mark.parametrize("degrees", [(0, 0), (0, 3), (1, 2), (2, 1), (3, 3)])
def test_products_of_whole_numbers_are_exact(rng, degrees):
    p, q = degrees
    a, b = (rng.integers(-9, 10, (5, count(d))).astype(float) for d in degrees)
    product = multiply(a, p, b, q)
    for n in range(5):
        left, right = grid(a[n], p), grid(b[n], q)
        expected = np.zeros((p + q + 1, p + q + 1))
        for i in range(p + 1):
            for j in range(q + 1):
                expected[i + j] += np.convolve(left[i], right[j])
        assert np.array_equal(grid(product[n], p + q), expected)


def test_products_broadcast_over_leading_axes(rng):
    weights, functions = rng.normal(size=(4, 3, 1, 3)), rng.normal(size=(4, 1, 2, 6))
    table = multiply(weights, 1, functions, 2)
    assert table.shape == (4, 3, 2, 10)
    assert np.array_equal(table[1, 2], multiply(weights[1, 2], 1, functions[1, 0], 2))


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("degree", [1, 2, 4])
def test_derivatives_agree_with_numpy(rng, degree, axis):
    row = rng.integers(-9, 10, (1, count(degree))).astype(float)
    expected = polynomial.polyder(grid(row[0], degree), axis=axis)
    found = grid(differentiate(row, degree, axis)[0], degree - 1)
    assert np.array_equal(found, expected[:degree, :degree])


def test_derivative_of_a_constant_is_one_zero_column():
    assert np.array_equal(differentiate(np.ones((3, 1)), 0, 1), np.zeros((3, 1)))


@pytest.mark.parametrize("degree", [0, 1, 2, 3, 6])
def test_affine_substitution_gives_the_values_at_mapped_points(rng, degree):
    rows = rng.normal(size=(50, count(degree)))
    matrix, shift = rng.normal(size=(50, 2, 2)), rng.normal(size=(50, 2))
    points = rng.normal(size=(50, 2))
    mapped = np.einsum("nij,nj->ni", matrix, points) + shift
    found = value(affine(rows, degree, matrix, shift), degree, points)
    # rounding grows with the sum of the moduli of the terms, of which there are a few hundred
    bound = (
        np.abs(rows)
        @ np.ones(count(degree))
        * (1 + np.abs(matrix).sum((1, 2)) * np.abs(points).max(1) + np.abs(shift).max(1)) ** degree
    )
    assert (np.abs(found - value(rows, degree, mapped)) <= 1e-15 * bound).all()


def test_affine_substitution_of_whole_numbers_is_exact():
    # x y at (x + 2 y + 1, 3 x - y + 4)
    row = np.array([[0.0, 0, 0, 0, 1, 0]])
    found = affine(row, 2, np.array([[1.0, 2.0], [3.0, -1.0]]), np.array([1.0, 4.0]))
    assert found.tolist() == [[4, 7, 7, 3, 5, -2]]


def test_affine_leaves_its_input_alone(rng):
    rows = rng.normal(size=(3, 6))
    before = rows.copy()
    affine(rows, 2, 2.0 * np.eye(2), np.ones(2))
    assert np.array_equal(rows, before)


def test_a_wrong_degree_is_refused():
    with pytest.raises(ValueError, match="5 columns: 6 expected for degree 2"):
        multiply(np.ones((2, 5)), 2, np.ones((2, 3)), 1)


def test_shared_tables_cannot_be_overwritten():
    with pytest.raises(ValueError, match="read-only"):
        exponents(2)[0] = 1
