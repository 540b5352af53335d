"""LU on fronts: against dense algebra, and left to SuperLU where pivots are bad."""

import copy

import numpy as np
import pytest
from scipy.sparse import csc_array, csr_array, eye_array, kron, random_array

from integration.arrays import Floats
from nmm.solvers.frontal import symbolic
from nmm.solvers.frontal.cholesky import Cholesky
from nmm.solvers.frontal.lu import FrontalLU
from nmm.solvers.frontal.numbers import workspace
from nmm.solvers.libraries.superlu import SuperLU
from nmm.solvers.linear import LinearSolver, jacobi_scale, make_solver
from nmm.testing.solvers import is_cholesky, is_lu


def grid(side: int, per_node: int = 3, seed: int = 0) -> csc_array:
    """A diagonally dominant symmetric matrix of the graph of a grid."""
    line = eye_array(side, k=1) + eye_array(side, k=-1) if side > 1 else eye_array(1)
    graph = kron(line, eye_array(side)) + kron(eye_array(side), line) + eye_array(side**2)
    edges = csc_array(kron(graph, np.ones((per_node, per_node))))
    data = np.random.default_rng(seed).normal(size=edges.nnz)
    upper = csc_array((data, edges.indices, edges.indptr), edges.shape)
    matrix = csc_array(upper + upper.T)
    return csc_array(matrix + (1 + abs(matrix).sum(axis=0).max()) * eye_array(matrix.shape[0]))


def leaning(side: int, seed: int, lean: float, per_node: int = 3) -> csc_array:
    """Positive definite symmetric part and a random skew one on the same pattern."""
    matrix, rng = grid(side, per_node, seed), np.random.default_rng(seed)
    data = rng.normal(size=matrix.nnz) * np.abs(matrix.data).max()
    noise = csc_array((data, matrix.indices, matrix.indptr), matrix.shape)
    return csc_array(matrix + lean * (noise - noise.T))


def contacts(blocks: int, seed: int, spread: float) -> csc_array:
    """Blocks of six unknowns in a grid, springs of all sizes between them, drag of sliding ones.

    The form of the matrices of an interior point: ``K + Gn^T D Gn + Gt^T D Gt + Gt^T M Gn``.
    """
    rng = np.random.default_rng(seed)
    number = np.arange(blocks**2).reshape(blocks, blocks)
    pairs = np.concatenate(
        [
            np.stack([number[:, :-1].ravel(), number[:, 1:].ravel()], axis=1),
            np.stack([number[:-1].ravel(), number[1:].ravel()], axis=1),
        ]
    )
    pairs = np.repeat(pairs, 2, axis=0)  # two contact points each
    m, n = len(pairs), 6 * blocks**2
    column = (6 * pairs[:, :, None] + np.arange(6)).reshape(m, 12)
    index = np.arange(m).repeat(12), column.ravel()
    normal, shear = (csr_array((rng.normal(size=12 * m), index), shape=(m, n)) for _ in range(2))
    stiff = 10.0 ** rng.uniform(-spread, spread, (2, m))
    drag = rng.uniform(-0.6, 0.6, m) * stiff[0]
    springs = normal.T @ normal.multiply(stiff[0][:, None])
    springs = springs + shear.T @ shear.multiply(stiff[1][:, None])
    return csc_array(springs + shear.T @ normal.multiply(drag[:, None]) + eye_array(n))


def solved(matrix: csc_array, solver: LinearSolver) -> tuple[object, Floats, Floats]:
    load = np.random.default_rng(0).normal(size=matrix.shape[0])
    factor = solver.factorise(matrix)
    exact = np.linalg.solve(matrix.toarray(), load)
    return factor.decomposition, factor.solve(load), exact


@pytest.mark.parametrize("lean", [0.01, 0.3, 3.0])
@pytest.mark.parametrize("side", [1, 2, 5, 16])
def test_solution_of_an_unsymmetric_matrix_is_that_of_dense_algebra(side: int, lean: float) -> None:
    found, x, exact = solved(leaning(side, side, lean), FrontalLU())
    assert is_lu(found)
    # symmetric part with eigenvalues of about one, skew part up to ten times that: condition 1e2
    np.testing.assert_allclose(x, exact, rtol=1e-11, atol=1e-14)


