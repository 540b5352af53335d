"""Steps along a path whose contacts stick and slide by turns, beside all states in turn."""

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
# Problems of these seeds send Newton's method to and fro.
LOST = (2, 9, 11, 13, 14)


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
