"""Coulomb's law: compiled kernels agree with it, tangents are its slopes, edges are where said."""

from dataclasses import replace

import numpy as np
import pytest

from nmm.contact.iteration.interior.complementarity import Complementarity
from nmm.contact.problem import coulomb
from nmm.contact.problem.cut_springs import CutSprings
from nmm.contact.problem.residual_kernel import projected
from nmm.interfaces.limits import Limits
from nmm.testing.contact_oracle import random_problem

# Trial forces on and beside every edge of the law, among ordinary ones.
EDGES = np.array([-2.0, -1.0, -1e-300, -0.0, 0.0, 1e-300, 0.5, 1.0, 1.0 + 1e-15, 3.0, -np.inf])


def contacts(rng: np.random.Generator, count: int) -> tuple[np.ndarray, np.ndarray, Limits]:
    """Trial forces and limits: half of the numbers edges, half of them random."""

    def numbers(edges: np.ndarray) -> np.ndarray:
        ordinary = rng.normal(size=count) * 10.0 ** rng.integers(-3, 4, count)
        return np.where(rng.random(count) < 0.5, rng.choice(edges, count), ordinary)

    above = np.array([0.0, 0.5, 1.0, np.inf])
    limits = Limits(
        np.abs(numbers(above)), np.abs(numbers(above)), np.abs(numbers(np.array([0.0, 0.6, 1.0])))
    )
    normal, shear = numbers(EDGES[:-1]), numbers(EDGES[:-1])
    return normal, shear, limits


@pytest.mark.parametrize("seed", range(5))
def test_the_compiled_law_is_the_law_to_the_last_digit(seed: int) -> None:
    normal, shear, limits = contacts(np.random.default_rng(seed), 2000)
    expected = np.stack(coulomb.project(normal, shear, limits))
    pairs = zip(normal, shear, limits.tension, limits.cohesion, limits.friction, strict=True)
    found = np.array([projected(*(float(x) for x in one)) for one in pairs]).T
    np.testing.assert_array_equal(found, expected)


@pytest.mark.parametrize("seed", range(5))
def test_admissible_forces_are_admissible_and_forces_within_stand(seed: int) -> None:
    normal, shear, limits = contacts(np.random.default_rng(seed), 2000)
    n, t = coulomb.project(normal, shear, limits)
    assert (n <= limits.tension).all()
    lost = (normal > limits.tension) & (limits.tension == 0)
    bound = np.where(lost, 0.0, limits.cohesion + limits.friction * np.maximum(-n, 0.0))
    assert (np.abs(t) <= bound).all()
    within = (normal <= limits.tension) & (np.abs(shear) <= bound)
    assert within.any()
    np.testing.assert_array_equal(n[within], normal[within])
    np.testing.assert_array_equal(t[within], shear[within])


@pytest.mark.parametrize("seed", range(3))
def test_tangents_are_the_slopes_of_the_forces(seed: int) -> None:
    rng = np.random.default_rng(seed)
    normal, shear = rng.normal(size=(2, 500))
    limits = Limits(*np.abs(rng.normal(size=(3, 500))) * (rng.random((3, 500)) < 0.7))
    # The law is linear between its edges: a difference is exact to eps / h = 1e-8, but for the few
    # contacts of whose edges one lies within the step of 1e-8.
    h = 1e-8
    acts, held, mixed = coulomb.tangent(normal, shear, limits)
    base = coulomb.project(normal, shear, limits)
    pressed, sheared = normal + h, shear + h
    by_normal = [
        (a - b) / h for a, b in zip(coulomb.project(pressed, shear, limits), base, strict=True)
    ]
    by_shear = (coulomb.project(normal, sheared, limits)[1] - base[1]) / h
    np.testing.assert_allclose(by_normal[0], acts, atol=1e-6)
    np.testing.assert_allclose(by_normal[1], mixed, atol=1e-6)
    np.testing.assert_allclose(by_shear, held, atol=1e-6)


@pytest.mark.parametrize("bonded", [False, True])
@pytest.mark.parametrize("seed", range(10))
def test_the_compiled_residual_is_that_of_whole_arrays(seed: int, bonded: bool) -> None:
    problem = random_problem(seed, bonded=bonded)
    springs = CutSprings.of(problem)
    rng = np.random.default_rng(seed)
    for scale in (0.0, 1e-6, 1.0):
        increment = scale * rng.normal(size=len(problem.force))
        forces = springs.forces(increment)
        expected = problem.out_of_balance(increment, *forces)
        size = np.abs(problem.force).max() + max(np.abs(f).max() for f in forces)
        found = springs.residual(increment).force
        # sums of some dozens of products
        np.testing.assert_allclose(found, expected, atol=1e-13 * (size + np.abs(expected).max()))


def test_the_interior_point_has_the_bound_of_the_law() -> None:
    problem = random_problem(4, bonded=False)
    m = problem.n_contacts
    limits = Limits(np.zeros(m), np.full(m, 2.0), np.full(m, 0.5))
    springs = CutSprings.of(replace(problem, limits=limits))
    sides = Complementarity(springs, np.ones(m, dtype=bool), np.ones((2, m)))
    pressed = sides.bound(np.full(m, -3.0), np.full(m, 3.0), np.zeros(m))
    np.testing.assert_array_equal(pressed, 2.0 + 0.5 * 3.0)
    parting = sides.bound(np.full(m, -3.0), np.zeros(m), np.full(m, 3.0))
    np.testing.assert_array_equal(parting, 0.5 * 3.0)  # the cohesion is lost with the contact
