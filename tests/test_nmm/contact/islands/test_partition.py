"""Islands of a problem and parts of it, against scipy's graphs and dense algebra."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.sparse.csgraph import connected_components

from nmm.contact.islands.part import part_of
from nmm.contact.islands.partition import Islands, balances
from nmm.contact.problem.cut_springs import CutSprings
from nmm.contact.problem.step_problem import StepProblem
from nmm.interfaces.limits import Limits
from nmm.testing.contact_oracle import make_problem

WIDTH = 3
"""Unknowns of a body."""


def bodies(
    seed: int, count: int = 12, contacts: int = 9, held: tuple[int, ...] = ()
) -> StepProblem:
    """Bodies of three unknowns with contacts between pairs drawn at random; some are held."""
    rng, count, contacts = np.random.default_rng(seed), 12, 9
    n = WIDTH * count
    matrix, rows = np.zeros((n, n)), np.zeros((2, contacts, n))
    for body in range(count):
        at = slice(WIDTH * body, WIDTH * (body + 1))
        root = rng.normal(size=(WIDTH, WIDTH))
        stiff = 1e6 if body in held else 1.0
        matrix[at, at] = stiff * (root @ root.T + np.eye(WIDTH))
    for contact in range(contacts):
        for body in rng.choice(count, 2, replace=False):
            rows[:, contact, WIDTH * body : WIDTH * (body + 1)] = rng.normal(size=(2, WIDTH))
    more = Limits(np.zeros(contacts), np.zeros(contacts), rng.choice([0.0, 0.5], contacts))
    gap = rng.normal(size=contacts) * 0.05
    return make_problem(matrix, rng.normal(size=n), *rows, penalty=100.0, limits=more, gap=gap)


def components(problem: StepProblem, held: tuple[int, ...]) -> np.ndarray:
    """Island of each body by scipy: bodies that a contact joins, held ones apart."""
    count = len(problem.force) // WIDTH
    graph = np.zeros((count, count))
    for row in problem.normal_rows.toarray():
        a, b = np.flatnonzero(row.reshape(count, WIDTH).any(axis=1))
        if a not in held and b not in held:
            graph[a, b] = 1
    return connected_components(graph, directed=False)[1]


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("held", [(), (0,), (3, 7)])
def test_islands_are_the_components_of_bodies_that_touch(seed: int, held: tuple[int, ...]) -> None:
    problem = bodies(seed, held=held)
    found = Islands.of(CutSprings.of(problem))
    alike = components(problem, held)
    assert list(found.unknown[::WIDTH]) == list(alike)
    assert (found.unknown.reshape(-1, WIDTH) == found.unknown[::WIDTH, None]).all()
    assert found.held[found.unknown[[WIDTH * body for body in held]]].all()


@pytest.mark.parametrize("seed", range(5))
def test_a_contact_belongs_to_what_is_not_held_of_its_two_sides(seed: int) -> None:
    problem = bodies(seed, held=(0, 1, 2, 3, 4, 5))
    found = Islands.of(CutSprings.of(problem))
    for contact, row in enumerate(problem.normal_rows.toarray()):
        sides = found.unknown[np.flatnonzero(row)]
        assert found.contact[contact] in sides
        free = sides[~found.held[sides]]
        assert not free.size or found.contact[contact] in free


@pytest.mark.parametrize("seed", range(5))
def test_a_part_is_out_of_balance_by_what_the_whole_is_there(seed: int) -> None:
    rng = np.random.default_rng(100 + seed)
    springs = CutSprings.of(bodies(seed))
    n, m = len(springs.problem.force), springs.problem.n_contacts
    increment = rng.normal(size=n)
    chosen = np.sort(rng.choice(n, n // 2, replace=False))
    touching = np.flatnonzero(rng.random(m) < 0.6)
    part = part_of(springs, chosen, touching, increment)
    moved = rng.normal(size=len(chosen))
    there = increment.copy()
    there[chosen] = moved
    # Contacts left out keep the forces of the increment: those of the whole at `there` differ.
    held = np.setdiff1d(np.arange(m), touching)
    forces = np.stack(springs.forces(there))
    forces[:, held] = np.stack(springs.forces(increment))[:, held]
    whole = springs.problem.out_of_balance(there, *forces)
    np.testing.assert_allclose(part.residual(moved).force, whole[chosen], rtol=1e-12, atol=1e-12)


def test_sizes_of_islands_are_those_of_each_alone() -> None:
    problem = bodies(2)
    springs = CutSprings.of(problem)
    found, at = Islands.of(springs), np.random.default_rng(1).normal(size=len(problem.force))
    force = springs.residual(at).force
    rest, largest = balances(at, force, found.unknown, found.count, springs.columns)
    sizes = rest / largest
    for island in range(found.count):
        unknowns, contacts = found.around(problem, np.arange(found.count) == island)
        alone = part_of(springs, unknowns, contacts, np.zeros_like(at))
        assert sizes[island] == pytest.approx(alone.residual(at[unknowns]).size, rel=1e-12)


def test_an_island_without_forces_is_in_balance() -> None:
    problem = bodies(4)
    problem = replace(problem, force=np.zeros_like(problem.force), gap=np.ones_like(problem.gap))
    springs = CutSprings.of(problem)
    at = np.zeros_like(problem.force)
    found, force = Islands.of(springs), springs.residual(at).force
    rest, _ = balances(at, force, found.unknown, found.count, springs.columns)
    assert not rest.any()
