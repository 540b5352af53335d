"""Steps along a path whose contacts stick and slide by turns, beside all states in turn."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from scipy.sparse import csc_array, csr_array

from nmm.contact.following.by_parts import follow
from nmm.contact.following.newton import newton
from nmm.contact.following.path_problem import PathProblem
from nmm.contact.laws.tractions import ContactForces
from nmm.contact.points.contact_rows import ContactRows
from nmm.controls.path_equation import PathEquation
from nmm.solvers.linear import make_solver

SPRING, FRICTION, UNKNOWNS, CONTACTS, CHANGE = 1e3, 0.5, 8, 5, 2.0
# Problems of these seeds send Newton's method to and fro; on the way to the last ones no part can
# be gone alone, and the very last are found from where Newton's method ended, not from the start.
LOST = (2, 9, 11, 13, 14, 35, 112, 39, 205)


def problem(seed):
    """Return a step of random rows, gaps and load under friction."""
    rng = np.random.default_rng(seed)
    root = rng.standard_normal((UNKNOWNS, UNKNOWNS))
    matrix = root @ root.T + 0.1 * np.eye(UNKNOWNS)
    normal, tangent = rng.standard_normal((2, CONTACTS, UNKNOWNS))
    gap, slip = rng.uniform(-0.01, 0.02, CONTACTS), rng.uniform(-0.01, 0.01, CONTACTS)
    load = rng.standard_normal(UNKNOWNS)
    rows = ContactRows(csr_array(normal), csr_array(tangent), np.zeros((CONTACTS, 2)))
    whole = PathProblem(csc_array(matrix), np.zeros(UNKNOWNS), rows, gap, slip, coulomb, 0.0)
    return whole, PathEquation(load, np.zeros(UNKNOWNS), 1.0, CHANGE)


def coulomb(gap, slip):
    """Springs that press and rub."""
    pull = np.where(gap < 0, SPRING * gap, 0.0)
    bound = -FRICTION * pull
    shear = np.clip(SPRING * slip, -bound, bound)
    held = (gap < 0) & (np.abs(SPRING * slip) < bound)

    def slopes():
        slope = np.zeros((len(gap), 2, 2))
        slope[:, 0, 0] = np.where(gap < 0, SPRING, 0.0)
        slope[:, 1, 1] = np.where(held, SPRING, 0.0)
        slope[:, 1, 0] = np.where((gap < 0) & ~held, -FRICTION * SPRING * np.sign(slip), 0.0)
        return slope

    return ContactForces(np.stack([pull, shear], axis=1), {}, slopes)


def stiffening(gap, slip):
    """The same, whose normal stiffness grows as they close: by a fifth for each 1 cm."""
    at = np.minimum(gap, 0.0)
    found, slope = coulomb(at * (1 - 10 * at), slip), 1 - 20 * at

    def slopes():
        return found.slopes() * np.stack([slope, np.ones_like(slope)], axis=1)[:, None, :]

    return ContactForces(found.force, {}, slopes)


def solutions(whole, path):
    """Return the increments of all states (open, held, two ways of sliding) that agree."""
    normal, tangent = whole.rows.normal.toarray(), whole.rows.tangent.toarray()
    states = np.array(list(product((0, 1, 2, 3), repeat=CONTACTS)))
    pressed, held = states > 0, states == 1
    rub = np.where(states == 2, -FRICTION, np.where(states == 3, FRICTION, 0.0))
    pull = SPRING * pressed
    matrix = whole.matrix.toarray() + np.einsum("sm,mi,mj->sij", pull, normal, normal)
    matrix += np.einsum("sm,mi,mj->sij", SPRING * held, tangent, tangent)
    matrix += np.einsum("sm,mi,mj->sij", pull * rub, tangent, normal)
    force = path.target * path.load - (pull * whole.gap) @ normal
    force = force - (SPRING * held * whole.slip + pull * rub * whole.gap) @ tangent
    found = np.linalg.solve(matrix, force[:, :, None])[:, :, 0]
    gap, slip = whole.gap + found @ normal.T, whole.slip + found @ tangent.T
    bound = FRICTION * np.abs(gap)
    agrees = np.select(
        [states == 0, held], [gap > 0, (gap < 0) & (np.abs(slip) <= bound)], (gap < 0)
    )
    way = np.where(states == 2, slip > bound, slip < -bound)
    return found[(agrees & np.where(states >= 2, way, True)).all(axis=1)]


@pytest.mark.parametrize("seed", [0, 1, 3, *LOST])
def test_a_step_is_one_of_the_states_that_agree_with_coulombs_law(seed):
    whole, path = problem(seed)
    found = follow(whole, path, make_solver())
    assert found.converged
    known = solutions(whole, path)
    # Balance is solved to 1e-11 of forces of some newtons, over a least stiffness of 0.1 N/m.
    assert np.abs(known - found.increment).max(axis=1).min() < 1e-8
    assert found.change == pytest.approx(CHANGE, rel=1e-12)


@pytest.mark.parametrize("seed", LOST)
def test_newtons_method_alone_goes_to_and_fro_there(seed):
    whole, path = problem(seed)
    start = whole.at(path, np.zeros(UNKNOWNS), 0.0)
    assert not newton(whole, path, make_solver(), start).converged


@pytest.mark.parametrize("seed", [11, 14, 21])
def test_a_curved_law_that_has_no_cells_is_followed_in_parts(seed):
    whole, path = problem(seed)
    found = follow(replace(whole, law=stiffening), path, make_solver())
    force = stiffening(found.gap, found.slip).force
    inner = whole.matrix @ found.increment + whole.rows.push(*force.T)
    # Of forces of some newtons a residual of 1e-8 is asked for.
    assert np.abs(inner - CHANGE * path.load).max() < 1e-6


def test_a_step_that_goes_nowhere_costs_no_iteration():
    whole, path = problem(1)
    end = follow(whole, path, make_solver())
    rows = whole.rows
    there = PathProblem(
        whole.matrix,
        whole.force + CHANGE * path.load - whole.matrix @ end.increment,
        rows,
        end.gap,
        end.slip,
        coulomb,
        float(np.linalg.norm(path.load)),
    )
    still = follow(there, PathEquation(path.load, path.row, path.share, 0.0), make_solver())
    assert still.iterations == 0
    assert not still.increment.any()
