"""Anderson acceleration: as many steps as a linear map has dimensions, however it contracts."""

import numpy as np
import pytest

from nmm.solvers.anderson import Anderson, FixedPoint


def fixed_point_steps(matrix: np.ndarray, load: np.ndarray, tolerance: float) -> int:
    """Evaluations until ``x = matrix x + load`` holds within ``tolerance``; at most 200."""
    iteration, x = FixedPoint(), np.zeros(len(load))
    for count in range(1, 200):
        image = matrix @ x + load
        if np.abs(image - x).max() <= tolerance:
            exact = np.linalg.solve(np.eye(len(load)) - matrix, load)
            # the error is the residual times the inverse of 1 - matrix, at most 10 here
            np.testing.assert_allclose(x, exact, atol=20 * tolerance)
            return count
        x = iteration.next(x, image)
    return 200


@pytest.mark.parametrize("seed", range(5))
def test_a_linear_map_of_few_dimensions_is_solved_in_about_as_many_steps(seed: int) -> None:
    rng = np.random.default_rng(seed)
    basis = np.linalg.qr(rng.normal(size=(4, 4)))[0]
    matrix = basis @ np.diag([0.9, 0.7, -0.5, 0.2]) @ basis.T
    load = rng.normal(size=4)
    # 1 + 4 differences, some more as least squares are regular to 1e-6 of a step only; plain
    # iteration takes log(1e-9) / log(0.9) = 197
    assert fixed_point_steps(matrix, load, 1e-9) <= 12


def test_a_map_that_expands_is_solved_too() -> None:
    matrix = np.diag([-3.0, 0.5])
    assert fixed_point_steps(matrix, np.array([1.0, 1.0]), 1e-9) <= 8


def test_the_oldest_difference_makes_room() -> None:
    history = Anderson(2)
    history.start(3)
    corrections = np.eye(3)
    for k in range(3):
        zero = np.zeros(3)
        history.add(corrections[k], corrections[k], zero, -corrections[k], zero)
    # of three orthogonal differences the first is forgotten: its part of a correction stays
    step = history.mixed(np.ones(3), -np.ones(3))
    np.testing.assert_allclose(step - np.array([1.0, 0.0, 0.0]), [0.0, -1.0, -1.0], atol=1e-9)


def test_mixing_is_least_squares_in_the_inner_product_of_the_factor() -> None:
    rng, n, used = np.random.default_rng(0), 40, 4
    root = rng.normal(size=(n, n))
    inner = root @ root.T + np.eye(n)
    steps, residuals = rng.normal(size=(used, n)), rng.normal(size=(used, n))
    corrections = -np.linalg.solve(inner, residuals.T).T
    history, zero = Anderson(used), np.zeros(n)
    history.start(n)
    for k in range(used):
        history.add(steps[k], corrections[k], zero, residuals[k], zero)
    force = rng.normal(size=n)
    correction = -np.linalg.solve(inner, force)
    found = history.mixed(correction, force)
    # least |correction - sum share correction_k| in the norm of the matrix, by its own root
    upper = np.linalg.cholesky(inner).T
    share = np.linalg.lstsq(upper @ corrections.T, upper @ correction, rcond=None)[0]
    expected = correction - share @ (steps + corrections)
    # the ridge of 1e-12 of the trace moves shares by as much times the condition, below 1e3
    np.testing.assert_allclose(found, expected, atol=1e-8 * np.abs(expected).max())
