"""Every enforcement against the enumeration of all contact states, and against the law's words."""

from pathlib import Path

import numpy as np
import pytest

from nmm.contact.enforcement.base import ENFORCEMENTS, make_enforcement
from nmm.contact.problem.balance import relative_residual
from nmm.contact.problem.cut_springs import CutSprings
from nmm.contact.problem.matrix_pattern import SpringPattern
from nmm.solvers.linear import make_solver
from nmm.testing import check_enforcement, check_smooth_enforcement
from nmm.testing.contact_oracle import all_solutions, is_one_of, obeys, random_problem
from nmm.testing.enforcements import balance

SOFT = {"penalty"}
SMOOTH = {"barrier"}
SHARP = sorted(set(ENFORCEMENTS.names()) - SMOOTH)


@pytest.mark.parametrize("name", SHARP)
def test_an_enforcement_keeps_what_every_one_promises(name: str) -> None:
    check_enforcement(make_enforcement(name))


def test_the_barrier_tends_to_an_exact_solution_with_its_width() -> None:
    check_smooth_enforcement(lambda width: make_enforcement("barrier", {"width": width}))


@pytest.mark.parametrize("seed", range(60))
def test_open_close_iteration_never_claims_a_state_that_is_not_one(seed: int) -> None:
    problem = random_problem(seed, bonded=seed % 2 == 0)
    options = {"iteration": "open_close", "max_passes": 50}
    answer = make_enforcement("penalty", options).solve(problem, make_solver())
    if answer.verdict.converged:
        assert is_one_of(answer, all_solutions(problem, exact=False), 1e-6)
    else:
        assert answer.verdict.code in ("cycle", "passes")
        assert answer.verdict.contacts or answer.verdict.code == "passes"


@pytest.mark.parametrize("seed", range(8))
def test_compiled_defect_equals_the_whole_array_form(seed: int) -> None:
    problem, rng = random_problem(seed, bonded=True), np.random.default_rng(seed)
    shifts = rng.normal(size=(2, problem.n_contacts))
    springs = CutSprings.of(problem).shifted(shifts)
    increment = rng.normal(size=len(problem.force))
    forces = springs.forces(increment)
    expected = problem.out_of_balance(increment, *forces)
    found = springs.residual(increment)
    np.testing.assert_allclose(found.force, expected, rtol=0, atol=1e-12 * np.abs(expected).max())
    size = relative_residual(problem, springs.weight, increment, *forces)
    assert found.size == pytest.approx(size, rel=1e-12)


@pytest.mark.parametrize("name", ["penalty", "augmented", "lagrange", "cone"])
def test_steps_of_a_wall_converge_though_bricks_have_more_contacts_than_unknowns(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.syspath_prepend(str(Path(__file__).parents[4] / "benchmarks"))
    from block_scenes import Motion, wall

    from nmm.contact.iteration.memory import Memory

    motion, memory, solver = Motion(wall(30, penalty=100.0)), Memory(), make_solver()
    problem = motion.problem
    for _ in range(4):
        answer = make_enforcement(name).solve(problem, solver, memory)
        assert answer.verdict.converged, answer.verdict.sentence
        size = float(np.abs(answer.normal_force).max())
        ease = 1 / problem.matrix.diagonal().min()
        # forces meet the law to 1e-7 of the largest; gaps to 1e-7 of what that would press in,
        # over rows of three entries of about one on either side
        assert obeys(problem, answer, name not in SOFT, 1e-6 * size, 6e-7 * size * ease)
        assert balance(problem, answer) < 1e-6
        problem = motion.next_problem(answer)


@pytest.mark.parametrize("seed", range(8))
def test_assembled_pattern_equals_the_sparse_product(seed: int) -> None:
    problem, rng = random_problem(seed), np.random.default_rng(seed)
    normal, shear = rng.random((2, problem.n_contacts))
    found = SpringPattern.of(problem).matrix(problem, normal, shear)
    expected = problem.matrix.toarray()
    for rows, stiffness in ((problem.normal_rows, normal), (problem.tangent_rows, shear)):
        expected += rows.T @ (stiffness[:, None] * rows.toarray())
    np.testing.assert_allclose(found.toarray(), expected, rtol=0, atol=1e-12)
