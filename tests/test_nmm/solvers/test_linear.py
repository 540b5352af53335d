"""Linear solvers behind one interface, against dense algebra."""

import numpy as np
import pytest
from scipy.sparse import csc_array, eye_array, kron, random_array

from integration.arrays import Floats
from nmm.errors import FormulationError, SolveError
from nmm.solvers.linear import SOLVERS, Factor, make_solver

NAMES = SOLVERS.names()


def grid(side: int, per_node: int = 3, seed: int = 0) -> csc_array:
    """A positive definite matrix of the graph of a grid, blocks of ``per_node`` unknowns."""
    rng = np.random.default_rng(seed)
    line = csc_array(np.eye(side, k=1) + np.eye(side, k=-1))
    graph = kron(line, eye_array(side)) + kron(eye_array(side), line)
    edges = csc_array(kron(graph, np.ones((per_node, per_node))))
    upper = csc_array((rng.normal(size=edges.nnz), edges.indices, edges.indptr), edges.shape)
    matrix = upper + upper.T
    blocks = csc_array(kron(eye_array(side**2), np.ones((per_node, per_node))))
    return csc_array(
        matrix + blocks + eye_array(matrix.shape[0]) * (1 + abs(matrix).sum(axis=0).max())
    )


@pytest.fixture(params=NAMES)
def solver_name(request: pytest.FixtureRequest) -> str:
    if request.param == "qdldl":
        pytest.importorskip("qdldl")
    return str(request.param)


@pytest.mark.parametrize("side", [1, 2, 3, 7, 16])
def test_solution_matches_dense_algebra(solver_name: str, side: int) -> None:
    matrix = grid(side)
    rhs = np.random.default_rng(1).normal(size=matrix.shape[0])
    factor = make_solver(solver_name).factorise(matrix)
    expected = np.linalg.solve(matrix.toarray(), rhs)
    # condition number below 10: rounding alone
    np.testing.assert_allclose(factor.solve(rhs), expected, rtol=1e-12, atol=1e-14)
    assert factor.relative_residual(expected, rhs) < 1e-14


