"""The contact solution alone, by enforcement: seconds, passes, factorisations, errors.

No search, no scene: blocks of six unknowns start to move under gravity and a lateral acceleration
that grows by 0.05 m/s2 a step. *Force error*: of the resultants of contact on the blocks in the
last step, relative, in the norm weighted with the diagonal, against the same law solved tightly.
*Gap error*: the deepest penetration over the compliance of its contact times the largest force.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from block_scenes import Motion, incline, pile, supports, wall
from enforcements import VARIANTS

from integration.arrays import Floats
from nmm.contact.enforcement.base import Enforcement, make_enforcement
from nmm.contact.iteration.memory import Memory
from nmm.contact.iteration.multiplier_rounds import compliances
from nmm.contact.problem.cut_springs import CutSprings
from nmm.contact.problem.matrix_pattern import SpringPattern
from nmm.contact.problem.step_problem import StepAnswer, StepProblem
from nmm.solvers.linear import make_solver

SCENES: dict[str, tuple[Callable[..., Any], int]] = {
    "slope": (incline, 1),
    "supports": (supports, 1),
    "wall of 100": (wall, 100),
    "pile of 100": (pile, 100),
}
STEPS = 6
# The same law, solved tightly: springs by springs, all else by the cone.
SPRINGS = ("penalty", {"tolerance": 1e-12})
EXACT = ("cone", {"tolerance": 1e-10, "gap_tolerance": 1e-9})


def steps(motion: Motion, method: Enforcement) -> list[tuple[StepProblem, StepAnswer]]:
    """Solve some steps, each from the answer of the last."""
    solver, memory, done = make_solver(), Memory(), []
    problem = motion.problem
    for _ in range(STEPS):
        answer = method.solve(problem, solver, memory)
        done.append((problem, answer))
        problem = motion.next_problem(answer)
    return done


@pytest.mark.parametrize("name", VARIANTS)
@pytest.mark.parametrize("scene", SCENES)
def test_contact_alone(benchmark: Any, scene: str, name: str) -> None:
    benchmark.group = f"contact alone, {scene}"
    make, size = SCENES[scene]
    variant = VARIANTS[name]
    blocks = make(size, variant.penalty)
    steps(Motion(blocks), variant.make())  # loads compiled code
    done = benchmark.pedantic(steps, (Motion(blocks), variant.make()), rounds=1)
    problem, last = done[-1]
    reference = SPRINGS if variant.name == "penalty" else EXACT
    force = float(np.abs(last.normal_force).max(initial=0.0))
    depth = float((np.maximum(-last.gap, 0.0) / compliances(problem)[0]).max(initial=0.0))
    benchmark.extra_info |= {
        "enforcement": name,
        "contacts": problem.n_contacts,
        "converged": sum(answer.verdict.converged for _, answer in done),
        "passes": float(np.median([answer.passes for _, answer in done])),
        "factors": float(np.median([answer.factorisations for _, answer in done])),
        "force error": force_error(problem, last, *reference),
        "gap error": depth / force if force else 0.0,
    }


def force_error(
    problem: StepProblem, answer: StepAnswer, name: str, options: dict[str, object]
) -> float | None:
    """Return the distance of the resultants of contact, relative; None without a reference."""
    tight = make_enforcement(name, options).solve(problem, make_solver())
    if not tight.verdict.converged:
        return None
    weight = CutSprings.of(problem).weight
    expected, found = (weight * _resultants(problem, one) for one in (tight, answer))
    return float(np.linalg.norm(found - expected) / np.linalg.norm(expected))


def _resultants(problem: StepProblem, answer: StepAnswer) -> Floats:
    normal = problem.normal_rows.T @ answer.normal_force
    return np.asarray(normal + problem.tangent_rows.T @ answer.shear_force)


@pytest.mark.parametrize("name", ["cholesky", "lu", "superlu", "qdldl"])
@pytest.mark.parametrize("size", [100, 1000])
def test_factorisation(benchmark: Any, size: int, name: str) -> None:
    benchmark.group = f"factors of a wall of {size}, pattern known"
    problem = wall(size).problem
    springs = (problem.normal_stiffness, problem.shear_stiffness)
    matrix = SpringPattern.of(problem).matrix(problem, *springs)
    solver = make_solver(name)
    benchmark.extra_info |= {"solver": name, "unknowns": matrix.shape[0]}
    benchmark.pedantic(solver.factorise, (matrix,), rounds=3, warmup_rounds=1)
