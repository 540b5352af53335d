"""The barrier on piles: every step converges, no wall is crossed, forces near the exact ones."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from nmm.contact.barrier.curve import Curves
from nmm.contact.barrier.potential import Potential
from nmm.contact.enforcement.base import make_enforcement
from nmm.contact.iteration.memory import Memory
from nmm.contact.iteration.multiplier_rounds import compliances
from nmm.contact.problem.step_problem import StepProblem
from nmm.solvers.linear import make_solver
from nmm.testing.contact_oracle import make_problem, random_problem

BENCHMARKS = str(Path(__file__).parents[4] / "benchmarks")


def resultants(problem: StepProblem, normal: np.ndarray, shear: np.ndarray) -> np.ndarray:
    return np.asarray(problem.normal_rows.T @ normal + problem.tangent_rows.T @ shear)


@pytest.mark.parametrize("blocks", [40, pytest.param(100, marks=pytest.mark.slow)])
def test_every_step_of_a_pile_converges_within_its_walls(
    blocks: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.syspath_prepend(BENCHMARKS)
    from block_scenes import Motion, pile

    motion, memory, solver = Motion(pile(blocks, 10.0)), Memory(), make_solver()
    problem = motion.problem
    for _ in range(3):
        answer = make_enforcement("barrier").solve(problem, solver, memory)
        assert answer.verdict.converged, answer.verdict.sentence
        # blocks start at zero gap; gaps are recomputed here, not read from the answer
        gap = problem.gap + problem.normal_rows @ answer.increment
        assert memory.barrier_width is not None
        assert gap.min() > -memory.barrier_width / 2
        # Coulomb's law on the forces: no pull, no shear above friction
        assert answer.normal_force.max() <= 0.0
        bound = -problem.limits.friction * answer.normal_force
        assert (np.abs(answer.shear_force) <= bound * (1 + 1e-12)).all()
        problem = motion.next_problem(answer)


@pytest.mark.parametrize("width", [1e-1, 1e-3, 1e-6])
@pytest.mark.parametrize("seed", range(20))
def test_no_step_crosses_a_wall_whether_it_converges_or_not(seed: int, width: float) -> None:
    problem = random_problem(seed, bonded=False)
    problem = replace(problem, gap=np.abs(problem.gap))
    for most in (1, 2, 100):  # cut short, the increment is where an iteration stood
        options = {"width": width, "max_passes": most}
        answer = make_enforcement("barrier", options).solve(problem, make_solver())
        gap = problem.gap + problem.normal_rows @ answer.increment
        assert gap.min() > -width / 2


def test_resultants_of_a_smooth_pile_are_the_exact_ones_within_the_width(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.syspath_prepend(BENCHMARKS)
    from block_scenes import Motion, pile

    problem = Motion(pile(40, 10.0, friction=0.0)).problem
    # without friction the step is a convex problem: increment and resultants are unique
    exact = make_enforcement("cone").solve(problem, make_solver())
    found = make_enforcement("barrier").solve(problem, make_solver())
    assert exact.verdict.converged
    assert found.verdict.converged, found.verdict.sentence
    expected = resultants(problem, exact.normal_force, exact.shear_force)
    error = resultants(problem, found.normal_force, found.shear_force) - expected
    # a gap of half a width is 1/2000 of the largest force in the compliance of one contact
    assert np.linalg.norm(error) < 2e-3 * np.linalg.norm(expected)


def test_stiffnesses_are_the_derivatives_of_the_forces() -> None:
    problem = random_problem(3)
    width = 1e-2
    problem = replace(problem, gap=np.zeros(problem.n_contacts))
    problem = replace(
        problem, limits=replace(problem.limits, friction=np.full(problem.n_contacts, 0.6))
    )
    well, h = Potential(problem, width, 50.0), 1e-8
    gap = np.linspace(-0.4, 0.4, problem.n_contacts) * width
    slip = np.linspace(-0.7, 0.6, problem.n_contacts) * width  # first and last ones slide
    at = well.pull(gap, slip)
    opened, closed = well.pull(gap + h, slip), well.pull(gap - h, slip)
    over, under = well.pull(gap, slip + h), well.pull(gap, slip - h)
    # central differences: h^2 f''' ~ 1e-8, rounding eps f / h ~ 1e-8
    for part, ahead, behind, name in (
        (at.normal_stiffness, opened, closed, "normal"),
        (at.mixed_stiffness, opened, closed, "shear"),
        (at.shear_stiffness, over, under, "shear"),
    ):
        slope = (getattr(ahead, name) - getattr(behind, name)) / (2 * h)
        np.testing.assert_allclose(part, slope, rtol=1e-5, atol=1e-5)


def test_forces_are_the_slopes_of_the_energy_they_store() -> None:
    problem, width = frictional(3), 1e-2
    well, h = Potential(problem, width, 50.0), 1e-8
    random = np.random.default_rng(1)
    gap = random.uniform(-0.45, 0.45, problem.n_contacts) * width
    slip = random.uniform(-0.45, 0.45, problem.n_contacts) * width
    still = np.zeros_like(slip)
    direction = random.normal(size=len(gap))
    # Along gaps without slip, then along slips, which are elastic below half a width.
    pressed = (
        well.stored(gap + h * direction, still) - well.stored(gap - h * direction, still)
    ) / 2
    assert pressed / h == pytest.approx(float(well.normal(gap)[0] @ direction), rel=1e-6)
    slipped = (well.stored(gap, slip + h * direction) - well.stored(gap, slip - h * direction)) / 2
    assert slipped / h == pytest.approx(float(well.pull(gap, slip).shear @ direction), rel=1e-6)


def test_contact_that_starts_deep_comes_out_and_is_counted() -> None:
    problem = make_problem(np.eye(2), [0.0, -1.0], [[0.0, 1.0]], [[1.0, 0.0]], gap=[-0.5])
    answer = make_enforcement("barrier", {"width": 1e-3}).solve(problem, make_solver())
    assert answer.verdict.converged
    assert "1 contacts began deeper" in answer.verdict.sentence
    assert -0.5 < answer.gap[0] < -0.5 + 1e-3  # its wall stands where it was


def test_part_that_nothing_holds_is_found_in_few_factorisations() -> None:
    problem = make_problem(np.zeros((2, 2)), [0.0, 5.0], [[0.0, 1.0]], [[1.0, 0.0]])
    answer = make_enforcement("barrier", {"max_passes": 100}).solve(problem, make_solver())
    assert answer.verdict.code == "singular"
    # two friction bounds of 100 steps each and one coupled iteration
    assert answer.factorisations < 240


@pytest.mark.parametrize("power", [-3, 0, 3])
def test_default_width_scales_with_force_and_compliance(power: int) -> None:
    problem = make_problem(
        10.0**power * np.eye(2), [0.0, -1.0], [[0.0, 1.0]], [[1.0, 0.0]], penalty=10.0**power
    )
    memory = Memory()
    answer = make_enforcement("barrier").solve(problem, make_solver(), memory)
    assert answer.verdict.converged, answer.verdict.sentence
    ease = float(compliances(problem)[0][0])
    assert ease == pytest.approx(10.0**-power)
    assert memory.barrier_width is not None
    # the rough springs have the stiffness 1/c of the block: they carry half of the unit load
    assert memory.barrier_width == pytest.approx(0.5e-3 * ease, rel=1e-6)


def test_width_is_not_kept_from_a_step_without_contact() -> None:
    problem = make_problem(np.eye(2), [0.0, 1.0], [[0.0, 1.0]], [[1.0, 0.0]], gap=[5.0])
    memory = Memory()
    answer = make_enforcement("barrier").solve(problem, make_solver(), memory)
    assert answer.verdict.converged
    assert memory.barrier_width is None


def test_width_of_a_touch_that_hardly_pressed_is_given_up() -> None:
    problem = make_problem(np.eye(2), [0.0, -1.0], [[0.0, 1.0]], [[1.0, 0.0]], penalty=1.0)
    memory = Memory(barrier_width=1e-30)  # far below the rounding of any gap
    answer = make_enforcement("barrier").solve(problem, make_solver(), memory)
    assert answer.verdict.converged, answer.verdict.sentence
    assert memory.barrier_width == pytest.approx(0.5e-3, rel=1e-6)


def frictional(seed: int) -> StepProblem:
    problem = random_problem(seed)
    limits = replace(problem.limits, friction=np.full(problem.n_contacts, 0.6))
    return replace(problem, limits=limits, gap=np.zeros(problem.n_contacts))


@pytest.mark.parametrize("stiffness", [1e-6, 1.0, 1e6])
def test_points_on_the_curves_give_their_trials_back(stiffness: float) -> None:
    problem = frictional(3)
    well = Potential(problem, 1e-2, 50.0)
    springs = np.full(problem.n_contacts, stiffness)
    curves = Curves(well, springs, 2 * springs)
    # open, touching and deep in the barrier; sticking and sliding
    for x in (1e-6, 0.3, 0.999, 5.0):
        gap = np.full(problem.n_contacts, x * well.width) - well.offset
        slip = np.linspace(-1.2, 0.9, problem.n_contacts) * well.width
        pull = well.pull(gap, slip)
        spot = curves.at(curves.trials(gap, slip, pull.normal, pull.shear), gap, slip)
        # 1e-9: the trial loses the gap's digits where the force is that much larger, not more
        size = np.abs(pull.normal) + springs * well.width
        np.testing.assert_allclose(spot.pull.normal / size, pull.normal / size, atol=1e-9)
        np.testing.assert_allclose(spot.pull.shear / size, pull.shear / size, atol=1e-9)
        slack = (spot.slip - slip) * 2 * springs / size
        np.testing.assert_allclose(slack, 0.0, atol=1e-9)


@pytest.mark.parametrize(("scene", "most"), [("wall", 10), ("pile", 30)])
def test_a_step_takes_few_factorisations(
    scene: str, most: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.syspath_prepend(BENCHMARKS)
    import block_scenes

    motion = block_scenes.Motion(getattr(block_scenes, scene)(100, 10.0))
    memory, solver, problem, counts = Memory(), make_solver(), motion.problem, []
    for _ in range(6):
        answer = make_enforcement("barrier").solve(problem, solver, memory)
        assert answer.verdict.converged, answer.verdict.sentence
        counts.append(answer.factorisations)
        problem = motion.next_problem(answer)
    # published barrier contact takes 10 to 30 Newton steps; here 7 and 19 in the median
    assert np.median(counts[1:]) <= most


def test_a_step_solved_again_costs_next_to_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(BENCHMARKS)
    from block_scenes import Motion, pile

    problem, memory = Motion(pile(40, 10.0)).problem, Memory()
    first = make_enforcement("barrier").solve(problem, make_solver(), memory)
    memory.answered = (problem, first)
    turned = replace(problem, normal_rows=problem.normal_rows * (1 + 1e-7))
    again = make_enforcement("barrier").solve(turned, make_solver(), memory)
    assert again.verdict.converged
    assert again.factorisations <= 5 < first.factorisations