@pytest.mark.parametrize("seed", range(5))
def test_scattered_patterns_are_ordered_and_solved(solver_name: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    n = int(rng.integers(5, 120))
    half = random_array((n, n), density=min(1.0, 4 / n), rng=rng)
    matrix = csc_array(half @ half.T + 0.1 * eye_array(n))
    rhs = rng.normal(size=n)
    x = make_solver(solver_name).factorise(matrix).solve(rhs)
    np.testing.assert_allclose(matrix @ x, rhs, rtol=0, atol=1e-10)


def test_units_of_unknowns_do_not_matter(solver_name: str) -> None:
    matrix, rng = grid(6), np.random.default_rng(2)
    units = 10.0 ** rng.integers(-6, 7, matrix.shape[0])
    scaled = csc_array(matrix.multiply(units[:, None]).multiply(units[None, :]))
    rhs = rng.normal(size=len(units))
    plain = make_solver(solver_name).factorise(matrix).solve(rhs)
    np.testing.assert_allclose(
        make_solver(solver_name).factorise(scaled).solve(units * rhs) * units, plain, rtol=1e-11
    )


def test_new_values_on_a_known_pattern_are_factorised_anew(solver_name: str) -> None:
    solver, rhs = make_solver(solver_name), np.ones(192)
    for seed in range(3):
        matrix = grid(8, seed=0)
        matrix.data = matrix.data * (1 + seed)
        x = solver.factorise(matrix).solve(rhs)
        np.testing.assert_allclose(matrix @ x, rhs, rtol=1e-12)


def path(n: int) -> csc_array:
    """Springs of stiffness 1 in a free row: constant motions cost nothing."""
    dense = 2 * np.eye(n) - np.diag(np.ones(n - 1), 1) - np.diag(np.ones(n - 1), -1)
    dense[0, 0] = dense[-1, -1] = 1.0
    return csc_array(dense)


def test_load_on_a_free_motion_is_refused_by_name(solver_name: str) -> None:
    factor = make_solver(solver_name).factorise(path(80))
    with pytest.raises(SolveError, match="linear system of 80 unknowns: residual .* unknown"):
        factor.solve(np.ones(80))


def test_load_that_leaves_the_free_motion_alone_is_solved(solver_name: str) -> None:
    rhs = np.zeros(80)
    rhs[0], rhs[-1] = -1.0, 1.0
    x = make_solver(solver_name).factorise(path(80)).solve(rhs)
    np.testing.assert_allclose(np.diff(x), 1.0, rtol=1e-6)


def test_free_unknown_without_stiffness_is_refused(solver_name: str) -> None:
    matrix = csc_array(np.diag([1.0] * 70 + [0.0]))
    factor = make_solver(solver_name).factorise(matrix)
    with pytest.raises(SolveError, match="unknown 70"):
        factor.solve(np.ones(71))


def test_matrix_with_numbers_that_are_not_finite_is_refused(solver_name: str) -> None:
    matrix = grid(3)
    matrix.data[5] = np.nan
    with pytest.raises(SolveError, match="not finite"):
        make_solver(solver_name).factorise(matrix)


@pytest.mark.parametrize("condition", [1e2, 1e6])
def test_condition_estimate_is_near_the_condition_number(
    solver_name: str, condition: float
) -> None:
    rng = np.random.default_rng(3)
    q, _ = np.linalg.qr(rng.normal(size=(70, 70)))
    dense = q @ np.diag(np.geomspace(1, condition, 70)) @ q.T
    matrix = csc_array((dense + dense.T) / 2)
    scale = 1 / np.sqrt(matrix.diagonal())
    expected = np.linalg.cond(scale[:, None] * dense * scale, 1)
    # the estimate is a lower bound, rarely more than 3 times too small (Higham, Tisseur 2000)
    found = make_solver(solver_name).factorise(matrix).condition()
    assert expected / 3 < found < 1.01 * expected


def test_saddle_point_matrix_is_solved_by_the_indefinite_settings(solver_name: str) -> None:
    rng, k = np.random.default_rng(4), grid(6).toarray()
    rows = rng.normal(size=(5, len(k)))
    dense = np.block([[k, rows.T], [rows, np.zeros((5, 5))]])
    rhs = rng.normal(size=len(dense))
    x = make_solver(solver_name).indefinite().factorise(csc_array(dense)).solve(rhs)
    np.testing.assert_allclose(x, np.linalg.solve(dense, rhs), rtol=1e-9, atol=1e-12)


def test_matrix_that_is_not_positive_definite_is_still_solved(solver_name: str) -> None:
    dense = grid(6).toarray()
    dense[3, 3] = -dense[3, 3]
    rhs: Floats = np.ones(len(dense))
    x = make_solver(solver_name).factorise(csc_array(dense)).solve(rhs)
    np.testing.assert_allclose(x, np.linalg.solve(dense, rhs), rtol=1e-9, atol=1e-12)


class Counted:
    """Inverse of a matrix times ``size``, which counts how often it is asked."""

    def __init__(self, matrix: csc_array, size: float) -> None:
        self.matrix, self.size, self.count = matrix.toarray(), size, 0

    def solve(self, rhs: Floats) -> Floats:
        self.count += 1
        return np.asarray(self.size * np.linalg.solve(self.matrix, rhs))


@pytest.mark.parametrize(("size", "solves"), [(0.9, 4), (1.0, 2)])
def test_refinement_goes_on_while_turns_take_off_half_of_the_residual(
    size: float, solves: int
) -> None:
    # Factors off by a tenth leave a tenth after every turn; exact ones leave rounding at once.
    n = 40
    matrix = csc_array(path(n) + 1e-9 * eye_array(n))  # condition 1e12
    inverse = Counted(matrix, size)
    factor = Factor(make_solver("superlu", {"refinements": 3}), matrix, np.ones(n), inverse)
    factor.refined(np.ones(n))
    assert inverse.count == solves


def test_unknown_solver_and_option_are_refused() -> None:
    with pytest.raises(FormulationError, match="superlu"):
        make_solver("superl")
    with pytest.raises(FormulationError, match="refinements"):
        make_solver("superlu", {"refinement": 2})
