"""The scalar product in partial sums."""

from math import fsum

import numpy as np
import pytest

from nmm.solvers.kernels.dot import dot


@pytest.mark.parametrize("n", [0, 1, 7, 8, 1001])
def test_is_the_exact_sum_of_products_to_rounding(n):
    one, other = np.random.default_rng(n).normal(size=(2, n))
    exact = fsum(one * other)
    # Rounding of n products and sums, each of at most the sum of sizes.
    assert dot(one, other) == pytest.approx(exact, abs=1e-16 * (n + 1) * fsum(abs(one * other)))