@pytest.mark.parametrize("seed", range(5))
def test_pattern_that_is_not_symmetric_finds_room_in_that_of_its_symmetric_sum(seed: int) -> None:
    rng = np.random.default_rng(seed)
    n = int(rng.integers(5, 150))
    matrix = csc_array(random_array((n, n), density=3 / n, rng=rng) + 4 * eye_array(n))
    found, x, exact = solved(matrix, FrontalLU())
    assert is_lu(found)
    np.testing.assert_allclose(x, exact, rtol=1e-11, atol=1e-14)


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("spread", [1.0, 3.0])
def test_springs_of_sliding_contacts_leave_what_superlu_leaves(spread: float, seed: int) -> None:
    matrix = contacts(7, seed, spread)
    load = np.random.default_rng(seed).normal(size=matrix.shape[0])
    mine, other = (solver.factorise(matrix) for solver in (FrontalLU(), SuperLU().unsymmetric()))
    assert is_lu(mine.decomposition)
    rest = mine.relative_residual(mine.apply(load), load)
    # two stable eliminations in different orders: of one size, not equal
    assert rest < 100 * other.relative_residual(other.apply(load), load) + 1e-15
    refined = mine.relative_residual(mine.refined(load), load)
    assert refined < 10 * other.relative_residual(other.refined(load), load) + 1e-15


@pytest.mark.parametrize("name", ["auto", "cholesky", "lu"])
def test_rough_factors_are_of_single_precision(name: str) -> None:
    matrix, load = leaning(9, 1, 0.3), np.random.default_rng(0).normal(size=243)
    solver = make_solver(name).beside(compiled=True).unsymmetric().rough()
    found = solver.factorise(matrix).apply(load)
    exact = np.linalg.solve(matrix.toarray(), load)
    off = np.linalg.norm(found - exact) / np.linalg.norm(exact)
    # rounding of 6e-8 times a condition of about ten; double precision leaves 1e-15
    assert 1e-9 < off < 1e-5


def test_rough_factors_are_of_double_precision_where_single_leaves_too_much() -> None:
    # 200 masses in a row on springs of one that the ground holds by 1e-9 in all: condition 1e11,
    # of which single precision knows nothing
    line = eye_array(200, k=1) + eye_array(200, k=-1)
    matrix = csc_array((2.0 + 5e-12) * eye_array(200) - line).tolil()
    matrix[0, 0] = matrix[199, 199] = 1.0 + 5e-12
    found = FrontalLU().rough().decompose(csc_array(matrix))
    # a push of one on each moves all by one over the ground of each
    np.testing.assert_allclose(found.solve(np.ones(200)), 2e11, rtol=1e-3)


def test_pivots_are_exchanged_within_a_front() -> None:
    # No unknown has stiffness of its own before the other of its pair is eliminated.
    pairs = kron(eye_array(60), np.array([[0.0, 1.0], [-1.0, 0.0]]))
    near = kron(eye_array(60, k=1) + eye_array(60, k=-1), 0.1 * np.ones((2, 2)))
    matrix = csc_array(pairs + near)
    found = FrontalLU().decompose(matrix)
    load = np.random.default_rng(1).normal(size=120)
    assert is_lu(found)
    np.testing.assert_allclose(matrix @ found.solve(load), load, rtol=0, atol=1e-12)


@pytest.mark.parametrize("pivot", [0.0, 1e-300, 1e-14, 1e-11])
def test_small_pivots_that_nothing_stands_in_for_are_left_to_superlu(pivot: float) -> None:
    # Single unknowns coupled around the tree: elimination along it divides by the pivots alone.
    n = 80
    ring = eye_array(n, k=1) + eye_array(n, k=-1)
    corner = csc_array(([1.0, 1.0], ([0, n - 1], [n - 1, 0])), shape=(n, n))
    matrix = csc_array(csc_array(ring + 0.5 * corner) + pivot * eye_array(n))
    load = np.random.default_rng(2).normal(size=n)
    found = FrontalLU().decompose(matrix)
    assert not is_lu(found)
    x = np.linalg.solve(matrix.toarray(), load)
    np.testing.assert_allclose(found.solve(load), x, rtol=1e-9, atol=1e-11)


