"""What rounding makes of a solution is foreseen, beside solutions in exact fractions."""

from fractions import Fraction

import numpy as np
import pytest
from scipy.sparse import csc_array

from nmm.solvers.accuracy.rounding_error import rounding_changes
from nmm.solvers.linear import make_solver


def hilbert(n):
    return [[Fraction(1, i + j + 1) for j in range(n)] for i in range(n)]


def chain(n, stiff):
    """Springs of 1 and ``stiff`` in turns, the first held: a soft motion of stiff pairs."""
    matrix = [[Fraction(0)] * n for _ in range(n)]
    for i in range(n):
        k = Fraction(stiff if i % 2 else 1)
        matrix[i][i] += k
        if i:
            matrix[i - 1][i - 1] += k
            matrix[i - 1][i] -= k
            matrix[i][i - 1] -= k
    return matrix


def solved_exactly(matrix, load):
    """Gauss's elimination in fractions."""
    rows = [[*row, right] for row, right in zip(matrix, load, strict=True)]
    n = len(rows)
    for i in range(n):
        for j in range(i + 1, n):
            part = rows[j][i] / rows[i][i]
            rows[j] = [a - part * b for a, b in zip(rows[j], rows[i], strict=True)]
    x = [Fraction(0)] * n
    for i in reversed(range(n)):
        rest = sum(rows[i][j] * x[j] for j in range(i + 1, n))
        x[i] = (rows[i][n] - rest) / rows[i][i]
    return x


@pytest.mark.parametrize(
    "matrix",
    [hilbert(6), hilbert(9), chain(12, 10**6), chain(12, 10**10), chain(12, 1)],
    ids=["hilbert 6", "hilbert 9", "ratio 1e6", "ratio 1e10", "ratio 1"],
)
def test_the_error_of_a_solution_is_foreseen_within_a_factor_of_a_hundred(matrix):
    # What is stored in double precision is the system; its load is exact in it.
    stored = [[Fraction(float(entry)) for entry in row] for row in matrix]
    load = [Fraction(float(1 + (7 * i) % 5)) for i in range(len(matrix))]
    exact = solved_exactly(stored, load)
    factor = make_solver("superlu", {}).factorise(csc_array(np.array(stored, dtype=float)))
    rhs = np.array(load, dtype=float)
    found = factor.solve(rhs)
    size = float(max(abs(x) for x in exact))
    error = float(max(abs(Fraction(x) - y) for x, y in zip(found, exact, strict=True))) / size
    foreseen = max(np.abs(change).max() for change in rounding_changes(factor, found, rhs)) / size
    # Below a rounding of the largest number nothing can be foreseen; luck may spare digits.
    assert error < 100 * foreseen + 1e-15
    assert foreseen < 1e4 * max(error, 1e-15)
