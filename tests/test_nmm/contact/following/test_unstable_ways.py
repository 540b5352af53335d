"""Ways in which a step of a path is not stable, beside the eigenvalues of its whole tangent."""

import numpy as np
import pytest
from scipy.sparse import csc_array, csr_array

from nmm.contact.following.path_problem import PathProblem
from nmm.contact.following.unstable_ways import unstable_ways
from nmm.contact.laws.tractions import ContactForces
from nmm.contact.points.contact_rows import ContactRows
from nmm.controls.path_equation import PathEquation
from nmm.solvers.linear import make_solver

UNKNOWNS, POINTS, SPRING, REACHED = 12, 6, 50.0, 0.1


def problem(seed, fall):
    """Return a step from the limit of springs that soften beyond it, and unload to their origin.

    Four of its twelve unknowns are sums of the others, as dependent functions are.
    """
    rng = np.random.default_rng(seed)
    basis = rng.standard_normal((UNKNOWNS - 4, UNKNOWNS))
    root = rng.standard_normal((UNKNOWNS - 4, UNKNOWNS - 4))
    matrix = basis.T @ (root @ root.T + np.eye(UNKNOWNS - 4)) @ basis
    normal, tangent = rng.standard_normal((2, POINTS, UNKNOWNS - 4)) @ basis
    rows = ContactRows(csr_array(normal), csr_array(tangent), np.zeros((POINTS, 2)))

    def law(gap, slip):
        further = gap > REACHED
        pull = np.where(further, SPRING * REACHED - fall * (gap - REACHED), SPRING * gap)

        def slopes():
            slope = np.zeros((POINTS, 2, 2))
            slope[:, 0, 0] = np.where(further, -fall, SPRING)
            slope[:, 1, 1] = SPRING
            return slope

        return ContactForces(np.stack([pull, SPRING * slip], axis=1), {}, slopes)

    gap, slip = np.full(POINTS, REACHED), np.zeros(POINTS)
    return PathProblem(csc_array(matrix), np.zeros(UNKNOWNS), rows, gap, slip, law, 0.0)


@pytest.mark.parametrize("fall", [0.1, 1.0, 10.0, 100.0])
@pytest.mark.parametrize("seed", range(5))
def test_they_are_as_many_as_negative_eigenvalues_of_the_tangent(seed, fall):
    posed = problem(seed, fall)
    path = PathEquation(np.zeros(UNKNOWNS), np.zeros(UNKNOWNS), 1.0, 1.0)
    increment = 0.1 * np.random.default_rng(seed).standard_normal(UNKNOWNS)
    end = posed.at(path, increment, 0.0)
    values = np.linalg.eigvalsh(posed.tangent(end).toarray())
    # Those of dependent functions are rounding of the largest, some 1e-15 of it.
    expected = int(np.sum(values < -1e-12 * values.max()))
    assert unstable_ways(posed, end, make_solver()) == expected


def test_that_do_not_soften_are_none():
    posed = problem(1, 100.0)
    end = posed.at(PathEquation(np.zeros(UNKNOWNS), np.zeros(UNKNOWNS), 1.0, 1.0), *REST)
    assert unstable_ways(posed, end, make_solver()) == 0


REST = np.zeros(UNKNOWNS), 0.0
