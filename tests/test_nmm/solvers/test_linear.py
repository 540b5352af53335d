"""Linear solvers behind one interface: the suite of all, refinement, options."""

from collections.abc import Callable

import numpy as np
import pytest
from scipy.sparse import csc_array, eye_array

import nmm
from integration.arrays import Floats
from nmm.errors import FormulationError, SolveError
from nmm.solvers.factor import PIVOT
from nmm.solvers.libraries.optional import MUMPS, QDLDL
from nmm.solvers.linear import SOLVERS, Factor, make_solver
from nmm.testing import check_solver
from nmm.testing.solvers import free_row

# Solvers of other packages are tested where these are installed and load.
NEEDS = {"qdldl": QDLDL, "mumps": MUMPS}
NAMES = [name for name in SOLVERS.names() if name not in NEEDS or NEEDS[name].loads]


@pytest.fixture(params=NAMES)
def solver_name(request: pytest.FixtureRequest) -> str:
    return str(request.param)


def test_every_built_in_solver_is_tested_here() -> None:
    assert {"auto", "cholesky", "lu", "superlu", "dense"} <= set(NAMES)


@pytest.mark.parametrize("unknowns", [10, 10**6])
def test_a_solver_says_what_it_factorises_with(solver_name: str, unknowns: int) -> None:
    said = make_solver(solver_name).describe(unknowns)
    assert said.startswith(solver_name)
    if solver_name == "auto":
        assert ("dense" if unknowns == 10 else "cholesky with orders of") in said


def test_a_solver_keeps_what_every_solver_promises(solver_name: str) -> None:
    check_solver(make_solver(solver_name))


def test_load_on_a_free_motion_is_refused_by_its_size(solver_name: str) -> None:
    factor = make_solver(solver_name).factorise(free_row(80))
    with pytest.raises(SolveError, match="linear system of 80 unknowns: residual .* unknown"):
        factor.solve(np.ones(80))


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
    matrix = csc_array(free_row(n) + 1e-9 * eye_array(n))  # condition 1e12
    inverse = Counted(matrix, size)
    factor = Factor(make_solver("superlu", {"refinements": 3}), matrix, np.ones(n), inverse)
    factor.refined(np.ones(n))
    assert inverse.count == solves


@pytest.mark.parametrize("soft", [1e-2, 1e-4, 1e-6])
def test_one_correction_takes_what_the_shift_of_every_matrix_leaves_to_rounding(
    soft: float,
) -> None:
    n = 40
    matrix = csc_array(free_row(n) / 2 + soft * eye_array(n))
    inverse = Counted(csc_array(matrix + PIVOT * eye_array(n)), 1.0)
    factor = Factor(make_solver("superlu", {"refinements": 3}), matrix, np.ones(n), inverse)
    load = np.random.default_rng(0).normal(size=n)
    x = factor.refined(load)
    assert inverse.count == 2
    # A rounding of the terms of a row, up to twice the solution, and one of their sum.
    assert np.linalg.norm(load - matrix @ x) <= 4 * 2.0**-53 * np.linalg.norm(x)


def test_unknown_solver_and_option_are_refused() -> None:
    with pytest.raises(FormulationError, match="superlu"):
        make_solver("superl")
    with pytest.raises(FormulationError, match="refinements"):
        make_solver("superlu", {"refinement": 2})


def test_the_summary_of_a_run_names_its_solver(bar_text: Callable[..., str]) -> None:
    scene = nmm.parse_scene(bar_text(poisson=0.0, more='[formulation.solver]\ntype = "superlu"\n'))
    assert nmm.run(scene).summary.linear_solver == "superlu"