@pytest.mark.parametrize("name", ["auto", "cholesky", "lu"])
def test_saddle_points_are_solved_by_the_unsymmetric_settings_too(name: str) -> None:
    k, rng = grid(6).toarray(), np.random.default_rng(3)
    rows = rng.normal(size=(5, len(k)))
    matrix = csc_array(np.block([[k, rows.T], [rows, np.zeros((5, 5))]]))
    _, x, exact = solved(matrix, make_solver(name).unsymmetric())
    np.testing.assert_allclose(x, exact, rtol=1e-9, atol=1e-12)


def test_symmetric_matrix_with_good_pivots_of_both_signs_stays_on_the_fronts() -> None:
    matrix = grid(9)
    sign = np.where(np.arange(matrix.shape[0]) % 7 == 0, -1.0, 1.0)
    # Strong diagonal with a sign: all pivots are good, a tenth of them negative.
    flipped = csc_array(matrix + 3 * csc_array(np.diag((sign - 1) * matrix.diagonal())))
    found, x, exact = solved(flipped, Cholesky())
    assert is_lu(found)
    np.testing.assert_allclose(x, exact, rtol=1e-11, atol=1e-14)


def test_several_loads_at_once_are_solved_one_by_one() -> None:
    matrix = leaning(5, 1, 0.5)
    found = FrontalLU().decompose(matrix)
    loads = np.random.default_rng(1).normal(size=(matrix.shape[0], 3))
    np.testing.assert_array_equal(found.solve(loads)[:, 1], found.solve(loads[:, 1]))


def test_numbers_of_a_factor_outlive_later_factorisations() -> None:
    matrix = leaning(8, 5, 0.3)
    first = FrontalLU().decompose(matrix)
    twin = copy.copy(first)
    load = np.random.default_rng(6).normal(size=matrix.shape[0])
    before = first.solve(load)
    del first
    for turn in range(6):
        for solver in (FrontalLU(), Cholesky()):
            solver.decompose(csc_array((2.0 + turn) * grid(8)))
    np.testing.assert_array_equal(twin.solve(load), before)


def test_room_of_a_factor_that_is_gone_is_used_again() -> None:
    matrix = grid(20, 6)  # more numbers than the allocator keeps for itself
    workspace.SPARE.clear()  # room that others left is taken first
    found = FrontalLU().decompose(matrix)
    assert is_lu(found)
    place = found.panels.numbers.ctypes.data
    del found
    again = [FrontalLU().decompose(matrix) for _ in range(2)]
    assert place in [one.panels.numbers.ctypes.data for one in again]


def test_one_plan_serves_both_factorisations_and_cholesky_still_looks_at_the_numbers() -> None:
    symbolic.PLANS.clear()
    symmetric, other = grid(6), leaning(6, 0, 0.3)
    np.testing.assert_array_equal(symmetric.indices, other.indices)
    assert is_lu(FrontalLU().decompose(other))
    for _ in range(2):
        assert not is_cholesky(Cholesky().decompose(other))
    assert is_cholesky(Cholesky().decompose(symmetric))
    assert len(symbolic.PLANS) == 1


def test_units_of_unknowns_do_not_matter_to_unsymmetric_matrices() -> None:
    matrix = leaning(6, 2, 0.3)
    units = 10.0 ** np.random.default_rng(2).integers(-6, 7, matrix.shape[0])
    scaled = csc_array(matrix.multiply(units[:, None]).multiply(units[None, :]))
    rhs = np.random.default_rng(3).normal(size=len(units))
    plain = FrontalLU().factorise(matrix).solve(rhs)
    x = FrontalLU().factorise(scaled).solve(units * rhs) * units
    np.testing.assert_allclose(x, plain, rtol=1e-10)
    # powers of ten are not powers of two: scales round
    np.testing.assert_allclose(jacobi_scale(scaled) * units, jacobi_scale(matrix), rtol=1e-14)
