"""What every linear solver is held to."""

import numpy as np
from scipy.sparse import csc_array, eye_array, kron, random_array

from integration.arrays import Floats
from nmm.errors import SolveError
from nmm.solvers.factor import Decomposition
from nmm.solvers.frontal.frontal_factor import FrontalFactor
from nmm.solvers.linear import LinearSolver
from nmm.testing.claims import claim, close


def check_solver(solver: LinearSolver, seed: int = 0) -> None:
    """Hold a linear solver to what every one promises.

    Solutions are those of dense algebra, on patterns of grids and scattered ones, for new values
    on a known pattern, for saddle points and matrices that are not positive definite; units of
    unknowns do not matter; a free motion is solved for loads that leave it alone and refused by
    name for others; numbers that are not finite are refused; condition numbers are estimated.

    Raises
    ------
    AssertionError
        Naming the property that is not kept, by how much, and what was tolerated.
    """
    name = type(solver).__name__
    for side in (1, 2, 3, 7, 16):
        _dense(solver, name, side)
    for one in range(seed, seed + 5):
        _scattered(solver, name, one)
    _units(solver, name, seed)
    _again(solver, name)
    _indefinite(solver, name, seed)
    _free(solver, name)
    _not_finite(solver, name)
    for condition in (1e2, 1e6):
        _condition(solver, name, condition)


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


def free_row(n: int) -> csc_array:
    """Springs of stiffness 1 in a free row: constant motions cost nothing."""
    dense = 2 * np.eye(n) - np.diag(np.ones(n - 1), 1) - np.diag(np.ones(n - 1), -1)
    dense[0, 0] = dense[-1, -1] = 1.0
    return csc_array(dense)


def _dense(solver: LinearSolver, name: str, side: int) -> None:
    matrix = grid(side)
    rhs = np.random.default_rng(1).normal(size=matrix.shape[0])
    factor = solver.factorise(matrix)
    expected = np.linalg.solve(matrix.toarray(), rhs)
    size = float(np.abs(expected).max())
    what = f"{name}: solution of {len(rhs)} unknowns against dense algebra"
    close(what, factor.solve(rhs), expected, 1e-12 * size, "condition below 10: rounding alone")
    left = factor.relative_residual(expected, rhs)
    claim(left < 1e-14, f"{name}: relative_residual of the solution {left:.3g}, expected < 1e-14")


def _scattered(solver: LinearSolver, name: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    n = int(rng.integers(5, 120))
    half = random_array((n, n), density=min(1.0, 4 / n), rng=rng)
    matrix = csc_array(half @ half.T + 0.1 * eye_array(n))
    rhs = rng.normal(size=n)
    x = solver.factorise(matrix).solve(rhs)
    close(f"{name}: residual on a scattered pattern", np.asarray(matrix @ x), rhs, 1e-10)


def _units(solver: LinearSolver, name: str, seed: int) -> None:
    matrix, rng = grid(6), np.random.default_rng(seed + 2)
    units = 10.0 ** rng.integers(-6, 7, matrix.shape[0])
    scaled = csc_array(matrix.multiply(units[:, None]).multiply(units[None, :]))
    rhs = rng.normal(size=len(units))
    plain = solver.factorise(matrix).solve(rhs)
    found = solver.factorise(scaled).solve(units * rhs) * units
    close(f"{name}: solution in other units", found / plain, 1.0, 1e-11)


def _again(solver: LinearSolver, name: str) -> None:
    rhs = np.ones(192)
    for factor in (1.0, 2.0, 3.0):
        matrix = grid(8)
        matrix.data = factor * matrix.data
        x = solver.factorise(matrix).solve(rhs)
        close(f"{name}: new values on a known pattern", matrix @ x, rhs, 1e-12)


def _indefinite(solver: LinearSolver, name: str, seed: int) -> None:
    rng, dense = np.random.default_rng(seed + 4), grid(6).toarray()
    rows = rng.normal(size=(5, len(dense)))
    saddle = np.block([[dense, rows.T], [rows, np.zeros((5, 5))]])
    rhs = rng.normal(size=len(saddle))
    found = solver.indefinite().factorise(csc_array(saddle)).solve(rhs)
    _as_dense(f"{name}: saddle point by indefinite()", found, saddle, rhs)
    dense[3, 3] = -dense[3, 3]
    found = solver.factorise(csc_array(dense)).solve(np.ones(len(dense)))
    _as_dense(f"{name}: matrix not positive definite", found, dense, np.ones(len(dense)))


def _as_dense(what: str, found: Floats, dense: Floats, rhs: Floats) -> None:
    expected = np.linalg.solve(dense, rhs)
    close(f"{what}: solution", found, expected, 1e-9 * float(np.abs(expected).max()))


def _free(solver: LinearSolver, name: str) -> None:
    factor, rhs = solver.factorise(free_row(80)), np.zeros(80)
    rhs[0], rhs[-1] = -1.0, 1.0
    # Stretch between neighbours is one; the free motion itself may have any size.
    close(f"{name}: load that leaves a free motion alone", np.diff(factor.solve(rhs)), 1.0, 1e-6)
    _refused(f"{name}: a load on a free motion", solver, free_row(80), "unknown")
    alone = csc_array(np.diag([1.0] * 70 + [0.0]))
    _refused(f"{name}: a load on an unknown without stiffness", solver, alone, "unknown 70")


def _not_finite(solver: LinearSolver, name: str) -> None:
    matrix = grid(3)
    matrix.data[5] = np.nan
    _refused(f"{name}: a matrix with nan", solver, matrix, "not finite")


def _refused(what: str, solver: LinearSolver, matrix: csc_array, word: str) -> None:
    try:
        found = solver.factorise(matrix).solve(np.ones(matrix.shape[0]))
    except SolveError as fault:
        claim(word in str(fault), f'{what} is refused by "{fault}": expected "{word}" in it')
    else:
        size = float(np.abs(found).max())
        raise AssertionError(f"{what} is solved, by up to {size:.3g}: expected a SolveError")


def _condition(solver: LinearSolver, name: str, condition: float) -> None:
    rng = np.random.default_rng(3)
    q, _ = np.linalg.qr(rng.normal(size=(70, 70)))
    dense = q @ np.diag(np.geomspace(1, condition, 70)) @ q.T
    matrix = csc_array((dense + dense.T) / 2)
    scale = 1 / np.sqrt(matrix.diagonal())
    expected = float(np.linalg.cond(scale[:, None] * dense * scale, 1))
    found = solver.factorise(matrix).condition()
    # A lower bound, rarely more than 3 times too small (Higham, Tisseur 2000).
    claim(
        expected / 3 < found < 1.01 * expected,
        f"{name}: condition estimate {found:.3g}, expected between {expected / 3:.3g} and "
        f"{expected:.3g}",
    )


def is_cholesky(found: Decomposition) -> bool:
    """Whether a decomposition is Cholesky's on fronts."""
    return isinstance(found, FrontalFactor) and found.symmetric


def is_lu(found: Decomposition) -> bool:
    """Whether a decomposition is LU on fronts."""
    return isinstance(found, FrontalFactor) and not found.symmetric
